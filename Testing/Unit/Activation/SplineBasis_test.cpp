// SPDX-License-Identifier: Apache-2.0
#include "Activation/SplineBasis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"

namespace myotet::activation {
namespace {

constexpr double kRounding = 1e-12, kStep = 1e-6, kDifference = 1e-6;
const SplineBasis kBasis{.begin = 0.2, .end = 1.7, .intervals = 6};

TEST(SplineBasis, SumsToOneAndItsDerivativesToNothing) {
    for (double t = 0.2; t <= 1.7; t += 0.01) {
        const auto local = kBasis.at(t);
        double value = 0, slope = 0, bend = 0;
        for (std::size_t j = 0; j < 4; ++j) {
            EXPECT_GE(local.value[j], -kRounding);
            value += local.value[j];
            slope += local.slope[j];
            bend += local.bend[j];
        }
        EXPECT_NEAR(value, 1, kRounding);
        EXPECT_NEAR(slope, 0, kRounding * 100);
        EXPECT_NEAR(bend, 0, kRounding * 1000);
        EXPECT_GE(local.first, 0);
        EXPECT_LE(local.first + 4, kBasis.count());
    }
}

TEST(SplineBasis, RepeatsStraightLinesAndParabolas) {
    // Coefficients of t are the centres of the splines; of t^2 the same but for h^2 / 3.
    ActivationCurves curves{kBasis, Eigen::MatrixXd(2, kBasis.count())};
    const double h = kBasis.spacing();
    for (int j = 0; j < kBasis.count(); ++j) {
        const double centre = kBasis.begin + (j - 1) * h;
        curves.coefficients(0, j) = centre;
        curves.coefficients(1, j) = centre * centre - h * h / 3;
    }
    for (double t = 0.1; t < 1.9; t += 0.037) {
        EXPECT_NEAR(curves.activations(t)[0], t, kRounding);
        EXPECT_NEAR(curves.rates(t)[0], 1, kRounding * 10);
        EXPECT_NEAR(curves.activations(t)[1], t * t, kRounding * 10);
        EXPECT_NEAR(curves.rates(t)[1], 2 * t, kRounding * 100);
    }
}

TEST(SplineBasis, DerivativesAreThoseOfTheValueAcrossKnots) {
    for (double t = 0.3; t < 1.6; t += 0.05) {
        const auto at = kBasis.at(t), up = kBasis.at(t + kStep), down = kBasis.at(t - kStep);
        if (up.first != down.first) continue;
        for (std::size_t j = 0; j < 4; ++j) {
            EXPECT_NEAR((up.value[j] - down.value[j]) / (2 * kStep), at.slope[j], kDifference);
            EXPECT_NEAR((up.slope[j] - down.slope[j]) / (2 * kStep), at.bend[j], kDifference);
        }
    }
    ActivationCurves curves{kBasis, Eigen::MatrixXd::Random(1, kBasis.count())};
    for (int knot = 1; knot < 6; ++knot) {
        const double t = kBasis.begin + knot * kBasis.spacing();
        EXPECT_NEAR(curves.activations(t - 1e-9)[0], curves.activations(t + 1e-9)[0], 1e-7);
        EXPECT_NEAR(curves.rates(t - 1e-9)[0], curves.rates(t + 1e-9)[0], 1e-6);
    }
}

TEST(SplineBasis, RefusesWhatHasNoMeaning) {
    EXPECT_NO_THROW(kBasis.validate());
    EXPECT_THROW((SplineBasis{.begin = 1, .end = 1}.validate()), InputError);
    EXPECT_THROW((SplineBasis{.begin = 0, .end = std::nan("")}.validate()), InputError);
    EXPECT_THROW((SplineBasis{.intervals = 0}.validate()), InputError);
}

}  // namespace
}  // namespace myotet::activation
