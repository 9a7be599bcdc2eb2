// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Materials.h"

#include "Core/Errors.h"
#include "LawKit.h"

namespace myotet::elasticity {
namespace {

const Lame kRubber = lame_from(0.1, 0.4);

TEST(StVenantKirchhoff, ObeysTheLaws) { kit::expect_law(StVenantKirchhoff{kRubber}); }
TEST(NeoHookean, ObeysTheLaws) { kit::expect_law(NeoHookean{kRubber}); }

TEST(Lame, GivesYoungsModulusBackUnderASmallPull) {
    // Uniaxial stress: sigma = E e for the strain e with free sides.
    for (const auto& [young, poisson] : {std::pair{0.1, 0.4}, {200.0, 0.3}, {1.0, 0.0}}) {
        const Lame lame = lame_from(young, poisson);
        const double e = 1e-6;
        Mat3 F = Vec3(1 - poisson * e, 1 - poisson * e, 1 + e).asDiagonal();
        for (const Mat3& P : {StVenantKirchhoff{lame}.stress(F), NeoHookean{lame}.stress(F)}) {
            EXPECT_NEAR(P(2, 2) / (young * e), 1, 1e-5);
            EXPECT_NEAR(P(0, 0) / (young * e), 0, 1e-5);
        }
    }
    EXPECT_THROW((void)lame_from(0, 0.3), InputError);
    EXPECT_THROW((void)lame_from(1, 0.5), InputError);
    EXPECT_THROW((void)lame_from(1, std::nan("")), InputError);
}

TEST(NeoHookean, CauchyStressIsThePapers) {
    // sigma = mu / J (b - I) + lambda ln J / J I, b = F F^T [Teran05, sec. 7.2].
    for (const Mat3& F : kit::deformations()) {
        const double J = F.determinant();
        const Mat3 b = F * F.transpose();
        const Mat3 sigma = kRubber.mu / J * (b - Mat3::Identity()) +
                           kRubber.lambda * std::log(J) / J * Mat3::Identity();
        const Mat3 P = NeoHookean{kRubber}.stress(F);
        EXPECT_LT((P * F.transpose() / J - sigma).norm(), 1e-12);
    }
}

TEST(NeoHookean, ResistsCollapseWithoutBound) {
    const NeoHookean law{kRubber};
    const auto flat = [](double h) { return Mat3(Vec3(1, 1, h).asDiagonal()); };
    EXPECT_GT(law.energy(flat(1e-8)), law.energy(flat(1e-4)));
    EXPECT_EQ(law.energy(flat(-0.5)), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(law.stress(flat(-0.5))(2, 2)));
}

TEST(Viscosity, DampsAndNothingElse) {
    const Viscosity law{0.02, 0.01};
    const RestTet rest = rest_tet(kit::some_tet());
    for (const Mat3& F : kit::deformations()) {
        const Corners x = kit::moved(kit::some_tet(), F);
        kit::expect_damping(x, [&](const Corners& v) {
            return rest.forces(law.stress(rest.gradient(x), rest.gradient(v)));
        });
    }
}

TEST(SoundSpeed, IsThatOfPressureWaves) {
    EXPECT_DOUBLE_EQ(sound_speed({1, 2}, 4), 1);
    // Water: 2.2 GPa and 1e-9 t/mm^3 give 1.48e6 mm/s.
    EXPECT_NEAR(sound_speed({0, 2200}, 1e-9), 1.48e6, 1e4);
}

}  // namespace
}  // namespace myotet::elasticity
