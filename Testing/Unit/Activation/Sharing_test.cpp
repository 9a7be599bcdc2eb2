// SPDX-License-Identifier: Apache-2.0
// A motion of the arm of Data/arm, seen by its muscles, and the load shared along it.
#include "Activation/Sharing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "Skeleton/ReadOsim.h"

namespace myotet::activation {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Central differences over 2 ms of lengths that are smooth but where a path meets a cylinder.
constexpr double kSpeed = 0.02;    // mm/s of some 70
constexpr double kBalance = 1e-7;  // N mm of some 10 000

class ArmInMotion : public ::testing::Test {
protected:
    ArmInMotion() {
        const skeleton::Table keys{.in_degrees = true,
                                   .columns = {"elbow_flexion", "shoulder_flexion"},
                                   .times = {0, 1},
                                   .rows = {{20, 0}, {100, 0}}};
        trajectory_ = skeleton::make_trajectory(keys, model_, skeleton::key_framed());
        sharing_.held = {true, false};
    }
    MuscleMotion motion_at(const std::vector<double>& times, bool still = false) const {
        return follow_muscles(model_, trajectory_, times, still, silent_);
    }
    Sharing shared(const SharingOptions& options) const {
        return share(model_, motion_at({0.1, 0.5, 0.9}), options, silent_);
    }

    skeleton::Model model_ = skeleton::read_osim(MYOTET_SOURCE_DIR "/Data/arm/arm.osim");
    skeleton::Trajectory trajectory_;
    SharingOptions sharing_;
    mutable SilentProgress silent_;
};

TEST_F(ArmInMotion, IsTheArmThatTheTestsMean) {
    ASSERT_EQ(model_.coordinates.size(), 2u);
    EXPECT_EQ(model_.coordinates[0].name, "shoulder_flexion");
    ASSERT_EQ(model_.muscles.size(), 3u);
    EXPECT_EQ(model_.muscles[0].name, "biceps");
    EXPECT_EQ(model_.muscles[2].name, "triceps");
    EXPECT_THAT(model_.notes, ElementsAre());
}

TEST_F(ArmInMotion, SpeedsAreRatesOfLengthsAndArmsTheirSlopes) {
    constexpr double dt = 1e-3;  // s
    for (const double t : {0.2, 0.45, 0.7}) {
        const MuscleMotion motion = motion_at({t - dt, t, t + dt});
        const skeleton::Instant now = skeleton::at(trajectory_, t);
        for (std::size_t m = 0; m < 3; ++m) {
            const double rate = (motion.lengths[2][m] - motion.lengths[0][m]) / (2 * dt);
            EXPECT_NEAR(motion.speeds[1][m], rate, kSpeed);
            double by_arms = 0;
            for (int c = 0; c < 2; ++c)
                by_arms -= motion.arms[1](c, static_cast<int>(m)) * now.speeds[c];
            EXPECT_NEAR(motion.speeds[1][m], by_arms, 1e-9);
        }
        EXPECT_GT(motion.arms[1](1, 0), 0);  // the biceps bends, the triceps stretches
        EXPECT_LT(motion.arms[1](1, 2), 0);
    }
}

TEST_F(ArmInMotion, StillTorquesAreThoseOfWeights) {
    // At rest the elbow bears the forearm, 1.65 kg at 174.3 mm, and 4 kg at 332 mm.
    const double angle = skeleton::at(trajectory_, 0.5).values[1];
    const MuscleMotion motion = motion_at({0.5}, true);
    const double g = 9806.65;                     // mm/s^2
    const auto lever = [&](double y, double z) {  // to the front, after the turn
        return -y * std::cos(angle) + z * std::sin(angle);
    };
    // From the elbow's axis at z = 2 mm, z downwards here.
    const double expected = g * (1.65e-3 * lever(3, 174.3) + 4e-3 * lever(-20, 332));
    EXPECT_NEAR(motion.torques[0][1], expected, 1e-6 * expected);
    EXPECT_EQ(motion.speeds[0], std::vector<double>(3, 0.0));
}

TEST_F(ArmInMotion, ForcesBalanceWithRigidAndElasticTendons) {
    const MuscleMotion motion = motion_at({0.1, 0.5, 0.9});
    for (const Tendons tendons : {Tendons::rigid, Tendons::elastic}) {
        sharing_.tendons = tendons;
        const Sharing sharing = share(model_, motion, sharing_, silent_);
        ASSERT_EQ(sharing.status, Status::converged) << sharing.message;
        EXPECT_THAT(sharing.held, ElementsAre(true, false));
        for (std::size_t t = 0; t < 3; ++t) {
            double sum = 0;
            for (int m = 0; m < 3; ++m) sum += motion.arms[t](1, m) * sharing.at[t].forces[m];
            EXPECT_NEAR(sum, motion.torques[t][1], kBalance);
            for (const double a : sharing.at[t].activations) {
                EXPECT_GE(a, 0.01 - 1e-12);
                EXPECT_LE(a, 1);
            }
        }
    }
}

TEST_F(ArmInMotion, PassiveForceIsWhatRelaxedMusclesPull) {
    sharing_.tendons = Tendons::rigid;
    sharing_.passive = false;
    for (const Demand& demand : shared(sharing_).demands)
        EXPECT_THAT(demand.passive, ElementsAre(0, 0, 0));
    sharing_.passive = true;
    EXPECT_GT(shared(sharing_).demands.front().passive[0], 1);  // the biceps is stretched at 20
}

TEST_F(ArmInMotion, BoundsNarrowTheModels) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    sharing_.highest = {{0, 1}, {{0.2, none, none}, {0.4, none, none}}};
    sharing_.lowest = {{0}, {{none, 0.001, 0.05}}};
    const Demand demand = shared(sharing_).demands[1];
    EXPECT_NEAR(demand.highest[0], 0.3, 1e-12);  // half-way
    EXPECT_EQ(demand.highest[1], 1);
    EXPECT_EQ(demand.lowest[1], 0.01);  // the model's is higher
    EXPECT_EQ(demand.lowest[2], 0.05);
}

TEST_F(ArmInMotion, WhatCannotBeDoneIsToldWithItsTime) {
    sharing_.held = {};
    const Sharing sharing = shared(sharing_);
    EXPECT_EQ(sharing.status, Status::infeasible);
    EXPECT_THAT(sharing.message, AllOf(HasSubstr("at 0."), HasSubstr("_flexion")));
}

TEST_F(ArmInMotion, CoordinatesWithoutMusclesAreHeldAndNamed) {
    std::erase_if(model_.muscles, [](const skeleton::Muscle& m) { return m.name != "brachialis"; });
    sharing_.held = {};
    const Sharing sharing = shared(sharing_);
    EXPECT_THAT(sharing.held, ElementsAre(true, false));
    EXPECT_THAT(sharing.notes, ElementsAre(HasSubstr("no muscle moves shoulder_flexion")));
    EXPECT_EQ(sharing.status, Status::converged) << sharing.message;
}

TEST(MuscleTable, IsStraightBetweenTimesAndConstantBeyond) {
    const MuscleTable table{{0, 2}, {{1, 5}, {3, 5}}};
    EXPECT_THAT(table.at(-1), ElementsAre(1, 5));
    EXPECT_THAT(table.at(0.5), ElementsAre(1.5, 5));
    EXPECT_THAT(table.at(9), ElementsAre(3, 5));
    EXPECT_TRUE(MuscleTable{}.at(0).empty());
}

}  // namespace
}  // namespace myotet::activation
