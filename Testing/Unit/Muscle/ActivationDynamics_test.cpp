// SPDX-License-Identifier: Apache-2.0
#include "Muscle/ActivationDynamics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"

namespace myotet::muscle {
namespace {

const ActivationDynamics kDynamics;
constexpr double kLevels[] = {0, 1e-9, 0.01, 0.2, 0.5, 0.77, 1};
// Of a solution to rounding, after a few operations.
constexpr double kRounding = 1e-13;

// Runge and Kutta's classical method: fourth order, so 1e-10 with steps of 1/1000 of the
// shortest time constant.
double integrated(double a, double u, double seconds) {
    const int steps = static_cast<int>(std::ceil(seconds / 5e-6));
    const double h = seconds / steps;
    for (int i = 0; i < steps; ++i) {
        const double k1 = kDynamics.rate(a, u), k2 = kDynamics.rate(a + h / 2 * k1, u);
        const double k3 = kDynamics.rate(a + h / 2 * k2, u), k4 = kDynamics.rate(a + h * k3, u);
        a += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return a;
}

TEST(ActivationDynamics, StepsSolveTheEquation) {
    for (const double a : kLevels)
        for (const double u : kLevels)
            for (const double seconds : {1e-4, 0.01, 0.1})
                EXPECT_NEAR(kDynamics.after(a, u, seconds), integrated(a, u, seconds), 1e-10)
                    << a << " to " << u;
}

TEST(ActivationDynamics, TwoHalfStepsAreOneStep) {
    for (const double a : kLevels)
        for (const double u : kLevels)
            for (const double seconds : {1e-6, 0.003, 0.05, 2.0}) {
                const double half = kDynamics.after(a, u, seconds / 2);
                EXPECT_NEAR(kDynamics.after(half, u, seconds / 2), kDynamics.after(a, u, seconds),
                            kRounding);
            }
}

TEST(ActivationDynamics, NeverPassesTheExcitation) {
    for (const double a : kLevels)
        for (const double u : kLevels)
            for (const double seconds : {0.0, 1e-12, 1e-3, 1.0, 1e3, 1e300}) {
                const double after = kDynamics.after(a, u, seconds);
                EXPECT_GE(after, std::min(a, u) - kRounding);
                EXPECT_LE(after, std::max(a, u) + kRounding);
                if (seconds > 100) {
                    EXPECT_NEAR(after, u, kRounding);
                }
            }
}

TEST(ActivationDynamics, RisesFasterThanItFalls) {
    const double up = kDynamics.after(0, 1, 0.02), down = 1 - kDynamics.after(1, 0, 0.02);
    EXPECT_GT(up, down);
    EXPECT_DOUBLE_EQ(kDynamics.rate(0, 1), 1 / (0.015 * 0.5));
    EXPECT_DOUBLE_EQ(kDynamics.rate(1, 0), -2 / 0.05);
    EXPECT_EQ(kDynamics.rate(0.3, 0.3), 0);
}

TEST(ActivationDynamics, RefusesWhatHasNoMeaning) {
    EXPECT_NO_THROW(kDynamics.validate());
    EXPECT_THROW((ActivationDynamics{.rise = 0}).validate(), InputError);
    EXPECT_THROW((ActivationDynamics{.fall = std::nan("")}).validate(), InputError);
}

}  // namespace
}  // namespace myotet::muscle
