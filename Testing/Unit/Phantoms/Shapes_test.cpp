// SPDX-License-Identifier: Apache-2.0
#include "Phantoms/Shapes.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace myotet::phantoms {
namespace {

// Closed forms and bisection to the last bit: only rounding is left.
constexpr double kRounding = 1e-9;
// Central differences with a step of 1e-4 mm.
constexpr double kGradient = 1e-5;

using Field = std::function<double(const Vec3&)>;

Vec3 gradient(const Field& field, const Vec3& p) {
    constexpr double kStep = 1e-4;
    Vec3 g;
    for (int a = 0; a < 3; ++a) {
        Vec3 step = Vec3::Zero();
        step[a] = kStep;
        g[a] = (field(p + step) - field(p - step)) / (2 * kStep);
    }
    return g;
}

/// A signed distance has a gradient of length 1, and walking down it lands on the surface.
void expect_signed_distance(const Field& field, double reach) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> along(-reach, reach);
    int tried = 0;
    for (int n = 0; n < 400; ++n) {
        const Vec3 p(along(random), along(random), along(random));
        const Vec3 g = gradient(field, p);
        if (std::abs(g.norm() - 1) > 0.01) continue;  // the point lies near the medial axis
        ++tried;
        EXPECT_NEAR(g.norm(), 1, kGradient);
        EXPECT_NEAR(field(p - field(p) * g), 0, 1e-3);
    }
    EXPECT_GT(tried, 380);
}

TEST(Shapes, SphereTorusBoxAndEllipsoidAreSignedDistances) {
    const Vec3 half(18, 14, 40);
    const Box box{Vec3(-3, -4, -5), Vec3(3, 4, 5)};
    expect_signed_distance([](const Vec3& p) { return sphere_distance(p, Vec3(1, 2, 3), 9); }, 20);
    expect_signed_distance([](const Vec3& p) { return torus_distance(p, 20, 8); }, 30);
    expect_signed_distance([&](const Vec3& p) { return box_distance(p, box); }, 8);
    expect_signed_distance([&](const Vec3& p) { return ellipsoid_distance(p, half); }, 45);
}

TEST(Shapes, EllipsoidOfEqualAxesIsASphere) {
    for (const Vec3& p : {Vec3(1, 2, 3), Vec3(20, 0, 0), Vec3(-4, 30, 7)})
        EXPECT_NEAR(ellipsoid_distance(p, Vec3::Constant(10)), sphere_distance(p, Vec3::Zero(), 10),
                    kRounding);
}

TEST(Shapes, EllipsoidIsRightOnItsAxesAndAtItsCentre) {
    const Vec3 half(18, 14, 40);
    EXPECT_NEAR(ellipsoid_distance(Vec3(0, 0, 45), half), 5, kRounding);
    EXPECT_NEAR(ellipsoid_distance(Vec3(0, -20, 0), half), 6, kRounding);
    EXPECT_NEAR(ellipsoid_distance(Vec3::Zero(), half), -14, kRounding);
}

TEST(Shapes, LoftOfEqualStationsIsACylinderWithRoundEnds) {
    const Loft loft({{0, 1, 2, 5, 5}, {10, 1, 2, 5, 5}}, 3);
    EXPECT_TRUE(loft.contains(Vec3(5.99, 2, 5)));
    EXPECT_FALSE(loft.contains(Vec3(6.01, 2, 5)));
    EXPECT_TRUE(loft.contains(Vec3(1, 2, 12.99)));
    EXPECT_FALSE(loft.contains(Vec3(1, 2, 13.01)));
    // Half way up the cap the section has shrunk to sqrt(1 - 1/4).
    const double shrunk = 5 * std::sqrt(0.75);
    EXPECT_TRUE(loft.contains(Vec3(1 + shrunk - 0.01, 2, -1.5)));
    EXPECT_FALSE(loft.contains(Vec3(1 + shrunk + 0.01, 2, -1.5)));
}

TEST(Shapes, LoftPassesThroughItsStationsAndStaysInItsBox) {
    const Loft loft({{0, 0, 0, 3, 3}, {4, 2, 1, 8, 5}, {9, 2, -3, 8, 6}, {15, -1, 0, 2, 2}}, 2,
                    2.5);
    EXPECT_TRUE(loft.contains(Vec3(2 + 7.99, 1, 4)));
    EXPECT_FALSE(loft.contains(Vec3(2 + 8.01, 1, 4)));
    EXPECT_FALSE(loft.contains(Vec3(2 + 8.01, -1, 6.5)));  // monotone: no wider in between
    std::mt19937 random(5);
    std::uniform_real_distribution<double> along(-20, 20);
    for (int n = 0; n < 20000; ++n) {
        const Vec3 p(along(random), along(random), along(random));
        if (!loft.contains(p)) continue;
        EXPECT_TRUE((p.array() >= loft.box().min.array()).all() &&
                    (p.array() <= loft.box().max.array()).all());
    }
}

}  // namespace
}  // namespace myotet::phantoms
