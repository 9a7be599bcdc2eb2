// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Tangent.h"

#include <Eigen/Eigenvalues>

#include "Elasticity/Materials.h"
#include "Elasticity/TetLaw.h"
#include "LawKit.h"

namespace myotet::elasticity {
namespace {

const OneLaw<NeoHookean> kRubber(NeoHookean{lame_from(0.1, 0.45)});

double least_curvature(const Tangent& C) {
    return Eigen::SelfAdjointEigenSolver<Tangent>(C).eigenvalues()[0];
}

TEST(ConvexPart, HasNoNegativeCurvatureAndLeavesConvexTangentsAlone) {
    int bent = 0;
    for (const Mat3& F : kit::deformations()) {
        const Tangent C = kRubber.tangent(0, F), part = convex_part(C);
        EXPECT_GT(least_curvature(part), -kit::kRounding * C.norm());
        if (least_curvature(C) > kit::kRounding * C.norm()) {
            EXPECT_EQ(C, part);
        }
        // Where C curves upwards, it curves as C does: both agree on C's convex space.
        const Eigen::SelfAdjointEigenSolver<Tangent> eigen(C);
        for (int i = 0; i < 9; ++i) {
            const auto v = eigen.eigenvectors().col(i);
            const double expected = std::max(eigen.eigenvalues()[i], 0.0);
            EXPECT_NEAR(v.dot(part * v), expected, 1e-12 * C.norm());
        }
        bent += least_curvature(C) < 0;
    }
    EXPECT_GT(bent, 3);  // the case is there
}

}  // namespace
}  // namespace myotet::elasticity
