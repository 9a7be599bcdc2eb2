// SPDX-License-Identifier: Apache-2.0
#include "Surface/Field.h"

#include <gtest/gtest.h>

#include "SurfaceShapes.h"

namespace myotet::surface {
namespace {

constexpr double kReach = 1;
constexpr double kClose = 1e-4;  // of the reach: what project promises

/// |z| < half: a sheet with a kink of phi half way through.
Field slab(double half) {
    return [half](const Vec3& p) {
        return FieldSample{std::abs(p[2]) - half, Vec3(0, 0, p[2] < 0 ? -1 : 1)};
    };
}

TEST(Field, a_point_comes_to_the_nearer_side_of_a_thin_sheet) {
    for (const double z : {0.04, 0.2, -0.01, -0.5}) {
        const auto at = project(slab(0.05), {3, 4, z}, kReach);
        ASSERT_TRUE(at);
        EXPECT_NEAR((*at)[2], z > 0 ? 0.05 : -0.05, kClose);
        EXPECT_EQ((*at)[0], 3);
    }
}

TEST(Field, no_zero_within_reach_is_said) {
    EXPECT_FALSE(project(ball_field({0, 0, 0}, 1), {9, 0, 0}, kReach));
    EXPECT_FALSE(
        project(ball_field({0, 0, 0}, 1), half_space({5, 0, 0}, {1, 0, 0}), {1, 0, 0}, kReach));
}

TEST(Field, two_at_once) {
    const Field phi = ball_field({0, 0, 0}, 2), psi = half_space({0, 0, 1}, {0, 0.3, 1});
    const auto at = project(phi, psi, {1.6, 0.2, 1.3}, kReach);
    ASSERT_TRUE(at);
    EXPECT_NEAR(phi(*at).value, 0, kClose);
    EXPECT_NEAR(psi(*at).value, 0, kClose);
}

TEST(Field, thickness_is_that_of_the_sheet_or_of_the_gap) {
    // Steps are at least a sixteenth of the limit.
    constexpr double kLimit = 2, kStep = kLimit / 16;
    EXPECT_NEAR(thickness(slab(0.3), {0, 0, 0.3}, kLimit), 0.6, kStep);
    const Field gap = [](const Vec3& p) {
        FieldSample s = slab(0.4)(p);
        return FieldSample{-s.value, -s.gradient};
    };
    EXPECT_NEAR(thickness(gap, {0, 0, 0.4}, kLimit), 0.8, kStep);
    EXPECT_EQ(thickness(half_space({0, 0, 0}, {0, 0, 1}), {0, 0, 0}, kLimit), kLimit);
}

}  // namespace
}  // namespace myotet::surface
