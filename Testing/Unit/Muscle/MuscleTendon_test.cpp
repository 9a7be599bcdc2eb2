// SPDX-License-Identifier: Apache-2.0
#include "Muscle/MuscleTendon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"

namespace myotet::muscle {
namespace {

// Of a few operations on lengths in mm, where the tendon's stiffness multiplies rounding.
constexpr double kRounding = 1e-10;
constexpr double kStep = 1e-5, kDifference = 1e-5;

MuscleTendon arm_muscle(HillCurves curves) {
    return {.strength = 800,
            .fibre_length = 130,
            .tendon_length = 140,
            .pennation = 0.2,
            .curves = std::move(curves)};
}
std::vector<MuscleTendon> units() {
    return {arm_muscle(thelen2003_curves({})), arm_muscle(millard2012_curves({})),
            arm_muscle(generic_curves())};
}
// Of the whole unit when fibres have this length and the tendon is slack.
double length_at(const MuscleTendon& unit, double fibres) {
    const double width = unit.fibre_length * std::sin(unit.pennation);
    return unit.tendon_length + std::sqrt(fibres * fibres - width * width);
}

TEST(MuscleTendon, RigidIsTheClosedForm) {
    for (const MuscleTendon& unit : units()) {
        const RigidPull best = rigid_pull(unit, length_at(unit, 130), 0);
        EXPECT_NEAR(best.fibre_length, 130, kRounding);
        EXPECT_NEAR(best.cos_pennation, std::cos(0.2), kRounding);
        EXPECT_NEAR(best.gain, 800 * std::cos(0.2), 800 * kRounding);
        EXPECT_NEAR(best.passive, 0, 1e-6);
        const RigidPull away = rigid_pull(unit, length_at(unit, 170), -200);
        const double cosine = std::sqrt(1 - std::pow(130 * std::sin(0.2) / 170, 2));
        EXPECT_NEAR(away.fibre_speed, -200 * cosine, 1e-9);
        EXPECT_NEAR(away.gain,
                    800 * cosine * unit.curves.active(170.0 / 130).value *
                        unit.curves.velocity(-200 * cosine / 1300).value,
                    1e-7);
    }
}

TEST(MuscleTendon, FibresKeepTheirWidth) {
    const MuscleTendon unit = units()[0];
    for (double length = 190; length < 400; length += 7) {
        const RigidPull pull = rigid_pull(unit, length, 0);
        const double sine = std::sqrt(1 - pull.cos_pennation * pull.cos_pennation);
        EXPECT_NEAR(pull.fibre_length * sine, 130 * std::sin(0.2), 1e-9);
        // The unit's length is the tendon's and the fibres' part along it.
        EXPECT_NEAR(pull.fibre_length * pull.cos_pennation + 140, length, 1e-9);
        const double step = 1e-4;
        const double grown = rigid_pull(unit, length + step, 0).fibre_length -
                             rigid_pull(unit, length - step, 0).fibre_length;
        EXPECT_NEAR(grown / (2 * step) * 50, rigid_pull(unit, length, 50).fibre_speed, 1e-6);
    }
}

TEST(MuscleTendon, ElasticPullsAsItsFibresDo) {
    for (const MuscleTendon& unit : units())
        for (double length = 230; length < 360; length += 10)
            for (const double a : {0.0, 0.01, 0.3, 1.0})
                for (const double speed : {-300.0, 0.0, 150.0}) {
                    const ElasticPull pull = elastic_pull(unit, length, a, speed);
                    ASSERT_TRUE(pull.converged) << length << " " << a << " " << pull.residual;
                    if (pull.slack) {
                        EXPECT_EQ(pull.force, 0);
                        continue;
                    }
                    const double v = speed / 1300, stretch = pull.fibre_length / 130;
                    const double fibres =
                        a * unit.curves.active(stretch).value * unit.curves.velocity(v).value +
                        unit.curves.passive(stretch).value + unit.curves.damping * v;
                    EXPECT_NEAR(pull.force, 800 * pull.cos_pennation * fibres, 1e-8);
                    const double tendon = length - pull.fibre_length * pull.cos_pennation;
                    EXPECT_NEAR(pull.force, 800 * unit.curves.tendon(tendon / 140).value, 1e-8);
                }
}

TEST(MuscleTendon, ElasticDerivativesAreThoseOfTheForce) {
    for (const MuscleTendon& unit : units())
        for (double length = 255; length < 330; length += 13)
            for (const double a : {0.1, 0.5, 0.9})
                for (const double speed : {-100.0, 0.0, 80.0}) {
                    const ElasticPull pull = elastic_pull(unit, length, a, speed);
                    if (pull.slack) continue;
                    const ElasticPull up = elastic_pull(unit, length, a + kStep, speed);
                    const ElasticPull down = elastic_pull(unit, length, a - kStep, speed);
                    EXPECT_NEAR((up.force - down.force) / (2 * kStep), pull.force_by_activation,
                                800 * kDifference);
                    EXPECT_NEAR((up.fibre_length - down.fibre_length) / (2 * kStep),
                                pull.length_by_activation, 130 * kDifference);
                    const ElasticPull longer = elastic_pull(unit, length + kStep, a, speed);
                    const ElasticPull shorter = elastic_pull(unit, length - kStep, a, speed);
                    EXPECT_NEAR((longer.fibre_length - shorter.fibre_length) / (2 * kStep),
                                pull.length_by_unit_length, kDifference);
                }
}

TEST(MuscleTendon, AStiffTendonIsARigidOne) {
    // A tendon of a ten-thousandth of the usual strain stretches 0.5 um: fl changes by 1e-6.
    const ThelenShape stiff{.FmaxTendonStrain = 4e-6};
    const MuscleTendon unit = arm_muscle(thelen2003_curves(stiff));
    for (double length = 240; length < 330; length += 10)
        for (const double speed : {-200.0, 0.0, 100.0}) {
            const RigidPull rigid = rigid_pull(unit, length, speed);
            for (const double a : {0.05, 0.6}) {
                const ElasticPull elastic =
                    elastic_pull(unit, {.length = length, .speed = speed, .activation = a});
                EXPECT_TRUE(elastic.converged);
                EXPECT_NEAR(elastic.force, rigid.passive + a * rigid.gain, 800 * 1e-4);
            }
        }
}

TEST(MuscleTendon, FibresFollowTheEquilibriumAsItMoves) {
    const MuscleTendon unit = units()[1];
    const double dt = 1e-5, speed = 120, rate = 3;
    const ElasticPull before = elastic_pull(unit, 280 - speed * dt, 0.4 - rate * dt, 0);
    const ElasticPull after = elastic_pull(unit, 280 + speed * dt, 0.4 + rate * dt, 0);
    const double fibre_speed = (after.fibre_length - before.fibre_length) / (2 * dt);
    const ElasticPull moving = elastic_pull(
        unit, {.length = 280, .speed = speed, .activation = 0.4, .activation_rate = rate});
    // Derivatives over 2.4 um of a curve that bends within some mm.
    EXPECT_NEAR(moving.force, elastic_pull(unit, 280, 0.4, fibre_speed).force, 1e-4);
}

TEST(MuscleTendon, PullsMoreWhenMoreActive) {
    for (const MuscleTendon& unit : units())
        for (double length = 240; length < 330; length += 15) {
            double before = -1;
            for (double a = 0; a <= 1; a += 0.05) {
                const double force = elastic_pull(unit, length, a, 0).force;
                EXPECT_GE(force, before);
                before = force;
            }
        }
}

TEST(MuscleTendon, RelaxedAtRestHasTheDerivativeOfLittleActivation) {
    for (const MuscleTendon& unit : units()) {
        const double length = length_at(unit, 110);
        const ElasticPull pull = elastic_pull(unit, length, 0, 0);
        EXPECT_NEAR(pull.force, 0, kRounding);
        const double little = 1e-6;
        EXPECT_NEAR(elastic_pull(unit, length, little, 0).force / little, pull.force_by_activation,
                    800 * 0.01);
    }
}

TEST(MuscleTendon, ShorterThanItsTendonIsSlack) {
    for (const MuscleTendon& unit : units())
        for (const double length : {0.0, 100.0, 140.0, 141.0}) {
            EXPECT_TRUE(rigid_pull(unit, length, 0).slack);
            EXPECT_EQ(rigid_pull(unit, length, 0).gain, 0);
            const ElasticPull pull = elastic_pull(unit, length, 1, 0);
            EXPECT_TRUE(pull.slack);
            EXPECT_EQ(pull.force, 0);
            EXPECT_EQ(pull.force_by_activation, 0);
        }
}

TEST(MuscleTendon, IsokineticGainIsThePullAtRestAndChangesWithSpeed) {
    for (const MuscleTendon& unit : units()) {
        // The generic curve misses 1 at rest by 4e-4.
        const double still = elastic_pull(unit, 280, 1, 0).force;
        EXPECT_NEAR(isokinetic_gain(unit, 280, 0), still, 5e-4 * still);
        EXPECT_LT(isokinetic_gain(unit, 280, -100), still);
        EXPECT_GT(isokinetic_gain(unit, 280, 100), still);
        EXPECT_NEAR(isokinetic_gain(unit, 280, 1e6), 1.8 * still, 1e-6 * still);
    }
}

TEST(MuscleTendon, RefusesWhatHasNoMeaning) {
    MuscleTendon unit = units()[0];
    EXPECT_NO_THROW(unit.validate());
    unit.pennation = 1.6;
    EXPECT_THROW(unit.validate(), InputError);
    unit = units()[0];
    unit.fibre_length = std::nan("");
    EXPECT_THROW(unit.validate(), InputError);
    unit = units()[0];
    unit.strength = -1;
    EXPECT_THROW(unit.validate(), InputError);
}

}  // namespace
}  // namespace myotet::muscle
