// SPDX-License-Identifier: Apache-2.0
#include "Fibres/BSplineBasis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace myotet::fibres {
namespace {

constexpr double kRounding = 1e-13;

template <class Check>
void for_all(Check check) {
    for (int degree = 1; degree <= kMostDegree; ++degree)
        for (const int count : {degree + 1, degree + 2, 9})
            for (int n = 0; n <= 97; ++n) check(degree, count, n / 97.0);
}

TEST(BSplineBasis, IsAPartitionOfUnityAndNotNegative) {
    for_all([](int degree, int count, double t) {
        const Basis b = basis_at(degree, count, t);
        EXPECT_GE(b.first, 0);
        EXPECT_LT(b.first + degree, count);
        EXPECT_NEAR(std::accumulate(b.value.begin(), b.value.end(), 0.0), 1, kRounding);
        EXPECT_NEAR(std::accumulate(b.slope.begin(), b.slope.end(), 0.0), 0, 100 * kRounding);
        for (const double value : b.value) EXPECT_GE(value, 0);
    });
}

TEST(BSplineBasis, IsTheStraightLineOnGrevilleParameters) {
    for_all([](int degree, int count, double t) {
        const Basis b = basis_at(degree, count, t);
        double value = 0, slope = 0;
        for (int i = 0; i <= degree; ++i) {
            value += b.value[i] * greville(degree, count, b.first + i);
            slope += b.slope[i] * greville(degree, count, b.first + i);
        }
        EXPECT_NEAR(value, t, kRounding);
        EXPECT_NEAR(slope, 1, 100 * kRounding);
    });
}

TEST(BSplineBasis, SlopeIsTheDerivative) {
    constexpr double kStep = 1e-6, kDifference = 1e-7;
    for_all([](int degree, int count, double t) {
        const double from_knot = std::abs(t * (count - degree) - std::round(t * (count - degree)));
        if (from_knot < 0.01) return;  // degree 1 has corners there
        const Basis at = basis_at(degree, count, t);
        const Basis low = basis_at(degree, count, t - kStep);
        const Basis high = basis_at(degree, count, t + kStep);
        for (int i = 0; i <= degree; ++i)
            EXPECT_NEAR((high.value[i] - low.value[i]) / (2 * kStep), at.slope[i], kDifference);
    });
}

TEST(BSplineBasis, OneSpanIsBernsteins) {
    const double t = 0.3, s = 0.7;
    const Basis b = basis_at(3, 4, t);
    const double expected[4] = {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(b.value[i], expected[i], kRounding);
}

TEST(BSplineBasis, IsClampedToItsEnds) {
    for (const double t : {-1.0, 0.0}) EXPECT_EQ(basis_at(3, 7, t).value[0], 1);
    for (const double t : {1.0, 2.0}) {
        EXPECT_EQ(basis_at(3, 7, t).first, 3);
        EXPECT_EQ(basis_at(3, 7, t).value[3], 1);
    }
}

}  // namespace
}  // namespace myotet::fibres
