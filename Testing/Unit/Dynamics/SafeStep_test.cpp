// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/SafeStep.h"

#include <gtest/gtest.h>

#include <random>

#include "Elasticity/LinearTet.h"

namespace myotet::dynamics {
namespace {

using elasticity::Corners;

const Corners kTet = {Vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0.2, 0.3, 1}};

double flat_at(const Corners& x, const Corners& by) {
    return first_flat(elasticity::edges_of(x), elasticity::edges_of(by));
}
double volume_at(const Corners& x, const Corners& by, double s) {
    return signed_volume(x[0] + s * by[0], x[1] + s * by[1], x[2] + s * by[2], x[3] + s * by[3]);
}

TEST(FirstFlat, FindsTheMomentOfASimpleCollapse) {
    Corners by{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, -2.5)};
    EXPECT_NEAR(flat_at(kTet, by), 0.4, 1e-12);
    by[3].z() = -0.99;
    EXPECT_EQ(flat_at(kTet, by), 1);
    by[3].z() = 7;
    EXPECT_EQ(flat_at(kTet, by), 1);
}

TEST(FirstFlat, FindsTheFirstOfTwoRootsAndOfThree) {
    // All corners through the middle: volume (1 - s r)^3, a triple root at 1 / r.
    Corners by;
    for (int i = 0; i < 4; ++i) by[i] = -2 * kTet[i];
    EXPECT_NEAR(flat_at(kTet, by), 0.5, 1e-4);  // a triple root is known to eps^(1/3)
    // Only x and y through the middle: (1 - s r)^2 touches zero, which is flat too.
    for (int i = 0; i < 4; ++i) by[i] = Vec3(-1.25 * kTet[i].x(), -1.25 * kTet[i].y(), 0);
    EXPECT_NEAR(flat_at(kTet, by), 0.8, 1e-6);
    // x at 0.4, y at 0.8: positive again at the end.
    for (int i = 0; i < 4; ++i) by[i] = Vec3(-2.5 * kTet[i].x(), -1.25 * kTet[i].y(), 0);
    EXPECT_GT(volume_at(kTet, by, 1), 0);
    EXPECT_NEAR(flat_at(kTet, by), 0.4, 1e-12);
}

TEST(FirstFlat, IsTheFirstOnRandomWays) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> entry(-1, 1);
    int flat = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        Corners by;
        const double size = trial % 2 ? 0.5 : 3;
        for (Vec3& p : by) p = size * Vec3(entry(random), entry(random), entry(random));
        const double s = flat_at(kTet, by);
        for (int i = 0; i < 200; ++i) ASSERT_GT(volume_at(kTet, by, 0.995 * s * i / 200), 0);
        if (s == 1) continue;
        ++flat;
        EXPECT_NEAR(volume_at(kTet, by, s), 0, 1e-9);
    }
    EXPECT_GT(flat, 300);
}

}  // namespace
}  // namespace myotet::dynamics
