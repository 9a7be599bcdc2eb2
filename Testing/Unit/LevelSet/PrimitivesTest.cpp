// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "LevelSet/Primitives.h"

namespace myotet::levelset {
namespace {

constexpr double kPi = std::numbers::pi;
// Twenty million products of doubles near 10 lose about this.
constexpr double kRounding = 1e-9;

using Solid = std::function<double(const Vec3&)>;

struct Case {
    const char* name;
    Solid distance;
    double volume;  // mm^3
};

const Vec3 kSemi(9, 5, 3);
const RoundCone kCapsule{{-4, 0, 1}, {5, 3, 1}, 3, 3};
const RoundCone kRound{{-4, 0, 1}, {6, 0, 1}, 4, 2};
const RoundCone kCone{{0, -2, -5}, {0, -2, 6}, 6, 2};
const RoundCone kCylinder{{-3, -1, -5}, {2, 2, 6}, 4, 4};

// The side touches the balls in circles, r sine and s sine beyond their
// centres: a large part of one ball, the frustum between, a cap of the other.
double round_cone_volume(double r, double s, double length) {
    const double sine = (r - s) / length, cosine = std::sqrt(1 - sine * sine);
    const auto cap = [](double radius, double h) { return kPi * h * h * (3 * radius - h) / 3; };
    const double height = length - (r - s) * sine, a = r * cosine, b = s * cosine;
    return cap(r, r * (1 + sine)) + kPi * height * (a * a + a * b + b * b) / 3 +
           cap(s, s * (1 - sine));
}

std::vector<Case> cases() {
    const double along = (kCylinder.to - kCylinder.from).norm();
    const double capsule = (kCapsule.to - kCapsule.from).norm();
    return {
        {"sphere", [](const Vec3& p) { return sphere_distance(p, Vec3(1, 2, 0), 6); },
         4.0 / 3 * kPi * 216},
        {"ellipsoid", [](const Vec3& p) { return ellipsoid_distance(p, kSemi); },
         4.0 / 3 * kPi * kSemi.prod()},
        {"capsule", [](const Vec3& p) { return round_cone_distance(p, kCapsule); },
         kPi * 9 * capsule + 4.0 / 3 * kPi * 27},
        {"round cone", [](const Vec3& p) { return round_cone_distance(p, kRound); },
         round_cone_volume(4, 2, 10)},
        {"cone", [](const Vec3& p) { return cone_distance(p, kCone); },
         kPi * 11 * (36 + 12 + 4) / 3},
        {"cylinder", [](const Vec3& p) { return cone_distance(p, kCylinder); }, kPi * 16 * along},
        {"box", [](const Vec3& p) { return box_distance(p, Vec3(4, 2, 7)); }, 8 * 4 * 2 * 7},
        {"torus", [](const Vec3& p) { return torus_distance(p, 7, 2); }, 2 * kPi * kPi * 7 * 4},
    };
}

TEST(Primitives, volumes_have_their_closed_forms) {
    // 0.2 mm cells: those at the surface, 0.2 mm * area, err by a random half.
    constexpr double kStep = 0.2, kRelative = 0.005;
    for (const Case& solid : cases()) {
        double count = 0;
        for (double z = -12; z < 12; z += kStep)
            for (double y = -12; y < 12; y += kStep)
                for (double x = -12; x < 12; x += kStep)
                    count += solid.distance(Vec3(x + 0.07, y + 0.03, z + 0.11)) < 0;
        EXPECT_NEAR(count * std::pow(kStep, 3), solid.volume, kRelative * solid.volume)
            << solid.name;
    }
}

TEST(Primitives, values_are_distances) {
    // From p along minus the gradient by the distance lies the surface, and no
    // nearer point does: a distance changes by no more than the way, and its
    // gradient has length one where it has one.
    constexpr double kStep = 1e-5, kSlope = 1e-3;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-11, 11);
    for (const Case& solid : cases()) {
        int smooth = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3 p(coordinate(random), coordinate(random), coordinate(random));
            Vec3 gradient;
            for (int a = 0; a < 3; ++a)
                gradient[a] = (solid.distance(p + kStep * Vec3::Unit(a)) -
                               solid.distance(p - kStep * Vec3::Unit(a))) /
                              (2 * kStep);
            EXPECT_LE(gradient.norm(), 1 + kSlope) << solid.name;
            if (std::abs(gradient.norm() - 1) > kSlope) continue;  // a ridge
            ++smooth;
            const double d = solid.distance(p);
            EXPECT_NEAR(solid.distance(p - d * gradient), 0, 11 * kSlope) << solid.name;
        }
        EXPECT_GT(smooth, 1900) << solid.name;
    }
}

TEST(Primitives, ellipsoid_is_right_on_its_axes_and_as_a_sphere) {
    EXPECT_NEAR(ellipsoid_distance(Vec3::Zero(), kSemi), -3, kRounding);
    EXPECT_NEAR(ellipsoid_distance(Vec3(12, 0, 0), kSemi), 3, kRounding);
    EXPECT_NEAR(ellipsoid_distance(Vec3(0, 0, -4), kSemi), 1, kRounding);
    EXPECT_NEAR(ellipsoid_distance(Vec3(1, 2, 2), Vec3(5, 5, 5)), -2, kRounding);
}

TEST(Primitives, a_round_cone_with_one_ball_inside_the_other_is_that_ball) {
    const RoundCone swallowed{Vec3::Zero(), Vec3(1, 0, 0), 5, 2};
    EXPECT_NEAR(round_cone_distance(Vec3(9, 0, 0), swallowed), 4, kRounding);
    EXPECT_NEAR(round_cone_distance(Vec3(-9, 0, 0), swallowed), 4, kRounding);
}

TEST(Primitives, a_half_space_ends_at_its_plane) {
    const Vec3 outward = Vec3(1, 2, 2) / 3;
    EXPECT_NEAR(half_space_distance(Vec3(3, 6, 6), Vec3(1, 2, 2), outward), 6, kRounding);
    EXPECT_NEAR(half_space_distance(Vec3::Zero(), Vec3(1, 2, 2), outward), -3, kRounding);
}

}  // namespace
}  // namespace myotet::levelset
