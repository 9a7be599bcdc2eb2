// SPDX-License-Identifier: Apache-2.0
#include "Muscle/Bezier.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"

namespace myotet::muscle {
namespace {

// Central differences over this step err by its square times the third derivative.
constexpr double kStep = 1e-6, kDifference = 1e-6, kRounding = 1e-12;
const std::vector<CurveKnot> kKnots = {{0, 0, 0}, {1, 0.5, 2}, {2, 2, 0.1}};

TEST(Bezier, PassesItsKnotsWithTheirSlopes) {
    const BezierCurve curve(kKnots, {0.75});
    for (const CurveKnot& knot : kKnots) {
        EXPECT_NEAR(curve(knot.x).value, knot.y, kRounding);
        EXPECT_NEAR(curve(knot.x).slope, knot.slope, kRounding);
        // No bend at a knot.
        EXPECT_NEAR(curve(knot.x + 1e-5).slope, curve(knot.x - 1e-5).slope, 1e-6);
    }
}

TEST(Bezier, SlopeIsThatOfTheValue) {
    const BezierCurve curve(kKnots, {0.2, 0.9});
    for (double x = -0.5; x < 2.5; x += 0.013)
        EXPECT_NEAR((curve(x + kStep).value - curve(x - kStep).value) / (2 * kStep), curve(x).slope,
                    kDifference)
            << x;
}

TEST(Bezier, GoesStraightOnBeyondItsEnds) {
    const BezierCurve curve(kKnots, {0.5});
    EXPECT_EQ(curve(-3).value, 0);
    EXPECT_NEAR(curve(5).value, 2 + 0.1 * 3, kRounding);
    EXPECT_EQ(BezierCurve()(0.7).value, 0);
}

TEST(Bezier, KeepsBetweenChordAndCorner) {
    // Tangents y = 0 and y = 2 x - 1.5 meet at (0.75, 0).
    const BezierCurve little(kKnots, {0}), much(kKnots, {1});
    for (double x = 0.02; x < 0.99; x += 0.05) {
        const double chord = 0.5 * x, corner = std::max(0.0, 2 * x - 1.5);
        EXPECT_LT(little(x).value, chord);
        EXPECT_LT(much(x).value, little(x).value);
        EXPECT_GT(much(x).value, corner);
    }
}

TEST(Bezier, OfAStraightLineIsStraight) {
    const BezierCurve curve({{1, 1, 3}, {2, 4, 3}}, {0.4});
    for (double x = 0; x < 3; x += 0.1) EXPECT_NEAR(curve(x).value, 1 + 3 * (x - 1), kRounding);
}

TEST(Bezier, RefusesTangentsThatDoNotMeetBetween) {
    EXPECT_THROW(BezierCurve({{0, 0, 0}, {1, 1, 0.5}}, {0.5}), InputError);
    EXPECT_THROW(BezierCurve({{1, 0, 0}, {0, 1, 2}}, {0.5}), InputError);
    EXPECT_THROW(BezierCurve(kKnots, {1.5}), InputError);
    EXPECT_THROW(BezierCurve(kKnots, {std::nan("")}), InputError);
}

}  // namespace
}  // namespace myotet::muscle
