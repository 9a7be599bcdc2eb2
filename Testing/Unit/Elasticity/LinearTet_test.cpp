// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/LinearTet.h"

#include <Eigen/LU>

#include "Core/Errors.h"
#include "Elasticity/Materials.h"
#include "LawKit.h"

namespace myotet::elasticity {
namespace {

TEST(RestTet, GradientIsThatOfAnAffineMap) {
    const RestTet rest = rest_tet(kit::some_tet());
    for (const Mat3& F : kit::deformations()) {
        Corners x = kit::moved(kit::some_tet(), F);
        for (Vec3& p : x) p += Vec3(3, -7, 2);
        EXPECT_LT((rest.gradient(x) - F).norm(), 1e-12);
    }
}

TEST(RestTet, ForcesAreMinusTheGradientOfTheEnergy) {
    const NeoHookean law{lame_from(0.1, 0.4)};
    const RestTet rest = rest_tet(kit::some_tet());
    for (const Mat3& F : kit::deformations()) {
        const Corners x = kit::moved(kit::some_tet(), F);
        const Corners f = rest.forces(law.stress(rest.gradient(x)));
        for (int i = 0; i < 4; ++i)
            for (int a = 0; a < 3; ++a) {
                Corners up = x, down = x;
                up[i][a] += kit::kStep;
                down[i][a] -= kit::kStep;
                const double slope =
                    rest.volume *
                    (law.energy(rest.gradient(up)) - law.energy(rest.gradient(down))) /
                    (2 * kit::kStep);
                EXPECT_NEAR(f[i][a], -slope, 1e-6 * (1 + f[i].norm()));
            }
    }
}

TEST(RestTet, StiffnessIsMinusTheDerivativeOfTheForces) {
    const NeoHookean law{lame_from(0.1, 0.4)};
    const RestTet rest = rest_tet(kit::some_tet());
    const auto forces = [&](const Corners& x) { return rest.forces(law.stress(rest.gradient(x))); };
    for (const Mat3& F : kit::deformations()) {
        const Corners x = kit::moved(kit::some_tet(), F);
        const Tangent C = law.tangent(F);
        for (int b = 0; b < 4; ++b)
            for (int k = 0; k < 3; ++k) {
                Corners up = x, down = x;
                up[b][k] += kit::kStep;
                down[b][k] -= kit::kStep;
                const Corners fu = forces(up), fd = forces(down);
                for (int a = 0; a < 4; ++a) {
                    const Vec3 slope = (fd[a] - fu[a]) / (2 * kit::kStep);
                    const Vec3 column = rest.stiffness_row(C, a)[b].col(k);
                    EXPECT_LT((column - slope).norm(), 20 * kit::kDifference * (1 + C.norm()));
                }
            }
    }
}

TEST(CauchyForces, AreThoseOfTheFirstPiolaKirchhoffStress) {
    const NeoHookean law{lame_from(0.1, 0.4)};
    const RestTet rest = rest_tet(kit::some_tet());
    for (const Mat3& F : kit::deformations()) {
        const Corners x = kit::moved(kit::some_tet(), F);
        const Mat3 P = law.stress(F);
        const Corners f = rest.forces(P), g = cauchy_forces(x, P * F.transpose() / F.determinant());
        for (int i = 0; i < 4; ++i) EXPECT_LT((f[i] - g[i]).norm(), 1e-11);
    }
}

TEST(RestTet, RefusesAFlatOrInvertedOne) {
    Corners x = kit::some_tet();
    std::swap(x[0], x[1]);
    EXPECT_THROW((void)rest_tet(x), MeshError);
    x[3] = x[0];
    EXPECT_THROW((void)rest_tet(x), MeshError);
}

TEST(NodalMasses, AddUpToTheWhole) {
    const Corners x = kit::some_tet();
    const TetMesh mesh{{x[0], x[1], x[2], x[3], {9, 9, 9}}, {{0, 1, 2, 3}}, {}};
    const std::vector<double> masses = nodal_masses(mesh, 3);
    double all = 0;
    for (const double m : masses) all += m;
    EXPECT_NEAR(all, 3 * volume(mesh), 1e-12);
    EXPECT_EQ(masses[4], 0);
    EXPECT_DOUBLE_EQ(masses[0], masses[3]);
}

}  // namespace
}  // namespace myotet::elasticity
