// SPDX-License-Identifier: Apache-2.0
#include "Muscle/ForceVelocity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"

namespace myotet::muscle {
namespace {

constexpr double kStep = 1e-6, kDifference = 1e-8, kRounding = 1e-12;

TEST(ForceVelocity, IsHillsWhenShortening) {
    // Hill 1938: (f + a) (b - v) is constant, a = shape, b = shape max_speed.
    const ForceVelocity curve;
    for (double speed = -10; speed <= 0; speed += 0.25)
        EXPECT_NEAR((curve.value(speed) + curve.shape) * (curve.shape * curve.max_speed - speed),
                    (1 + curve.shape) * curve.shape * curve.max_speed, 1e-11);
    EXPECT_EQ(curve.value(0), 1);
    EXPECT_EQ(curve.value(-10), 0);
    EXPECT_EQ(curve.value(-25), 0) << "a muscle never pushes";
}

TEST(ForceVelocity, ApproachesItsMostWhenLengthening) {
    const ForceVelocity curve;
    double before = 1;
    for (double speed = 0.1; speed < 1e6; speed *= 2) {
        EXPECT_GT(curve.value(speed), before);
        before = curve.value(speed);
    }
    EXPECT_LT(before, curve.most);
    EXPECT_NEAR(before, curve.most, 1e-5);
}

TEST(ForceVelocity, SlopeIsThatOfTheValueAndDoesNotJumpAtRest) {
    const ForceVelocity curve;
    for (double speed = -12.05; speed < 20; speed += 0.3)
        EXPECT_NEAR((curve.value(speed + kStep) - curve.value(speed - kStep)) / (2 * kStep),
                    curve.slope(speed), kDifference);
    EXPECT_NEAR(curve.slope(1e-12), curve.slope(-1e-12), kRounding * 10);
    EXPECT_NEAR(curve.slope(0), (1 + 1 / curve.shape) / curve.max_speed, kRounding);
}

TEST(ForceVelocity, RefusesWhatHasNoMeaning) {
    EXPECT_NO_THROW(ForceVelocity{}.validate());
    EXPECT_THROW(ForceVelocity{.max_speed = 0}.validate(), InputError);
    EXPECT_THROW(ForceVelocity{.shape = std::nan("")}.validate(), InputError);
    EXPECT_THROW(ForceVelocity{.most = 1}.validate(), InputError);
}

}  // namespace
}  // namespace myotet::muscle
