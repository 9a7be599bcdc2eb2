// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/VolumeLaw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace myotet::elasticity {
namespace {

// Central differences over this step, beside the bulk modulus: their error is its square times
// a third derivative, up to 4 K / J^4 here.
constexpr double kStep = 1e-5, kDifference = 1e-6;
constexpr VolumeForm kForms[] = {VolumeForm::log_squared, VolumeForm::log_and_square,
                                 VolumeForm::squared};

TEST(VolumeLaw, RestsAtTheVolumeItHas) {
    for (const VolumeForm form : kForms) {
        const VolumeLaw law{7, form};
        EXPECT_EQ(law.energy(1), 0);
        EXPECT_EQ(law.pressure(1), 0);
        EXPECT_EQ(law.slope(1), 7);  // all are K/2 (J - 1)^2 near rest
    }
}

TEST(VolumeLaw, PressureAndSlopeAreDerivatives) {
    for (const VolumeForm form : kForms) {
        const VolumeLaw law{7, form};
        for (const double J : {0.3, 0.7, 0.99, 1.0, 1.3, 2.5, 4.0}) {
            const auto difference = [&](auto&& f) {
                return (f(J + kStep) - f(J - kStep)) / (2 * kStep);
            };
            EXPECT_NEAR(law.pressure(J), difference([&](double j) { return law.energy(j); }),
                        7 * kDifference);
            EXPECT_NEAR(law.slope(J), difference([&](double j) { return law.pressure(j); }),
                        7 * kDifference);
        }
    }
}

TEST(VolumeLaw, ExpandedBodiesPullAndCompressedOnesPush) {
    for (const VolumeForm form : kForms) {
        const VolumeLaw law{7, form};
        EXPECT_GT(law.pressure(1.1), 0);
        EXPECT_LT(law.pressure(0.9), 0);
        EXPECT_GT(law.energy(1.1), 0);
        EXPECT_GT(law.energy(0.9), 0);
    }
}

TEST(VolumeLaw, LogarithmsForbidWhatIsNotPositive) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    for (const VolumeForm form : {VolumeForm::log_squared, VolumeForm::log_and_square})
        for (const double J : {0.0, -0.5, std::nan("")})
            EXPECT_EQ((VolumeLaw{7, form}.energy(J)), kInfinite);
    EXPECT_EQ((VolumeLaw{7, VolumeForm::squared}.energy(0)), 3.5);
}

TEST(VolumeLaw, IsNothingUnlessItIsGiven) {
    EXPECT_EQ(VolumeLaw{}.energy(0.4), 0);
    EXPECT_EQ(VolumeLaw{}.energy(-1), 0);
    EXPECT_EQ(VolumeLaw{}.pressure(0.4), 0);
    EXPECT_EQ(VolumeLaw{}.slope(0.4), 0);
}

}  // namespace
}  // namespace myotet::elasticity
