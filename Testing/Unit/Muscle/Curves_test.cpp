// SPDX-License-Identifier: Apache-2.0
#include "Muscle/Curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace myotet::muscle {
namespace {

// Central differences over this step err by its square times the third derivative, which is
// at most rate^3 times the value, and by rounding / step.
constexpr double kStep = 1e-6, kDifference = 1e-8;
// One side of a joint and the other, this far from it.
constexpr double kBeside = 1e-9;
constexpr double kRounding = 1e-12;

std::vector<double> stretches() {
    std::vector<double> all;
    for (double x = 0.3003; x < 2; x += 0.0137) all.push_back(x);
    return all;
}
template <class Function>
double difference(Function&& f, double x) {
    return (f(x + kStep) - f(x - kStep)) / (2 * kStep);
}
template <class Curve>
void expect_derivatives(const Curve& curve) {
    for (const double x : stretches()) {
        const double scale = 1 + std::abs(curve.value(x)) + std::abs(curve.slope(x));
        EXPECT_NEAR(difference([&](double t) { return curve.value(t); }, x), curve.slope(x),
                    kDifference * scale);
        EXPECT_NEAR(difference([&](double t) { return curve.integral(t); }, x), curve.value(x),
                    kDifference * scale);
    }
}
template <class Function>
double jump(Function&& f, double x) {
    return f(x + kBeside) - f(x - kBeside);
}
template <class Curve>
double slope_jump(const Curve& curve, double x) {
    return jump([&](double t) { return curve.slope(t); }, x);
}
template <class Curve>
void expect_continuous(const Curve& curve, const std::vector<double>& joints) {
    for (const double x : joints) {
        const double steep = kBeside * 2 * (1 + std::abs(curve.slope(x + kBeside)));
        EXPECT_LE(std::abs(jump([&](double t) { return curve.value(t); }, x)), 2 * steep) << x;
        EXPECT_LE(std::abs(jump([&](double t) { return curve.integral(t); }, x)),
                  2 * kBeside * (1 + std::abs(curve.value(x + kBeside))));
    }
}
const std::vector<double> kActiveJoints = {0.4, 0.6, 1, 1.4, 1.6};

// The toes of muscle and tendon; a joint at 1 and one where they become straight.
struct Toe {
    double scale, rate, linear_from;
};
const std::vector<Toe> kToes = {{0.05, 6.6, 1.4}, {2.7, 46.4, 1.03}, {0.05, 6.6, 1}, {1, 1e-3, 3}};

TEST(ActiveCurve, SlopeAndIntegralAreThoseOfTheValue) {
    expect_derivatives(kBlemkerActive);
    expect_derivatives(kTeranActive);
}

TEST(ActiveCurve, IsOneAtItsPeakAndNothingFarAway) {
    for (const ActiveCurve& curve : {kBlemkerActive, kTeranActive}) {
        EXPECT_EQ(curve.value(1), 1);
        EXPECT_EQ(curve.slope(1), 0);
        for (const double x : {0.0, 0.3, 0.4 - kBeside, 1.6 + kBeside, 5.0}) {
            EXPECT_EQ(curve.value(x), 0);
            EXPECT_EQ(curve.slope(x), 0);
        }
        EXPECT_EQ(curve.integral(0.4), 0);
        EXPECT_NEAR(curve.integral(9), 2 * curve.integral(1), kRounding);
        for (const double x : stretches()) {
            EXPECT_GE(curve.integral(x), 0);
            EXPECT_NEAR(curve.value(2 - x), curve.value(x), kRounding);
        }
    }
}

TEST(ActiveCurve, TeransHasNoKinksAndBlemkersTwo) {
    expect_continuous(kTeranActive, kActiveJoints);
    expect_continuous(kBlemkerActive, kActiveJoints);
    const double bend = 4 * 9 * kBeside;  // of a smooth slope
    for (const double x : kActiveJoints) {
        EXPECT_NEAR(slope_jump(kTeranActive, x), 0, bend);
        const bool kink = x == 0.6 || x == 1.4;
        // 2 tail 0.2 - 2 peak 0.4 = 0.4
        EXPECT_NEAR(slope_jump(kBlemkerActive, x), kink ? -0.4 : 0, bend) << x;
    }
}

TEST(ToeCurve, SlopeAndIntegralsAreThoseOfTheValue) {
    for (const Toe& toe : kToes)
        for (const ToeForm form : {ToeForm::kinked, ToeForm::smooth}) {
            const ToeCurve curve(toe.scale, toe.rate, toe.linear_from, form);
            expect_derivatives(curve);
            const auto energy = [&](double x) { return curve.integral_over_stretch(x); };
            for (const double x : stretches())
                EXPECT_NEAR(difference(energy, x), curve.value(x) / x,
                            kDifference * (1 + curve.value(x) + curve.slope(x)));
        }
}

TEST(ToeCurve, SetsInWithAKinkOrWithout) {
    for (const Toe& toe : kToes)
        for (const ToeForm form : {ToeForm::kinked, ToeForm::smooth}) {
            const ToeCurve curve(toe.scale, toe.rate, toe.linear_from, form);
            expect_continuous(curve, {1, toe.linear_from});
            for (const double x : {0.0, 0.5, 1.0}) {
                EXPECT_EQ(curve.value(x), 0);
                EXPECT_EQ(curve.slope(x), 0);
                EXPECT_EQ(curve.integral(x), 0);
                EXPECT_EQ(curve.integral_over_stretch(x), 0);
            }
            const double steep = toe.scale * toe.rate;
            const double bend = 4 * kBeside * toe.rate * (steep + curve.slope(9));
            EXPECT_NEAR(slope_jump(curve, 1), form == ToeForm::kinked ? steep : 0, bend);
            if (toe.linear_from > 1) {
                EXPECT_NEAR(slope_jump(curve, toe.linear_from), 0, bend);
            }
            EXPECT_EQ(curve.slope(toe.linear_from + 0.1), curve.slope(toe.linear_from + 1));
        }
}

TEST(ToeCurve, HasThePublishedStraightParts) {
    // Muscle, Blemker: P3 x + P4, P3 = P1 P2 exp(P2 (x* - 1)), P4 = P1 (exp(...) - 1) - P3 x*.
    const double P1 = 0.05, P2 = 6.6, grown = std::exp(0.4 * P2);
    const ToeCurve blemker(P1, P2, 1.4, ToeForm::kinked);
    const double P3 = P1 * P2 * grown, P4 = P1 * (grown - 1) - P3 * 1.4;
    EXPECT_NEAR(blemker.value(1.5), P3 * 1.5 + P4, kRounding);
    // Muscle, Teran: p3 = P1 P2 (exp(0.4 P2) - 1), p4 = P1 (exp(0.4 P2) (1 - 1.4 P2) + P2 - 1).
    const ToeCurve teran(P1, P2, 1.4, ToeForm::smooth);
    const double p3 = P1 * P2 * (grown - 1), p4 = P1 * (grown * (1 - 1.4 * P2) + P2 - 1);
    EXPECT_NEAR(teran.value(1.5), p3 * 1.5 + p4, kRounding);
    // Tendon: at a stretch of 1.03, 8.2 MPa and a modulus of 504 MPa.
    const ToeCurve tendon(2.7, 46.4, 1.03, ToeForm::kinked);
    EXPECT_NEAR(tendon.value(1.03), 8.16, 0.01);
    EXPECT_NEAR(tendon.slope(1.1), 504, 0.2);
}

TEST(ToeCurve, EnergyOfATinyStretchIsHalfTheStiffnessTimesItsSquare) {
    const ToeCurve tendon(2.7, 46.4, 1.03, ToeForm::kinked);
    const double e = 1e-5, expected = 0.5 * 2.7 * 46.4 * e * e;
    // Higher terms are rate * e / 3 of it; rounding of Ei is 1e-17 beside 6e-9.
    EXPECT_NEAR(tendon.integral_over_stretch(1 + e) / expected, 1, 46.4 * e);
    EXPECT_NEAR(tendon.integral(1 + e) / expected, 1, 46.4 * e);
}

}  // namespace
}  // namespace myotet::muscle
