// SPDX-License-Identifier: Apache-2.0
// TissueLaw with a force-velocity curve, and what it is made of.
#include <gmock/gmock.h>

#include "Core/Errors.h"
#include "Muscle/TissueLaw.h"
#include "MuscleKit.h"

namespace myotet::muscle {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Vec3 kAlong = Vec3(2, 1, -2) / 3;
constexpr double kStep = 0.02;  // s; at 0.8 of the optimum a fibre is 10 lengths / s fast

/// One point of a law, as the kit of Elasticity wants it.
struct OfPoint {
    const TissueLaw& law;
    [[nodiscard]] double energy(const Mat3& F) const { return law.energy(0, F); }
    [[nodiscard]] Mat3 stress(const Mat3& F) const { return law.stress(0, F); }
    [[nodiscard]] Tangent tangent(const Mat3& F) const { return law.tangent(0, F); }
};

TissueLaw law_of(const TissueMaterial& material, const Vec3& fibre, double activation) {
    TissueLaw law(std::vector{material}, {0}, {fibre});
    law.set_activation(0, activation);
    return law;
}

/// Stretched along e1, of the same volume.
Mat3 stretched(double l) { return Vec3(l, 1 / std::sqrt(l), 1 / std::sqrt(l)).asDiagonal(); }
/// What then pulls along e1, a unit of undeformed area: the slope of the energy by l.
double pull(const TissueLaw& law, double l) {
    const Mat3 slope = Vec3(1, -0.5 * std::pow(l, -1.5), -0.5 * std::pow(l, -1.5)).asDiagonal();
    return law.stress(0, stretched(l)).cwiseProduct(slope).sum();
}

TEST(SpeedOfFibres, IntegralBelongsToForceVelocity) {
    // Midpoints of so many pieces err by 1e-9 of the integral.
    constexpr int kPieces = 20000;
    constexpr double kQuadrature = 1e-8;
    const ForceVelocity curve{.max_speed = 8, .shape = 0.3, .most = 1.5};
    EXPECT_EQ(curve.integral(0), 0);
    for (const double speed : {-20.0, -8.0, -7.9, -3.0, -1e-3, 1e-3, 0.5, 4.0, 30.0}) {
        double sum = 0;
        for (int i = 0; i < kPieces; ++i) sum += curve.value((i + 0.5) / kPieces * speed);
        EXPECT_NEAR(curve.integral(speed), sum * speed / kPieces, kQuadrature * std::abs(speed))
            << speed;
    }
}

TEST(SpeedOfFibres, LawsHoldWithinAStep) {
    for (const char* set : {"teran2003_muscle", "blemker2005_muscle"}) {
        TissueLaw law = law_of(kit::read_set(set), kAlong, 0.7);
        law.set_force_velocity({});
        law.accept({Mat3(Vec3(0.9, 1.1, 1).asDiagonal())});
        law.begin_step(kStep);
        std::mt19937 random(4);
        for (const Mat3& F : kit::law_kit::deformations()) {
            const Mat3 Q = kit::law_kit::random_rotation(random);
            const double scale = 1 + law.stress(0, F).norm();
            EXPECT_NEAR(law.energy(0, Q * F), law.energy(0, F), 1e-10 * scale);
            EXPECT_LT((law.stress(0, Q * F) - Q * law.stress(0, F)).norm(), 1e-10 * scale);
            for (int i = 0; i < 9; ++i) {
                Mat3 up = F, down = F;
                up.data()[i] += kit::law_kit::kStep;
                down.data()[i] -= kit::law_kit::kStep;
                const double slope =
                    (law.energy(0, up) - law.energy(0, down)) / (2 * kit::law_kit::kStep);
                EXPECT_NEAR(law.stress(0, F).data()[i], slope,
                            kit::law_kit::kDifference * 20 * scale);
            }
            const Mat3 dF = kit::law_kit::random_matrix(random, 1);
            kit::law_kit::expect_tangent(OfPoint{law}, F, Q, dF);
        }
    }
}

TEST(SpeedOfFibres, StandingStillPullsAsWithoutACurve) {
    const TissueMaterial material = kit::read_set("teran2003_muscle");
    const Mat3 F = Vec3(0.9, 1.05, 1.1).asDiagonal();
    const TissueLaw plain = law_of(material, kAlong, 0.6);
    TissueLaw law = law_of(material, kAlong, 0.6);
    law.begin_step(kStep);  // without effect, as there is no curve
    EXPECT_EQ(law.energy(0, F), plain.energy(0, F));
    law.set_force_velocity({});
    EXPECT_EQ(law.stress(0, F), plain.stress(0, F)) << "before the first step";
    law.accept({F});
    law.begin_step(kStep);
    constexpr double kRounding = 1e-13;
    EXPECT_LT((law.stress(0, F) - plain.stress(0, F)).norm(), kRounding);
    EXPECT_NE(law.tangent(0, F), plain.tangent(0, F));
    law.stop();
    EXPECT_EQ(law.energy(0, F), plain.energy(0, F));
    EXPECT_EQ(law.tangent(0, F), plain.tangent(0, F));
}

TEST(SpeedOfFibres, PullGrowsWithLengthWithinAStep) {
    // Where the active curve falls a fibre without a curve has a falling pull.
    constexpr double kRounding = 1e-14;
    TissueLaw law = law_of(kit::febio_muscle(1), Vec3::UnitX(), 1);
    EXPECT_GT(pull(law, 1.1), pull(law, 1.2));
    law.set_force_velocity({});
    for (const double begun : {0.5, 0.8, 1.0, 1.3, 1.5}) {
        law.accept({stretched(begun)});
        law.begin_step(kStep);
        double before = pull(law, 0.4);
        for (double l = 0.41; l < 1.7; l += 0.01) {
            EXPECT_GE(pull(law, l), before - kRounding) << begun << ' ' << l;
            before = pull(law, l);
        }
        const double faster = begun - 1.01 * kStep * ForceVelocity{}.max_speed;
        if (faster > 1) continue;  // something passive pulls
        EXPECT_NEAR(pull(law, faster), 0, kRounding) << "faster than without load";
    }
}

// A fibre under a constant load shortens with the speed of Hill's hyperbola
//     v = -max_speed (1 - f) / (1 + f / shape),  f = T / (sigma active(x))
// where x is the length of the step's beginning; with short steps, of the present.
TEST(SpeedOfFibres, ConstantLoadShortensAtHillsSpeed) {
    constexpr double kRounding = 1e-9;
    const TissueMaterial material = kit::febio_muscle(1.25);
    const ForceVelocity hill{.max_speed = 6, .shape = 0.2, .most = 1.4};
    for (const double part : {0.1, 0.4, 0.8}) {
        constexpr double kActivation = 0.5;
        const double most = kActivation * material.sigma_max / material.optimal_stretch;
        const double load = part * most;
        TissueLaw law = law_of(material, Vec3::UnitX(), kActivation);
        law.set_force_velocity(hill);
        double l = material.optimal_stretch;  // at the optimum: nothing passive below
        law.accept({stretched(l)});
        for (int step = 0; step < 5; ++step) {
            constexpr double dt = 2e-3;
            law.begin_step(dt);
            double low = l - 1.2 * dt * hill.max_speed * material.optimal_stretch, high = l;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                (pull(law, middle) < load ? low : high) = middle;
            }
            const double speed = (high - l) / dt / material.optimal_stretch;
            const double f = load / (most * kBlemkerActive.value(l / material.optimal_stretch));
            EXPECT_NEAR(speed, -hill.max_speed * (1 - f) / (1 + f / hill.shape),
                        kRounding * hill.max_speed);
            l = high;
            const double pulled = pull(law, l);
            law.accept({stretched(l)});
            EXPECT_EQ(pull(law, l), pulled) << "the stress of the step that ended";
        }
    }
}

