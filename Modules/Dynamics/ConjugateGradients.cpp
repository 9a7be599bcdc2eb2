// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/ConjugateGradients.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "Core/Parallel.h"
#include "Dynamics/NodeAlgebra.h"

namespace myotet::dynamics {
namespace {

constexpr std::size_t kGrain = 4096;

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

NodeVectors scaled(const std::vector<Mat3>& by, const NodeVectors& r) {
    NodeVectors z(r.size());
    parallel_for(0, r.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) z[i] = by[i] * r[i];
    });
    return z;
}

}  // namespace

LinearSummary solve(const BlockMatrix& K, const std::vector<char>& held, const NodeVectors& right,
                    const LinearOptions& options, NodeVectors& x) {
    LinearSummary summary;
    const std::vector<Mat3> inverse = invert_diagonal(K, held);
    NodeVectors r = right;
    add_scaled(-1, multiply(K, x), r);
    NodeVectors z = scaled(inverse, r), p = z;
    double rz = dot(r, z);
    // The right hand side that held nodes' values leave to the free ones is r.
    const double scale = rz;
    const auto settled = [&] {
        summary.residual = scale > 0 ? std::sqrt(rz / scale) : 0;
        return summary.converged = summary.residual <= options.tolerance;
    };
    while (!settled() && summary.iterations < options.iterations) {
        const NodeVectors q = multiply(K, p);
        const double curvature = dot(p, q);
        if (!(curvature > 0)) {
            summary.downward = p;
            break;
        }
        const double alpha = rz / curvature;
        add_scaled(alpha, p, x);
        add_scaled(-alpha, q, r);
        z = scaled(inverse, r);
        const double next = dot(r, z);
        parallel_for(0, p.size(), kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) p[i] = z[i] + next / rz * p[i];
        });
        rz = next;
        ++summary.iterations;
    }
    return summary;
}

}  // namespace myotet::dynamics
