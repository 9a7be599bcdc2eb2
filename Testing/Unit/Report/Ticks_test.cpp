// SPDX-License-Identifier: Apache-2.0
#include "Report/Ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "Core/Text.h"

namespace myotet::report {
namespace {

constexpr double kRounding = 1e-6;  // of a step: differences of numbers a million times larger

// The nearest of 1, 2 and 5 times powers of ten.
double nearest_round(double step) {
    double nearest = 0;
    const int exponent = static_cast<int>(std::floor(std::log10(step)));
    for (int e = exponent - 1; e <= exponent + 1; ++e)
        for (const int count : {1, 2, 5}) {
            const double round = e < 0 ? count / std::pow(10.0, -e) : count * std::pow(10.0, e);
            if (std::abs(round - step) < std::abs(nearest - step)) nearest = round;
        }
    return nearest;
}

TEST(Ticks, AreRoundFewAndCoverTheRange) {
    int checked = 0;
    for (const double least : {-1e7, -312.4, -1.0, -0.037, 0.0, 1e-9, 0.21, 4.4, 99.5, 12345.0})
        for (const double extent : {3e-10, 0.0031, 0.7, 1.0, 2.0, 49.99, 1e3, 7.7e8})
            for (const int at_most : {3, 4, 6, 9}) {
                const Range range{least, least + extent};
                if (extent < 2e-6 * std::max(std::abs(least), std::abs(range.most))) continue;
                const std::vector<Tick> ticks = round_ticks(range, at_most);
                ASSERT_GE(ticks.size(), 1U);
                ASSERT_LE(ticks.size(), static_cast<std::size_t>(at_most));
                for (const Tick& tick : ticks) {
                    EXPECT_EQ(to_number(tick.text), tick.value) << tick.text;
                    EXPECT_LE(tick.text.size(), 14U);
                }
                if (ticks.size() < 2) continue;
                const double mean = (ticks.back().value - ticks.front().value) /
                                    static_cast<double>(ticks.size() - 1);
                const double step = nearest_round(mean), slack = kRounding * step;
                EXPECT_NEAR(mean, step, slack);
                EXPECT_NEAR(std::remainder(ticks.front().value, step), 0, slack);
                for (std::size_t i = 1; i < ticks.size(); ++i)
                    EXPECT_NEAR(ticks[i].value - ticks[i - 1].value, step, slack);
                EXPECT_LT(ticks.front().value - range.least, step);
                EXPECT_LT(range.most - ticks.back().value, step);
                EXPECT_GE(ticks.front().value, range.least - 2 * slack);
                EXPECT_LE(ticks.back().value, range.most + 2 * slack);
                ++checked;
            }
    EXPECT_GT(checked, 150);
}

std::string texts(const Range& range, int at_most) {
    std::string all;
    for (const Tick& tick : round_ticks(range, at_most)) all += tick.text + " ";
    return all;
}

TEST(Ticks, AreWrittenAsAReaderWould) {
    EXPECT_EQ(texts({0, 1}, 6), "0.0 0.2 0.4 0.6 0.8 1.0 ");
    EXPECT_EQ(texts({0, 0.3}, 4), "0.0 0.1 0.2 0.3 ");
    EXPECT_EQ(texts({-120, 260}, 9), "-100 -50 0 50 100 150 200 250 ");
    EXPECT_EQ(texts({-0.05, 0.05}, 5), "-0.04 -0.02 0.00 0.02 0.04 ");
    EXPECT_EQ(texts({0, 2.5e6}, 6), "0 5e5 1e6 1.5e6 2e6 2.5e6 ");
    EXPECT_EQ(texts({-1e-7, 3.4e-7}, 6), "-1e-7 0 1e-7 2e-7 3e-7 ");
    EXPECT_EQ(texts({3, 1200}, 3), "500 1000 ");
}

TEST(Ticks, RefuseRangesThatNoAxisCanShow) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    for (const Range& range : {Range{1, 1}, Range{2, 1}, Range{nan, 1}, Range{0, nan},
                               Range{0, infinite}, Range{0, 1e101}, Range{1, 1 + 1e-9}})
        EXPECT_THROW((void)round_ticks(range, 6), InputError);
    EXPECT_THROW((void)round_ticks({0, 1}, 2), InputError);
    EXPECT_NO_THROW((void)round_ticks({-1e100, 1e100}, 6));
    EXPECT_NO_THROW((void)round_ticks({0, 1e-100}, 6));
}

}  // namespace
}  // namespace myotet::report
