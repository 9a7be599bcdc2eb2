// SPDX-License-Identifier: Apache-2.0
#include "Play/Solve.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "Core/Parallel.h"

namespace myotet::play {

using dynamics::BlockMatrix;
using dynamics::NodeVectors;

namespace {

constexpr std::size_t kGrain = 2048;  // nodes at a time; fewer are one thread's work

// A vector of one node, or a column of a block; the fourth number is 0.
using Four [[gnu::vector_size(4 * sizeof(float))]] = float;
struct Block {
    Four column[3];
};
using Vectors = std::vector<Four>;

Four four(const Vec3& v) {
    return Four{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0};
}
Block block(const Mat3& m) { return {{four(m.col(0)), four(m.col(1)), four(m.col(2))}}; }
inline Four times(const Block& m, const Four& v) {
    return m.column[0] * v[0] + m.column[1] * v[1] + m.column[2] * v[2];
}
inline float dot(const Four& a, const Four& b) {
    const Four c = a * b;
    return c[0] + c[1] + c[2];
}

// A touch that presses or drags, as Touch's add_product has it.
struct Pressing {
    std::array<std::int32_t, Touch::kMost> node;
    std::array<float, Touch::kMost> weight;
    int count;
    Four normal;
    float along, drag;  // k - drag, drag
};

template <class Body>
void each(std::size_t count, Body&& body) {
    if (count <= kGrain)
        body(std::size_t{0}, count);
    else
        parallel_for(0, count, kGrain, body);
}

// K, the touches and the preconditioner in single precision.
class Iteration {
public:
    explicit Iteration(const System& system) : K_(system.K), value_(system.K.value.size()) {
        for (std::size_t i = 0; i < value_.size(); ++i) value_[i] = block(K_.value[i]);
        invert_diagonal(system);
        for (const Touch& t : system.touches) add(t);
    }

    // q = (K + touches) p; returns p . q.
    double multiply(const Vectors& p, Vectors& q) const {
        each(p.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) {
                Four sum{};
                for (std::size_t i = K_.row_start[n]; i < K_.row_start[n + 1]; ++i)
                    sum += times(value_[i], p[K_.column[i]]);
                q[n] = sum;
            }
        });
        for (const Pressing& t : touches_) {
            Four by{};
            for (int i = 0; i < t.count; ++i) by += t.weight[i] * p[t.node[i]];
            const Four force = (t.along * dot(t.normal, by)) * t.normal + t.drag * by;
            for (int i = 0; i < t.count; ++i) q[t.node[i]] += t.weight[i] * force;
        }
        return parallel_sum(0, p.size(), kGrain, [&](std::size_t first, std::size_t last) {
            double sum = 0;
            for (std::size_t n = first; n < last; ++n) sum += dot(p[n], q[n]);
            return sum;
        });
    }
    // d += alpha p, r -= alpha q, z = M^-1 r; returns r . z.
    double advance(float alpha, const Vectors& p, const Vectors& q, Vectors& d, Vectors& r,
                   Vectors& z) const {
        return parallel_sum(0, p.size(), kGrain, [&](std::size_t first, std::size_t last) {
            double sum = 0;
            for (std::size_t n = first; n < last; ++n) {
                d[n] += alpha * p[n];
                r[n] -= alpha * q[n];
                z[n] = times(inverse_[n], r[n]);
                sum += dot(r[n], z[n]);
            }
            return sum;
        });
    }

private:
    // Zero for held nodes, which so take no part.
    void invert_diagonal(const System& system) {
        std::vector<Mat3> diagonal(K_.rows());
        for (std::size_t n = 0; n < K_.rows(); ++n) {
            const auto i = static_cast<std::int32_t>(n);
            diagonal[n] = K_.value[K_.at(i, i)];
        }
        add_diagonal(system.touches, diagonal);
        for (std::size_t n = 0; n < K_.rows(); ++n) {
            const Eigen::LLT<Mat3> factor(diagonal[n]);
            Mat3 inverse = Mat3::Zero();
            if (!system.held[n])
                inverse = factor.info() == Eigen::Success
                              ? Mat3(factor.solve(Mat3::Identity()))
                              : Mat3(Mat3::Identity() / diagonal[n].norm());
            inverse_.push_back(block(inverse));
        }
    }
    void add(const Touch& t) {
        if (t.press == 0 && t.drag == 0) return;
        Pressing pressing{.node = t.node, .weight = {}, .count = t.count, .normal = four(t.normal)};
        for (int i = 0; i < t.count; ++i) pressing.weight[i] = static_cast<float>(t.weight[i]);
        pressing.along = static_cast<float>((t.press > 0 ? t.stiffness : 0) - t.drag);
        pressing.drag = static_cast<float>(t.drag);
        touches_.push_back(pressing);
    }

    const BlockMatrix& K_;
    std::vector<Block> value_, inverse_;
    std::vector<Pressing> touches_;
};

}  // namespace

int solve(const System& system, const NodeVectors& right, const SolveOptions& options,
          NodeVectors& found) {
    const Iteration iteration(system);
    const std::size_t count = right.size();
    // Single precision is for numbers near 1.
    double scale = 0;
    for (const Vec3& f : right) scale = std::max(scale, f.cwiseAbs().maxCoeff());
    found.assign(count, Vec3::Zero());
    if (!(scale > 0)) return 0;
    Vectors d(count), r(count), z(count), q(count);
    for (std::size_t n = 0; n < count; ++n) r[n] = four(right[n] / scale);
    double rz = iteration.advance(0, q, q, d, r, z);
    Vectors p = z;
    const double enough = options.tolerance * options.tolerance * rz;
    int iterations = 0;
    while (rz > enough && iterations < options.iterations) {
        const double curvature = iteration.multiply(p, q);
        if (!(curvature > 0)) {
            if (iterations == 0) d = z;
            break;
        }
        const double next = iteration.advance(static_cast<float>(rz / curvature), p, q, d, r, z);
        const auto beta = static_cast<float>(next / rz);
        each(count, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) p[n] = z[n] + beta * p[n];
        });
        rz = next;
        ++iterations;
    }
    for (std::size_t n = 0; n < count; ++n) found[n] = scale * Vec3(d[n][0], d[n][1], d[n][2]);
    return iterations;
}

}  // namespace myotet::play
