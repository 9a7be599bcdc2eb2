// SPDX-License-Identifier: Apache-2.0
#include "Fibres/Dyads.h"

#include <Eigen/Eigenvalues>

namespace myotet::fibres {
namespace {

// The two largest eigenvalues are equal when they differ by less than this share of the
// trace: a hundred thousand times rounding, below the noise of any image.
constexpr double kDistinct = 1e-10;

}  // namespace

std::optional<Vec3> DyadSum::principal() const {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(dyads);
    const Vec3 value = eigen.eigenvalues();  // increasing
    if (!(value[2] - value[1] > kDistinct * value.sum())) return std::nullopt;
    const Vec3 v = eigen.eigenvectors().col(2).normalized();
    return vectors.dot(v) < 0 ? Vec3(-v) : v;
}

}  // namespace myotet::fibres