TEST(SpeedOfFibres, TissueWithoutActiveFibresIsAsItWas) {
    const TissueMaterial fat{.C1 = 0.001, .bulk = 1};
    TissueLaw law(std::vector{fat, kit::read_set("teran2003_tendon")}, {0, 1},
                  {Vec3::Constant(std::nan("")), kAlong});
    const Mat3 F = Vec3(0.9, 1.1, 1.2).asDiagonal();
    const Mat3 before[] = {law.stress(0, F), law.stress(1, F)};
    law.set_force_velocity({});
    law.begin_step(kStep);
    law.accept({F, F});
    EXPECT_EQ(law.stress(0, F), before[0]);
    EXPECT_EQ(law.stress(1, F), before[1]);
}

TEST(SpeedOfFibres, RefusesWhatHasNoMeaning) {
    TissueLaw law = law_of(kit::read_set("teran2003_muscle"), kAlong, 0.6);
    EXPECT_THROW(law.set_force_velocity({.max_speed = -1}), InputError);
    law.set_force_velocity({});
    for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL})
        EXPECT_THROW(law.begin_step(wrong), InputError);
    EXPECT_THROW(law.accept({}), InputError);
    EXPECT_THAT([&] { law.accept({Mat3(Mat3::Zero())}); },
                ThrowsMessage<InputError>(HasSubstr("point 0")));
    EXPECT_THROW(law.accept({Mat3(Mat3::Constant(std::nan("")))}), InputError);
}

}  // namespace
}  // namespace myotet::muscle
