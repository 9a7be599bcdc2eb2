// SPDX-License-Identifier: Apache-2.0
#include "Report/ColourMap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace myotet::report {
namespace {

// Of sRGB's linear light, ITU-R BT.709.
double luminance(const Colour& colour) {
    constexpr double share[] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (int c = 0; c < 3; ++c)
        sum += share[c] * (colour[c] <= 0.04045 ? colour[c] / 12.92
                                                : std::pow((colour[c] + 0.055) / 1.055, 2.4));
    return sum;
}

// CIE L*, of white 100.
double lightness(const Colour& colour) { return 116 * std::cbrt(luminance(colour)) - 16; }

TEST(ColourMap, GoesFromVioletToYellowAndStaysThere) {
    EXPECT_EQ(map_colour(0), (Colour{68 / 255.0, 1 / 255.0, 84 / 255.0}));
    EXPECT_EQ(map_colour(1), (Colour{253 / 255.0, 231 / 255.0, 37 / 255.0}));
    EXPECT_EQ(map_colour(-3), map_colour(0));
    EXPECT_EQ(map_colour(HUGE_VAL), map_colour(1));
}

TEST(ColourMap, LightnessGrowsEvenly) {
    const double first = lightness(map_colour(0)), last = lightness(map_colour(1));
    constexpr double kEven = 3;  // of L*: what nine knots cost; viridis itself is within 1
    double before = first - 1;
    for (int i = 0; i <= 200; ++i) {
        const double share = i / 200.0, now = lightness(map_colour(share));
        EXPECT_GT(now, before);
        EXPECT_NEAR(now, first + share * (last - first), kEven) << share;
        before = now;
    }
}

}  // namespace
}  // namespace myotet::report
