// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Tangent.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace myotet::elasticity {

Tangent convex_part(const Tangent& tangent) {
    // Most are convex, and a Cholesky factor tells it at a small part of the cost.
    if (Eigen::LLT<Tangent>(tangent).info() == Eigen::Success) return tangent;
    const Eigen::SelfAdjointEigenSolver<Tangent> eigen(tangent);
    const Tangent& Q = eigen.eigenvectors();
    return Q * eigen.eigenvalues().cwiseMax(0).asDiagonal() * Q.transpose();
}

}  // namespace myotet::elasticity
