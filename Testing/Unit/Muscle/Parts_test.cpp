// SPDX-License-Identifier: Apache-2.0
#include "Muscle/Parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace myotet::muscle {
namespace {

TEST(SquaredAcosh, IsItsDefinition) {
    for (const double t : {1e-300, 1e-15, 1e-9, 1e-4, 0.0199, 0.0201, 0.3, 2.0, 50.0}) {
        // acosh(1 + t) = 2 asinh(sqrt(t / 2)) keeps its digits near 1.
        const double w = 1 + t, near = w - 1;
        const double angle = 2 * std::asinh(std::sqrt(near / 2));
        const SquaredAcosh h = squared_acosh(w);
        EXPECT_NEAR(h.value, angle * angle, 4e-15 * angle * angle);
        if (near == 0) continue;
        const double slope = 2 * angle / std::sqrt(near * (2 + near));
        EXPECT_NEAR(h.slope / slope, 1, 1e-14);
        // (w^2 - 1) h'' + w h' = 2
        const double left = near * (2 + near) * h.curvature + w * h.slope;
        EXPECT_NEAR(left, 2, 1e-13 * (2 + w));
    }
}

TEST(SquaredAcosh, IsSmoothAtOneAndWhereTheSeriesEnds) {
    const SquaredAcosh one = squared_acosh(1);
    EXPECT_EQ(one.value, 0);
    EXPECT_EQ(one.slope, 2);
    EXPECT_EQ(one.curvature, -2.0 / 3);
    // What is 1 but for rounding may come out less.
    EXPECT_NEAR(squared_acosh(1 - 1e-15).slope, 2, 1e-14);
    const SquaredAcosh below = squared_acosh(1.02 - 1e-15), above = squared_acosh(1.02 + 1e-15);
    EXPECT_NEAR(below.value, above.value, 1e-14);
    EXPECT_NEAR(below.slope, above.slope, 1e-14);
    // The closed form loses rounding / (w^2 - 1).
    EXPECT_NEAR(below.curvature, above.curvature, 1e-13);
}

TEST(FibreShear, ShearsWithTwiceItsConstants) {
    // Simple shear g along the fibre z: W = G1 g^2. Across: W = G2 (2 asinh(g / 2))^2.
    const FibreShear shear{0.3, 0.7};
    for (const double g : {1e-3, 0.1, 1.0}) {
        Mat3 along = Mat3::Identity(), across = Mat3::Identity();
        along(2, 0) = g;
        across(1, 0) = g;
        const double angle = 2 * std::asinh(g / 2);
        EXPECT_NEAR(shear.energy(deform(along, Vec3::UnitZ()).I), 0.3 * g * g, 1e-14);
        EXPECT_NEAR(shear.energy(deform(across, Vec3::UnitZ()).I), 0.7 * angle * angle, 1e-14);
    }
}

TEST(FibreShear, DoesNotFeelVolumeOrStretchAlongTheFibre) {
    const FibreShear shear{0.3, 0.7};
    for (const double l : {0.5, 1.0, 2.5}) {
        const Mat3 F = Vec3(1 / std::sqrt(l), 1 / std::sqrt(l), l).asDiagonal();
        for (const double size : {0.7, 1.0, 1.6})
            EXPECT_NEAR(shear.energy(deform(size * F, Vec3::UnitZ()).I), 0, 1e-14);
    }
}

TEST(Fibres, StretchIsOfTheFibreWithOrWithoutVolume) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> entry(-0.3, 0.3);
    for (int trial = 0; trial < 10; ++trial) {
        Mat3 F = Mat3::Identity();
        for (int i = 0; i < 9; ++i) F.data()[i] += entry(random);
        const Vec3 fibre = Vec3(entry(random), 1, entry(random)).normalized();
        const Deformation at = deform(F, fibre);
        const double full = (F * fibre).norm(), J = F.determinant();
        EXPECT_NEAR(Fibres{.isochoric = false}.stretch(at.I), full, 1e-14);
        EXPECT_NEAR(Fibres{.isochoric = true}.stretch(at.I), full / std::cbrt(J), 1e-14);
    }
}

}  // namespace
}  // namespace myotet::muscle
