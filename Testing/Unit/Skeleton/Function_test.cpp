// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Function.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"

namespace myotet::skeleton {
namespace {

constexpr double kRounding = 1e-12;
// Of central differences over 1e-4 of functions with derivatives near 10: h^2 f'''.
constexpr double kDifferences = 1e-5;

Function of(FunctionKind kind, std::vector<double> coefficients, double scale) {
    Function f;
    f.kind = kind;
    f.coefficients = std::move(coefficients);
    f.scale = scale;
    return f;
}

std::vector<Function> all_kinds() {
    return {constant_function(3),
            of(FunctionKind::linear, {2, -1}, 1.5),
            of(FunctionKind::polynomial, {0.5, -1, 2, 3}, -2),
            of(FunctionKind::sine, {2, 1.5, 0.3, 4}, 0.5),
            natural_spline({0, 0.7, 1.5, 3}, {1, 2, 0, 1}),
            simm_spline({0, 0.7, 1.5, 3}, {1, 2, 0, 1}),
            simm_spline({0, 0.7, 1.5}, {1, 2, 0}),
            piecewise_linear({0, 0.7, 1.5, 3}, {1, 2, 0, 1})};
}

TEST(Function, DerivativesAreThoseOfTheValue) {
    const double h = 1e-4;
    for (const Function& f : all_kinds())
        for (double x = -1.03; x < 4; x += 0.37) {
            const auto before = evaluate(f, x - h), after = evaluate(f, x + h);
            const auto here = evaluate(f, x);
            EXPECT_NEAR(here.slope, (after.value - before.value) / (2 * h), kDifferences);
            EXPECT_NEAR(here.bend, (after.slope - before.slope) / (2 * h), kDifferences);
        }
}

TEST(Function, SplinesPassTheirPointsAndAreStraightBeyond) {
    const std::vector<double> x{0, 0.7, 1.5, 3}, y{1, 2, 0, 1};
    for (const Function& f : {natural_spline(x, y), simm_spline(x, y), piecewise_linear(x, y)}) {
        for (std::size_t i = 0; i < x.size(); ++i)
            EXPECT_NEAR(evaluate(f, x[i]).value, y[i], kRounding);
        EXPECT_NEAR(evaluate(f, 5).value, 1 + 2 * evaluate(f, 3).slope, kRounding);
        EXPECT_EQ(evaluate(f, -1).bend, 0);
    }
}

TEST(Function, NaturalSplinesDoNotBendAtTheirEnds) {
    const Function f = natural_spline({0, 0.7, 1.5, 3}, {1, 2, 0, 1});
    EXPECT_NEAR(evaluate(f, 0).bend, 0, kRounding);
    EXPECT_NEAR(evaluate(f, 3).bend, 0, kRounding);
    EXPECT_NEAR(evaluate(natural_spline({1, 3}, {2, 4}), 2).value, 3, kRounding);
}

// Its end conditions hold exactly for any cubic, and for a parabola through three points.
TEST(Function, SplinesOfSimmAreExactForCubics) {
    const auto cubic = [](double x) { return 2 + x * (-1 + x * (0.5 + 0.3 * x)); };
    const std::vector<double> x{-1, 0, 0.5, 2, 2.5};
    std::vector<double> y;
    for (const double knot : x) y.push_back(cubic(knot));
    const Function f = simm_spline(x, y);
    for (double at = -1; at <= 2.5; at += 0.1) EXPECT_NEAR(evaluate(f, at).value, cubic(at), 1e-11);
    const Function parabola = simm_spline({0, 1, 3}, {0, 1, 9});
    EXPECT_NEAR(evaluate(parabola, 2).value, 4, kRounding);
}

TEST(Function, AnotherUnitOfTheInputIsTheSameFunction) {
    for (const Function& f : all_kinds())
        for (double x = -1.03; x < 4; x += 0.37) {
            const auto a = evaluate(f, x), b = evaluate(with_input_unit(f, 1000), 1000 * x);
            EXPECT_NEAR(b.value, a.value, 1e-11);
            EXPECT_NEAR(1000 * b.slope, a.slope, 1e-11);
            EXPECT_NEAR(1e6 * b.bend, a.bend, 1e-10);
        }
}

TEST(Function, PointsThatMakeNoneAreRefused) {
    EXPECT_THROW((void)natural_spline({0}, {1}), InputError);
    EXPECT_THROW((void)simm_spline({0, 1}, {1}), InputError);
    EXPECT_THROW((void)piecewise_linear({0, 1, 1}, {1, 2, 3}), InputError);
    EXPECT_THROW((void)natural_spline({0, std::nan("")}, {1, 2}), InputError);
}

}  // namespace
}  // namespace myotet::skeleton
