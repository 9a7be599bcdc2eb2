// SPDX-License-Identifier: Apache-2.0
#include "Fibres/FitSamples.h"

#include <Eigen/Sparse>
#include <cmath>

#include "Core/Errors.h"

namespace myotet::fibres {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

// A pivot below this share of the largest stands for a control point that no sample moves.
constexpr double kSingular = 1e-13;

void require_samples(std::span<const SolidSample> samples) {
    for (std::size_t n = 0; n < samples.size(); ++n) {
        const SolidSample& s = samples[n];
        const std::string where = "sample " + std::to_string(n) + " of the solid";
        if (!s.point.allFinite()) throw InputError(where + " has a point that is not finite");
        if (!(s.uvw.minCoeff() >= 0 && s.uvw.maxCoeff() <= 1))
            throw InputError(where + " has parameters outside [0, 1]");
        if (!(s.weight >= 0))
            throw InputError(where + " has the weight " + std::to_string(s.weight) +
                             ", but it must not be negative");
    }
}

/// A row a sample, sqrt(weight) N_i(u) N_j(v) N_k(w) in the column of P_ijk.
SparseMatrix sample_matrix(std::span<const SolidSample> samples, const SolidShape& shape) {
    const auto& [degree, count] = shape;
    SparseMatrix B(static_cast<Eigen::Index>(samples.size()),
                   static_cast<Eigen::Index>(shape.controls()));
    Triplets entries;
    for (std::size_t n = 0; n < samples.size(); ++n) {
        std::array<Basis, 3> basis;
        for (int a = 0; a < 3; ++a) basis[a] = basis_at(degree[a], count[a], samples[n].uvw[a]);
        const double root = std::sqrt(samples[n].weight);
        for (int k = 0; k <= degree[2]; ++k)
            for (int j = 0; j <= degree[1]; ++j)
                for (int i = 0; i <= degree[0]; ++i) {
                    const int column =
                        ((basis[2].first + k) * count[1] + basis[1].first + j) * count[0] +
                        basis[0].first + i;
                    entries.emplace_back(
                        static_cast<int>(n), column,
                        root * basis[0].value[i] * basis[1].value[j] * basis[2].value[k]);
                }
    }
    B.setFromTriplets(entries.begin(), entries.end());
    return B;
}

/// A row each three neighbours along an axis:
///   (P_2 - P_1) / (g_2 - g_1) - (P_1 - P_0) / (g_1 - g_0), over the spacing's mean.
SparseMatrix second_differences(const SolidShape& shape) {
    const auto& [degree, count] = shape;
    const std::array<int, 3> stride{1, count[0], count[0] * count[1]};
    Triplets entries;
    int row = 0;
    for (int a = 0; a < 3; ++a) {
        const double mean = 1.0 / (count[a] - 1);
        for (int n = 0; n < static_cast<int>(shape.controls()); ++n) {
            const int i = n / stride[a] % count[a];
            if (i == 0 || i == count[a] - 1) continue;
            const double g = greville(degree[a], count[a], i);
            const double before = mean / (g - greville(degree[a], count[a], i - 1));
            const double after = mean / (greville(degree[a], count[a], i + 1) - g);
            entries.emplace_back(row, n - stride[a], before);
            entries.emplace_back(row, n, -before - after);
            entries.emplace_back(row, n + stride[a], after);
            ++row;
        }
    }
    SparseMatrix D(row, static_cast<Eigen::Index>(shape.controls()));
    D.setFromTriplets(entries.begin(), entries.end());
    return D;
}

}  // namespace

BSplineSolid fit_samples(std::span<const SolidSample> samples, const SolidShape& shape,
                         double smoothing) {
    shape.validate();
    if (!(smoothing >= 0))
        throw InputError("smoothing is " + std::to_string(smoothing) +
                         ", but it must not be negative");
    require_samples(samples);
    const SparseMatrix B = sample_matrix(samples, shape);
    SparseMatrix A = SparseMatrix(B.transpose()) * B;
    if (smoothing > 0) {
        const SparseMatrix D = second_differences(shape);
        const double mean = A.diagonal().sum() / static_cast<double>(A.rows());
        A += smoothing * mean * (SparseMatrix(D.transpose()) * D);
    }
    Eigen::MatrixX3d right(samples.size(), 3);
    for (std::size_t n = 0; n < samples.size(); ++n)
        right.row(static_cast<Eigen::Index>(n)) =
            std::sqrt(samples[n].weight) * samples[n].point.transpose();
    const Eigen::SimplicialLDLT<SparseMatrix> factors(A);
    const bool solved = factors.info() == Eigen::Success;
    if (!solved || !(factors.vectorD().minCoeff() > kSingular * factors.vectorD().maxCoeff()))
        throw InputError(std::to_string(samples.size()) + " samples do not determine the " +
                         std::to_string(shape.controls()) +
                         " control points of the solid; take more of them, spread over the "
                         "whole cube, fewer control points, or smoothing above 0");
    const Eigen::MatrixX3d P = factors.solve(B.transpose() * right);
    BSplineSolid solid{shape, {}};
    solid.control.reserve(shape.controls());
    for (Eigen::Index n = 0; n < P.rows(); ++n) solid.control.emplace_back(P.row(n).transpose());
    return solid;
}

}  // namespace myotet::fibres
