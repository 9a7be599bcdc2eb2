// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Viscous.h"

#include <cmath>

#include "Core/Errors.h"
#include "Elasticity/Materials.h"
#include "LawKit.h"

namespace myotet::elasticity {
namespace {

constexpr double kEta = 0.3, kTimeStep = 0.01;

std::shared_ptr<const PointLaw> rubber() {
    return std::make_shared<OneLaw<NeoHookean>>(NeoHookean{lame_from(0.1, 0.4)},
                                                VolumeLaw{5, VolumeForm::squared});
}

// Without elasticity, so that what is left is the viscosity's.
class Nothing final : public PointLaw {
public:
    double energy(std::size_t, const Mat3&) const override { return 0; }
    Mat3 stress(std::size_t, const Mat3&) const override { return Mat3::Zero(); }
    Tangent tangent(std::size_t, const Mat3&) const override { return Tangent::Zero(); }
};

// What the kit asks of a law, for one point of many.
struct AtPoint {
    const PointLaw& law;
    std::size_t point;
    [[nodiscard]] double energy(const Mat3& F) const { return law.energy(point, F); }
    [[nodiscard]] Mat3 stress(const Mat3& F) const { return law.stress(point, F); }
    [[nodiscard]] Tangent tangent(const Mat3& F) const { return law.tangent(point, F); }
};

Mat3 strain(const Mat3& F) { return 0.5 * (F.transpose() * F - Mat3::Identity()); }

TEST(ViscousLaw, IsALawFromRest) {
    ViscousLaw law(rubber(), {0, kEta});
    kit::expect_law(AtPoint{law, 1});
    law.begin_step(kTimeStep);
    kit::expect_law(AtPoint{law, 0});
    kit::expect_law(AtPoint{law, 1});
}

TEST(ViscousLaw, KeepsItsDerivativesAndObjectivityOnTheWay) {
    ViscousLaw law(rubber(), {kEta});
    const AtPoint at{law, 0};
    std::mt19937 random(4);
    for (const Mat3& F : kit::deformations()) {
        law.begin_step(kTimeStep);
        const Mat3 Q = kit::random_rotation(random), dF = kit::random_matrix(random, 1);
        const double scale = 1 + law.stress(0, F).norm();
        EXPECT_NEAR(at.energy(Q * F), at.energy(F), 1e-10 * scale);
        const double slope =
            (at.energy(F + kit::kStep * dF) - at.energy(F - kit::kStep * dF)) / (2 * kit::kStep);
        EXPECT_NEAR(at.stress(F).cwiseProduct(dF).sum(), slope, 100 * kit::kDifference * scale);
        kit::expect_tangent(at, F, Q, dF);
        law.accept({F});
    }
}

TEST(ViscousLaw, WhereItCameFromMayBeTurnedAsWell) {
    std::mt19937 random(6);
    const auto all = kit::deformations();
    for (std::size_t i = 1; i < all.size(); ++i) {
        const auto energy_from = [&](const Mat3& before) {
            ViscousLaw law(std::make_shared<Nothing>(), {kEta});
            law.stop({before});
            law.begin_step(kTimeStep);
            return law.energy(0, all[i]);
        };
        const double straight = energy_from(all[i - 1]);
        EXPECT_NEAR(energy_from(kit::random_rotation(random) * all[i - 1]), straight,
                    1e-12 * (1 + straight));
    }
}

TEST(ViscousLaw, ARigidMotionCostsNothing) {
    std::mt19937 random(7);
    for (const Mat3& F : kit::deformations()) {
        ViscousLaw law(std::make_shared<Nothing>(), {kEta});
        law.stop({F});
        law.begin_step(kTimeStep);
        const Mat3 Q = kit::random_rotation(random);
        EXPECT_NEAR(law.energy(0, Q * F), 0, kit::kRounding);
        EXPECT_LT(law.stress(0, Q * F).norm(), 1e-10 * F.norm());
    }
}

TEST(ViscousLaw, TakesEnergyAway) {
    // From the step alone, the work over it, S : (E - E_n), is eta |E - E_n|^2 / dt.
    ViscousLaw law(std::make_shared<Nothing>(), {kEta});
    Mat3 before = Mat3::Identity();
    for (const Mat3& F : kit::deformations()) {
        law.begin_step(kTimeStep, RateOrder::first);
        const Mat3 S = F.inverse() * law.stress(0, F), by = strain(F) - strain(before);
        EXPECT_NEAR(S.cwiseProduct(by).sum(), kEta / kTimeStep * by.squaredNorm(),
                    1e-9 * (1 + kEta / kTimeStep * by.squaredNorm()));
        law.accept({F});
        before = F;
    }
}

// The stress after steps of these lengths while E_xx goes as a function of time.
double stress_after(const std::vector<double>& steps, RateOrder order, auto&& strain_at) {
    ViscousLaw law(std::make_shared<Nothing>(), {kEta});
    double time = 0, S = 0;
    for (const double dt : steps) {
        const Mat3 F = Vec3(std::sqrt(1 + 2 * strain_at(time += dt)), 1, 1).asDiagonal();
        law.begin_step(dt, order);
        law.begin_step(dt, order);  // once more, as after a step that was refused
        S = law.stress(0, F)(0, 0) / F(0, 0);
        law.accept({F});
    }
    return S;
}

TEST(ViscousLaw, IsExactForRatesOfItsOrder) {
    const auto linear = [](double t) { return 2 * t; };
    const auto square = [](double t) { return 2 * t * t; };
    for (const std::vector<double>& steps :
         {std::vector{0.1, 0.1, 0.1}, {0.02, 0.1, 0.05}, {0.05, 0.01, 0.2}}) {
        double end = 0;
        for (const double dt : steps) end += dt;
        EXPECT_NEAR(stress_after(steps, RateOrder::first, linear), kEta * 2, 1e-12);
        EXPECT_NEAR(stress_after(steps, RateOrder::second, linear), kEta * 2, 1e-12);
        EXPECT_NEAR(stress_after(steps, RateOrder::second, square), kEta * 4 * end, 1e-12);
        // Half a step late.
        EXPECT_NEAR(stress_after(steps, RateOrder::first, square),
                    kEta * 4 * (end - 0.5 * steps.back()), 1e-12);
    }
}

TEST(ViscousLaw, IsTheOtherLawWithoutAStepAndWhenStopped) {
    const auto elastic = rubber();
    ViscousLaw law(elastic, {kEta});
    const auto expect_same = [&](const Mat3& F) {
        EXPECT_EQ(law.energy(0, F), elastic->energy(0, F));
        EXPECT_EQ(law.stress(0, F), elastic->stress(0, F));
        EXPECT_EQ(law.tangent(0, F), elastic->tangent(0, F));
        EXPECT_EQ(law.volume(0).bulk, 5);
        EXPECT_EQ(law.volume(0).form, VolumeForm::squared);
    };
    const Mat3 F = kit::deformations()[4];
    expect_same(F);
    law.begin_step(kTimeStep);
    EXPECT_NE(law.energy(0, F), elastic->energy(0, F));
    law.accept({F});
    law.stop({F});
    expect_same(kit::deformations()[7]);
}

TEST(ViscousLaw, RefusesWhatMakesNoSense) {
    EXPECT_THROW(ViscousLaw(rubber(), {0, -1}), InputError);
    EXPECT_THROW(ViscousLaw(rubber(), {std::nan("")}), InputError);
    ViscousLaw law(rubber(), {kEta});
    EXPECT_THROW(law.begin_step(0), InputError);
    EXPECT_THROW(law.begin_step(std::nan("")), InputError);
    EXPECT_THROW(law.begin_step(INFINITY), InputError);
    EXPECT_THROW(law.accept({Mat3::Identity()}), LogicError);
    EXPECT_THROW(law.accept({}), InputError);
    EXPECT_THROW(law.stop({Mat3::Identity(), Mat3::Identity()}), InputError);
}

}  // namespace
}  // namespace myotet::elasticity
