// SPDX-License-Identifier: Apache-2.0
#include "Report/Histogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "Core/Errors.h"
#include "Report/Svg.h"
#include "Support/Markup.h"

namespace myotet::report {
namespace {

using ::testing::HasSubstr;

TEST(Histogram, CountsSumUpToWhatWasAdded) {
    Histogram histogram({10, 70}, 12);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> numbers(-20, 100);
    constexpr int kCount = 5000;
    for (int i = 0; i < kCount; ++i) histogram.add(numbers(random));
    histogram.add(NAN);
    histogram.add(HUGE_VAL);
    EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::int64_t{0}),
              kCount);
    EXPECT_EQ(histogram.not_finite, 2);
}

TEST(Histogram, EndsBelongToThePartAboveTheLastToTheLast) {
    Histogram histogram({0, 4}, 4);
    for (const double number : {-1.0, 0.0, 1.0, 1.5, 3.0, 4.0, 9.0}) histogram.add(number);
    EXPECT_EQ(histogram.counts, (std::vector<std::int64_t>{2, 2, 0, 3}));
}

TEST(Histogram, RefusesWhatHasNoExtent) {
    EXPECT_THROW(Histogram({1, 1}, 4), InputError);
    EXPECT_THROW(Histogram({0, 1}, 0), InputError);
}

TEST(Svg, HistogramsAndChartsAreWellFormed) {
    Histogram histogram({0, 1}, 3);
    const std::string none = histogram_figure(histogram, "<none>", "x & y");
    EXPECT_EQ(myotet::testing::markup_mistake(none), "");
    EXPECT_THAT(none, HasSubstr("&lt;none&gt;, 0 in all"));
    histogram.add(0.5);
    histogram.add(NAN);
    EXPECT_THAT(histogram_figure(histogram, "one", "x"), HasSubstr("1 have no such number"));

    Panel panel{.title = "a \"title\"", .y_label = "N", .lines = {}};
    for (int l = 0; l < 10; ++l)
        panel.lines.push_back({.name = "<line>", .x = {0, 1, 2, 3}, .y = {0, 1.0 * l, NAN, 2}});
    panel.lines.push_back({.name = "empty", .x = {}, .y = {}});
    const std::string chart = chart_figure(panel, "time, s");
    EXPECT_EQ(myotet::testing::markup_mistake(chart), "");
    EXPECT_THAT(chart, HasSubstr("&lt;line&gt; from 0 to 9"));
    EXPECT_THAT(chart, HasSubstr("empty without numbers"));
    EXPECT_THAT(chart, HasSubstr("line-1 again"));
}

TEST(Svg, RefusesWhatNoScaleShows) {
    EXPECT_THROW(
        (void)chart_figure({.title = "", .y_label = "", .lines = {{.x = {0, 1}, .y = {0}}}}, "x"),
        InputError);
    EXPECT_THROW(
        (void)chart_figure({.title = "", .y_label = "", .lines = {{.x = {0}, .y = {1e200}}}}, "x"),
        InputError);
}

}  // namespace
}  // namespace myotet::report
