// SPDX-License-Identifier: Apache-2.0
#include "Meshing/AngleEnergy.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numbers>

using namespace myotet;
using namespace myotet::meshing;

namespace {

const Badness kBadness({.max_dihedral_deg = 116, .min_dihedral_deg = 28, .max_aspect_ratio = 3.4});

// Central differences with step 1e-6 of terms to the eighth power: truncation 1e-12
// times third derivatives, which are some 1e4 times the value; rounding 1e-16 / 1e-6.
constexpr double kStep = 1e-6, kGradientTolerance = 1e-6;
// The goal's constants are given to six digits.
constexpr double kGoalTolerance = 1e-5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// `count` of the eight tetrahedra of a skewed octahedron around the origin.
AngleEnergy ring(int count) {
    const Vec3 x[3] = {{1, 0.1, 0}, {-0.2, 1.1, 0.1}, {0.1, 0, 0.8}};
    AngleEnergy star;
    star.reset(count);
    for (int s = 0; s < count; ++s) {
        Vec3 p = s & 1 ? Vec3(-x[0]) : x[0], q = s & 2 ? Vec3(-x[1]) : x[1],
             r = s & 4 ? Vec3(-x[2]) : x[2];
        if ((q - p).cross(r - p).dot(-p) < 0) std::swap(q, r);
        star.add(p, q, r);
    }
    return star;
}

// A tetrahedron with the dihedral angle `degrees` at its edge of length 1.
double badness_at(double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    const Vec3 a(0, 0, -0.5), b(0, 0, 0.5), c(std::cos(half), -std::sin(half), 0),
        d(std::cos(half), std::sin(half), 0);
    return kBadness(a, b, c, d);
}

}  // namespace

TEST(AngleEnergy, GradientIsThatOfTheValue) {
    for (const int count : {1, 3, 4, 8}) {
        const AngleEnergy star = ring(count);
        const Vec3 x(0.07, -0.05, 0.04);
        const Expansion e = star.expand(x);
        EXPECT_NEAR(e.value, star.value(x), 1e-12 * e.value);
        for (int i = 0; i < 3; ++i) {
            const Vec3 d = kStep * Vec3::Unit(i);
            const double slope = (star.value(x + d) - star.value(x - d)) / (2 * kStep);
            EXPECT_NEAR(e.gradient[i], slope, kGradientTolerance * e.gradient.norm()) << count;
        }
    }
}

TEST(AngleEnergy, HessianIsPositiveDefinite) {
    for (const int count : {1, 3, 8})
        for (const double t : {0.0, 0.1, 0.25}) {
            const Mat3 h = ring(count).expand(Vec3(t, -0.5 * t, 0.3 * t)).hessian;
            EXPECT_GT(Eigen::SelfAdjointEigenSolver<Mat3>(h).eigenvalues()[0], 0);
        }
}

TEST(AngleEnergy, NewtonsStepDescends) {
    const AngleEnergy star = ring(8);
    const Vec3 x(0.2, -0.1, 0.15);
    const Expansion e = star.expand(x);
    const Vec3 step = -e.hessian.inverse() * e.gradient;
    EXPECT_LT(star.value(x + 0.5 * step), e.value);
}

TEST(AngleEnergy, IsInfiniteWhereAVolumeIsNotPositive) {
    const AngleEnergy star = ring(8);
    EXPECT_EQ(star.value({5, 0, 0}), kInfinity);
    EXPECT_EQ(star.expand({5, 0, 0}).value, kInfinity);
    EXPECT_EQ(kBadness({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}), kInfinity);
    EXPECT_EQ(kBadness({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}), kInfinity);
}

TEST(AngleEnergy, BadnessIsOneAtTheGoal) {
    EXPECT_NEAR(badness_at(116), 1, kGoalTolerance);
    EXPECT_LT(badness_at(110), 1);
    EXPECT_GT(badness_at(120), 1);
    // At 28 degrees the aspect ratio is worse than the angle: the larger counts.
    EXPECT_GE(badness_at(28), 1 - kGoalTolerance);
}

TEST(AngleEnergy, BadnessKnowsNoScaleNorOrderOfNodes) {
    const Vec3 a(0, 0, 0), b(1, 0.1, 0), c(0.2, 0.9, 0.1), d(0.3, 0.2, 0.5);
    const double bad = kBadness(a, b, c, d);
    // Sums are taken in another order.
    constexpr double kRounding = 1e-12;
    EXPECT_NEAR(kBadness(b, c, a, d), bad, kRounding * bad);
    EXPECT_NEAR(kBadness(b, a, d, c), bad, kRounding * bad);
    EXPECT_NEAR(kBadness(7 * a, 7 * b, 7 * c, 7 * d), bad, kRounding * bad);
}
