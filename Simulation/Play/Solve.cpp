// SPDX-License-Identifier: Apache-2.0
#include "Play/Solve.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <cstring>

#include "Core/Parallel.h"
#include "Core/Wide.h"

namespace myotet::play {

using dynamics::BlockMatrix;
using dynamics::NodeVectors;

namespace {

constexpr std::size_t kGrain = 2048;  // nodes at a time; fewer are one thread's work

using Block = Eigen::Matrix<float, 3, 3>;
using Read [[gnu::vector_size(4 * sizeof(float))]] = float;
using Wide [[gnu::vector_size(4 * sizeof(double))]] = double;

// q = K p, a block's columns read as four numbers, of which the last belongs to what comes next
// and is not used: there must be a block more.
MYOTET_WIDE void multiply_rows(const BlockMatrix& K, const Block* value, const NodeVectors& p,
                               std::size_t first, std::size_t last, NodeVectors& q) {
    for (std::size_t n = first; n < last; ++n) {
        Wide sum[3] = {};
        for (std::size_t i = K.row_start[n]; i < K.row_start[n + 1]; ++i) {
            const Vec3& of = p[K.column[i]];
            for (int c = 0; c < 3; ++c) {
                Read column;
                std::memcpy(&column, value[i].data() + 3 * c, sizeof column);
                sum[c] += __builtin_convertvector(column, Wide) * of[c];
            }
        }
        const Wide all = sum[0] + sum[1] + sum[2];
        q[n] = Vec3(all[0], all[1], all[2]);
    }
}

std::vector<Mat3> invert_diagonal(const System& system) {
    const BlockMatrix& K = system.K;
    std::vector<Mat3> diagonal(K.rows());
    for (std::size_t n = 0; n < K.rows(); ++n) {
        const auto i = static_cast<std::int32_t>(n);
        diagonal[n] = K.value[K.at(i, i)];
    }
    add_diagonal(system.touches, diagonal);
    for (std::size_t n = 0; n < K.rows(); ++n) {
        const Eigen::LLT<Mat3> factor(diagonal[n]);
        if (system.held[n])
            diagonal[n].setZero();
        else if (factor.info() == Eigen::Success)
            diagonal[n] = factor.solve(Mat3::Identity()).eval();
        else
            diagonal[n] = Mat3::Identity() / diagonal[n].norm();
    }
    return diagonal;
}

template <class Body>
void each(std::size_t count, Body&& body) {
    if (count <= kGrain) {
        body(std::size_t{0}, count);
        return;
    }
    parallel_for(0, count, kGrain, body);
}

double dot(const NodeVectors& a, const NodeVectors& b) {
    return parallel_sum(0, a.size(), kGrain, [&](std::size_t first, std::size_t last) {
        double sum = 0;
        for (std::size_t n = first; n < last; ++n) sum += a[n].dot(b[n]);
        return sum;
    });
}

}  // namespace

int solve(const System& system, const NodeVectors& right, const SolveOptions& options,
          NodeVectors& d) {
    const BlockMatrix& K = system.K;
    const std::size_t count = K.rows();
    std::vector<Block> value(K.value.size() + 1);
    for (std::size_t i = 0; i < K.value.size(); ++i) value[i] = K.value[i].cast<float>();
    const std::vector<Mat3> inverse = invert_diagonal(system);

    d.assign(count, Vec3::Zero());
    NodeVectors r = right, z(count), q(count);
    // Held nodes take no part: their rows of the preconditioner are nothing.
    const auto precondition = [&] {
        each(count, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) z[n].noalias() = inverse[n] * r[n];
        });
        return dot(r, z);
    };
    double rz = precondition();
    NodeVectors p = z;
    const double enough = options.tolerance * options.tolerance * rz;
    int iterations = 0;
    while (rz > enough && iterations < options.iterations) {
        each(count, [&](std::size_t first, std::size_t last) {
            multiply_rows(K, value.data(), p, first, last, q);
        });
        add_product(system.touches, p, q);
        const double curvature = dot(p, q);
        if (!(curvature > 0)) {
            if (iterations == 0) d = z;
            break;
        }
        const double alpha = rz / curvature;
        each(count, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) {
                d[n] += alpha * p[n];
                r[n] -= alpha * q[n];
            }
        });
        const double next = precondition(), beta = next / rz;
        each(count, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) p[n] = z[n] + beta * p[n];
        });
        rz = next;
        ++iterations;
    }
    return iterations;
}

}  // namespace myotet::play
