// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Motion.h"

#include <gtest/gtest.h>

#include <numbers>

namespace myotet::contraction {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Of points some 300 mm away, turned and shifted: a few roundings of that size.
constexpr double kRounding = 1e-11;

const Vec3 kPoint{30, -70, 300}, kElbow{12, 5, 180};

Motion wild() {
    return {{{0, Vec3::Zero(), Vec3::UnitX(), 0, kElbow},
             {0.4, {3, 0, -2}, Vec3(1, 2, 2) / 3, 75, kElbow},
             {1, {0, 9, 1}, Vec3(2, -1, 2) / 3, -130, {0, 0, 100}},
             {1.5, {1, 1, 1}, Vec3::UnitZ(), 40, {5, 6, 7}}}};
}

TEST(Motion, WithoutKeysABoneStays) { EXPECT_EQ(pose_at({}, 3)(kPoint), kPoint); }

TEST(Motion, IsExactAtKeysAndHeldBeyond) {
    const Motion motion = wild();
    for (const KeyFrame& key : motion.keys) {
        const Pose expected = pose_of(key), found = pose_at(motion, key.time);
        EXPECT_EQ(found.rotation, expected.rotation);
        EXPECT_EQ(found.translation, expected.translation);
        EXPECT_NEAR((expected(key.centre) - key.centre - key.translation).norm(), 0, kRounding);
    }
    EXPECT_EQ(pose_at(motion, -1)(kPoint), kPoint);
    EXPECT_EQ(pose_at(motion, 9)(kPoint), pose_of(motion.keys.back())(kPoint));
}

TEST(Motion, IsRigidAndContinuous) {
    const Motion motion = wild();
    constexpr double kStep = 1e-7;
    // The wildest stretch turns by less than pi in half a second at 400 mm.
    constexpr double kFastest = 2 * std::numbers::pi * 400 + 100;
    for (int i = -10; i < 170; ++i) {
        const double t = 0.01 * i;
        const Pose pose = pose_at(motion, t);
        EXPECT_NEAR((pose.rotation.transpose() * pose.rotation - Mat3::Identity()).norm(), 0,
                    1e-14);
        EXPECT_NEAR(pose.rotation.determinant(), 1, 1e-14);
        for (const double side : {-kStep, kStep})
            EXPECT_LE((pose_at(motion, t + side)(kPoint) - pose(kPoint)).norm(), kFastest * kStep)
                << t;
    }
}

TEST(Motion, AboutOneCentreABoneTurnsEvenlyAsAJointDoes) {
    const Motion motion{{{0, Vec3::Zero(), Vec3::UnitZ(), 0, kElbow},
                         {2, Vec3::Zero(), Vec3(0, 0, 1), 120, kElbow}}};
    for (const double t : {0.1, 0.5, 1.0, 1.7}) {
        const Mat3 turn = Eigen::AngleAxisd(60 * t * kDegree, Vec3::UnitZ()).toRotationMatrix();
        const Vec3 expected = turn * (kPoint - kElbow) + kElbow;
        EXPECT_NEAR((pose_at(motion, t)(kPoint) - expected).norm(), 0, kRounding);
        EXPECT_NEAR((pose_at(motion, t)(kElbow) - kElbow).norm(), 0, kRounding);
    }
}

TEST(Motion, TranslationAloneIsStraight) {
    const Motion motion{{{}, {2, {4, -6, 8}, Vec3::UnitZ(), 0, kElbow}}};
    EXPECT_NEAR((pose_at(motion, 0.5)(kPoint) - kPoint - Vec3(1, -1.5, 2)).norm(), 0, kRounding);
}

TEST(Motion, SlerpTurnsEvenlyBetweenAnyTwoAxes) {
    const Motion motion = wild();
    const auto turned = [&](double a, double b) {
        const Mat3 r = pose_at(motion, b).rotation * pose_at(motion, a).rotation.transpose();
        return Eigen::AngleAxisd(r).angle();
    };
    const double whole = turned(0.4, 1.0);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(turned(0.4 + 0.1 * i, 0.5 + 0.1 * i), whole / 6, 1e-12);
    EXPECT_NEAR(turn_between_deg(motion.keys[1], motion.keys[2]), whole / kDegree, 1e-9);
}

TEST(Motion, TurnBetweenKeysCountsAnglesAboutOneAxis) {
    const auto key = [](const Vec3& axis, double angle_deg) {
        return KeyFrame{.axis = axis, .angle_deg = angle_deg};
    };
    EXPECT_EQ(turn_between_deg(key(Vec3::UnitX(), 0), key(Vec3::UnitZ(), 350)), 350);
    EXPECT_EQ(turn_between_deg(key(Vec3::UnitZ(), -200), key(Vec3::UnitX(), 0)), 200);
    EXPECT_EQ(turn_between_deg(key(Vec3::UnitZ(), 170), key(Vec3::UnitZ(), 200)), 30);
    EXPECT_EQ(turn_between_deg(key(Vec3::UnitZ(), 100), key(-Vec3::UnitZ(), 100)), 200);
    EXPECT_EQ(turn_between_deg(key(Vec3::UnitZ(), -100), key(-Vec3::UnitZ(), 90)), 10);
    EXPECT_NEAR(turn_between_deg(key(Vec3::UnitZ(), 90), key(Vec3::UnitX(), 90)), 120, 1e-9);
}

}  // namespace
}  // namespace myotet::contraction
