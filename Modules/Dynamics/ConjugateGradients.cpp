// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/ConjugateGradients.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <cstring>

#include "Core/Parallel.h"
#include "Core/Wide.h"
#include "Dynamics/NodeAlgebra.h"

namespace myotet::dynamics {
namespace {

constexpr std::size_t kGrain = 2048;
// Rows of a product, which are longer work.
constexpr std::size_t kRows = 256;
// From this tolerance on, K is read in single precision.
constexpr double kSingle = 1e-5;
// Where iterations are cheap they go on to this part of the tolerance.
constexpr double kFarther = 0.01;

// Inverses of the diagonal blocks, or of their size where they are not positive; zero for
// held nodes: what they multiply leaves held nodes alone.
std::vector<Mat3> invert_diagonal(const BlockMatrix& K, const std::vector<char>& held) {
    std::vector<Mat3> inverse(K.rows(), Mat3::Zero());
    for (std::size_t n = 0; n < K.rows(); ++n) {
        if (held[n]) continue;
        const auto i = static_cast<std::int32_t>(n);
        const Mat3& block = K.value[K.at(i, i)];
        const Eigen::LLT<Mat3> factor(block);
        if (factor.info() == Eigen::Success)
            inverse[n] = factor.solve(Mat3::Identity());
        else
            inverse[n] = Mat3::Identity() / block.norm();
    }
    return inverse;
}

using Block = Eigen::Matrix<float, 3, 3>;
using Read [[gnu::vector_size(4 * sizeof(float))]] = float;
using Wide [[gnu::vector_size(4 * sizeof(double))]] = double;

// sum_i K_ni p_i
Vec3 row_product(const BlockMatrix& K, const std::vector<Mat3>& value, std::size_t n,
                 const NodeVectors& p) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = K.row_start[n]; i < K.row_start[n + 1]; ++i)
        sum += value[i] * p[K.column[i]];
    return sum;
}

// The same, a block's columns read as four numbers, of which the last belongs to what
// comes next and is not used: there must be a block more.
MYOTET_WIDE Vec3 row_product(const BlockMatrix& K, const std::vector<Block>& value, std::size_t n,
                             const NodeVectors& p) {
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
    return {all[0], all[1], all[2]};
}

// q = K p on free nodes, nothing on held ones; returns p . q.
template <class Number>
double free_product(const BlockMatrix& K, const std::vector<Eigen::Matrix<Number, 3, 3>>& value,
                    const std::vector<char>& held, const NodeVectors& p, NodeVectors& q) {
    return parallel_sum(0, p.size(), kRows, [&](std::size_t first, std::size_t last) {
        double sum = 0;
        for (std::size_t n = first; n < last; ++n) {
            q[n] = held[n] ? Vec3(Vec3::Zero()) : row_product(K, value, n, p);
            sum += q[n].dot(p[n]);
        }
        return sum;
    });
}

class Iteration {
public:
    Iteration(const BlockMatrix& K, const std::vector<char>& held, const Preconditioner* with,
              bool single)
        : K_(K), held_(held), with_(with), single_(single) {
        if (!with) inverse_ = invert_diagonal(K, held);
        if (!single) return;
        single_value_.resize(K.value.size() + 1);
        parallel_for(0, K.value.size(), 16 * kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) single_value_[i] = K.value[i].cast<float>();
        });
    }
    double multiply(const NodeVectors& p, NodeVectors& q) const {
        return single_ ? free_product(K_, single_value_, held_, p, q)
                       : free_product(K_, K_.value, held_, p, q);
    }
    // x += alpha p, r -= alpha q, z = M^-1 r; returns r . z.
    double advance(double alpha, const NodeVectors& p, const NodeVectors& q, NodeVectors& x,
                   NodeVectors& r, NodeVectors& z) const {
        const double dot_here =
            parallel_sum(0, p.size(), kGrain, [&](std::size_t first, std::size_t last) {
                double sum = 0;
                for (std::size_t n = first; n < last; ++n) {
                    x[n] += alpha * p[n];
                    r[n] -= alpha * q[n];
                    if (with_) continue;
                    z[n] = inverse_[n] * r[n];
                    sum += z[n].dot(r[n]);
                }
                return sum;
            });
        if (!with_) return dot_here;
        with_->apply(r, z);
        return dot(r, z);
    }

private:
    const BlockMatrix& K_;
    const std::vector<char>& held_;
    const Preconditioner* with_;
    bool single_;
    std::vector<Mat3> inverse_;
    std::vector<Block> single_value_;
};

}  // namespace

LinearSummary solve(const BlockMatrix& K, const std::vector<char>& held, const NodeVectors& right,
                    const LinearOptions& options, NodeVectors& x, const Preconditioner* with) {
    LinearSummary summary;
    const Iteration iteration(K, held, with, options.tolerance >= kSingle);
    // The right hand side that held nodes' values leave to the free ones.
    NodeVectors r = right;
    add_scaled(-1, multiply(K, x), r);
    for (std::size_t n = 0; n < r.size(); ++n)
        if (held[n]) r[n].setZero();
    NodeVectors q(r.size(), Vec3::Zero()), z(r.size());
    double rz = iteration.advance(0, q, q, x, r, z);
    NodeVectors p = z;
    const double scale = rz;
    const auto settled = [&] {
        summary.residual = scale == 0 ? 0 : std::sqrt(rz / scale);
        summary.converged = summary.residual <= options.tolerance;
        return summary.converged && (summary.iterations >= options.cheap ||
                                     summary.residual <= kFarther * options.tolerance);
    };
    while (!settled() && summary.iterations < options.iterations) {
        const double curvature = iteration.multiply(p, q);
        if (!(curvature > 0)) {
            if (curvature <= 0) summary.downward = p;  // else not a number
            break;
        }
        const double next = iteration.advance(rz / curvature, p, q, x, r, z);
        parallel_for(0, p.size(), 2 * kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) p[i] = z[i] + next / rz * p[i];
        });
        rz = next;
        ++summary.iterations;
    }
    return summary;
}

}  // namespace myotet::dynamics
