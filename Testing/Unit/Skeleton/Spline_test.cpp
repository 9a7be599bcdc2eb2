// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Spline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"

namespace myotet::skeleton {
namespace {

// Of an elimination with a few dozen well-conditioned blocks.
constexpr double kRounding = 1e-9;

const std::vector<double> kX{0, 0.3, 0.5, 1.1, 1.2, 2, 2.7};
const std::vector<double> kY{1, 2, -1, 0, 0.5, 3, 1};

TEST(Spline, PassesItsPointsWithoutJumpsOfDerivatives) {
    const double h = 1e-7;
    for (const int degree : {3, 5})
        for (const SplineEnds ends : {SplineEnds::natural, SplineEnds::at_rest}) {
            const Spline s = spline_through(kX, kY, degree, ends);
            for (std::size_t i = 0; i < kX.size(); ++i) {
                EXPECT_NEAR(evaluate(s, kX[i]).value, kY[i], kRounding);
                const auto before = evaluate(s, kX[i] - h), after = evaluate(s, kX[i] + h);
                // Steps of h times third derivatives near 1e4.
                EXPECT_NEAR(before.slope, after.slope, 1e-2);
                EXPECT_NEAR(before.bend, after.bend, 1e-1) << degree;
            }
        }
}

// The third and fourth derivative of one of degree 5, by differences of bends within pieces.
TEST(Spline, OfDegreeFiveIsSmoothToTheFourthDerivative) {
    const Spline s = spline_through(kX, kY, 5, SplineEnds::natural);
    const double h = 1e-3;
    const auto bend = [&](double x) { return evaluate(s, x).bend; };
    for (std::size_t i = 1; i + 1 < kX.size(); ++i) {
        // One-sided differences of third order on each side of the knot.
        const auto third = [&](double sign) {
            const double d = sign * h;
            return (-11 * bend(kX[i] + 1e-13 * sign) + 18 * bend(kX[i] + d) -
                    9 * bend(kX[i] + 2 * d) + 2 * bend(kX[i] + 3 * d)) /
                   (6 * d);
        };
        EXPECT_NEAR(third(-1), third(1), 1e-6 * std::abs(third(1)) + 1e-4);
    }
}

TEST(Spline, NaturalEndsReproduceWhatNeedsNoEnergy) {
    for (const int degree : {3, 5}) {
        std::vector<double> y;
        const double square = degree == 5 ? 0.7 : 0;
        for (const double x : kX) y.push_back(2 - 3 * x + square * x * x);
        const Spline s = spline_through(kX, y, degree, SplineEnds::natural);
        for (double x = 0; x < 2.7; x += 0.1) {
            EXPECT_NEAR(evaluate(s, x).value, 2 - 3 * x + square * x * x, kRounding);
            EXPECT_NEAR(evaluate(s, x).slope, -3 + 2 * square * x, kRounding);
            EXPECT_NEAR(evaluate(s, x).bend, 2 * square, 1e-8);
        }
    }
}

TEST(Spline, CubicIsTheNaturalSplineOfFunctions) {
    const Spline s = spline_through(kX, kY, 3, SplineEnds::natural);
    const Function f = natural_spline(kX, kY);
    for (double x = 0; x < 2.7; x += 0.07) {
        EXPECT_NEAR(evaluate(s, x).value, evaluate(f, x).value, kRounding);
        EXPECT_NEAR(evaluate(s, x).bend, evaluate(f, x).bend, 1e-8);
    }
}

TEST(Spline, AtRestItsEndsStandStill) {
    for (const int degree : {3, 5}) {
        const Spline s = spline_through(kX, kY, degree, SplineEnds::at_rest);
        for (const double end : {0.0, 2.7}) {
            EXPECT_NEAR(evaluate(s, end).slope, 0, kRounding);
            if (degree == 5) {
                EXPECT_NEAR(evaluate(s, end).bend, 0, 1e-8);
            }
        }
    }
    // Two points: 3 t^2 - 2 t^3, and 10 t^3 - 15 t^4 + 6 t^5.
    const std::vector<double> x{0, 2}, y{1, 3};
    EXPECT_NEAR(evaluate(spline_through(x, y, 3, SplineEnds::at_rest), 0.5).value,
                1 + 2 * (3.0 / 16 - 2.0 / 64), kRounding);
    EXPECT_NEAR(evaluate(spline_through(x, y, 5, SplineEnds::at_rest), 0.5).value,
                1 + 2 * (10.0 / 64 - 15.0 / 256 + 6.0 / 1024), kRounding);
}

// The error of a natural spline inside falls with the power degree + 1 of the distance of
// its points; of its acceleration with two powers less.
TEST(Spline, ErrorFallsWithTheOrderOfItsDegree) {
    const auto errors = [](int degree, int n) {
        std::vector<double> x, y;
        for (int i = 0; i <= n; ++i) {
            x.push_back(4.0 * i / n);
            y.push_back(std::sin(3 * x.back()));
        }
        const Spline s = spline_through(x, y, degree, SplineEnds::natural);
        double worst = 0, worst_bend = 0;
        for (double at = 1.5; at < 2.5; at += 0.003) {
            worst = std::max(worst, std::abs(evaluate(s, at).value - std::sin(3 * at)));
            worst_bend =
                std::max(worst_bend, std::abs(evaluate(s, at).bend + 9 * std::sin(3 * at)));
        }
        return std::pair{worst, worst_bend};
    };
    for (const int degree : {3, 5}) {
        const auto [coarse, coarse_bend] = errors(degree, 40);
        const auto [fine, fine_bend] = errors(degree, 80);
        EXPECT_GT(std::log2(coarse / fine), degree + 0.7);
        EXPECT_GT(std::log2(coarse_bend / fine_bend), degree - 1.3);
    }
}

TEST(Spline, PointsThatMakeNoneAreRefused) {
    const std::vector<double> two{0, 1}, three{0, 1, 1}, one{0};
    EXPECT_THROW((void)spline_through(one, one, 3, SplineEnds::natural), InputError);
    EXPECT_THROW((void)spline_through(two, two, 5, SplineEnds::natural), InputError);
    EXPECT_THROW((void)spline_through(two, two, 4, SplineEnds::natural), InputError);
    EXPECT_THROW((void)spline_through(three, three, 3, SplineEnds::natural), InputError);
    EXPECT_THROW((void)spline_through(two, three, 3, SplineEnds::natural), InputError);
}

}  // namespace
}  // namespace myotet::skeleton
