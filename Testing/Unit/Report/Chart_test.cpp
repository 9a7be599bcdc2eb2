// SPDX-License-Identifier: Apache-2.0
#include "Report/Chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "Core/Errors.h"
#include "Report/ChartLayout.h"
#include "ReportShapes.h"
#include "Support/TemporaryFolder.h"

namespace myotet::report {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kHalfWidth = 1.1;  // pixels, of a line
// Pixels: of a side's pixel covered by the share c, the ink is (1 - c) / 2 from its middle, an
// error of the mean of at most 1/8 / 2.2; channels are whole numbers.
constexpr double kCentroidError = 0.06, kInkError = 0.02;

Chart chart_of(std::vector<Line> lines) {
    return {"", "time (s)", {{"", "force (N)", std::move(lines), Range{0, 1}}}, 1};
}

// A black line on the x from 0 to 1 that another line without a point in sight sets.
Chart black_line(std::vector<double> x, std::vector<double> y) {
    return chart_of({{"", {0, 1}, {kNaN, kNaN}}, {"", std::move(x), std::move(y), {}, 6}});
}

Chart nothing() { return black_line({}, {}); }

PlotArea area_of(const Chart& chart) { return lay_out(chart, {}).areas.front(); }

// Pixels in which two pictures differ.
struct Difference {
    int count = 0, left = kLongestSide, right = -1, top = kLongestSide, bottom = -1;
};

Difference difference(const Picture& a, const Picture& b) {
    Difference d;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            if (pixel(a, x, y) == pixel(b, x, y)) continue;
            d = {d.count + 1, std::min(d.left, x), std::max(d.right, x), std::min(d.top, y),
                 std::max(d.bottom, y)};
        }
    return d;
}

TEST(Chart, AHorizontalLineIsOnTheRowOfItsNumber) {
    const Chart empty = nothing();
    const Picture without = draw_chart(empty);
    const PlotArea area = area_of(empty);
    const int column = static_cast<int>(area.at(0.47, 0).x());
    std::vector<int> grid;  // rows, from the lowest number up
    for (int y = static_cast<int>(area.rect.bottom) - 2; y > 0; --y)
        if (pixel(without, column, y) != kWhitePixel) grid.push_back(y);
    // 0.0 is at the axis, whose pixels are left out.
    ASSERT_EQ(grid.size() + 1, area.y_ticks.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const double value = area.y_ticks[i + 1].value;
        const Picture with = draw_chart(black_line({0, 1}, {value, value}));
        EXPECT_EQ(pixel(with, column, grid[i]), (std::array<int, 3>{0, 0, 0})) << value;
        EXPECT_EQ(pixel(with, column, grid[i] - 3), kWhitePixel);
        EXPECT_EQ(pixel(with, column, grid[i] + 3), kWhitePixel);
    }
    // Between grid lines: the middle of its ink.
    for (const double value : {0.07, 0.333, 0.7512, 0.93}) {
        const Picture with = draw_chart(black_line({0, 1}, {value, value}));
        const double row = area.rect.bottom - value * (area.rect.bottom - area.rect.top);
        double ink = 0, moment = 0;
        for (int y = static_cast<int>(row) - 4; y <= static_cast<int>(row) + 4; ++y) {
            const double share = (255 - pixel(with, column, y)[0]) / 255.0;
            ink += share;
            moment += share * (y + 0.5);
        }
        EXPECT_NEAR(ink, 2 * kHalfWidth, kInkError);
        EXPECT_NEAR(moment / ink, row, kCentroidError);
    }
}

TEST(Chart, ASteepLineEndsWhereItsPointsAre) {
    const Chart steep = black_line({0.41, 0.4105}, {0.23, 0.81});
    const Difference d = difference(draw_chart(steep), draw_chart(nothing()));
    const PlotArea area = area_of(steep);
    EXPECT_NEAR(d.top, area.at(0, 0.81).y() - kHalfWidth, 1);
    EXPECT_NEAR(d.bottom + 1, area.at(0, 0.23).y() + kHalfWidth, 1);
    EXPECT_NEAR(d.left, area.at(0.41, 0).x() - kHalfWidth, 1);
    EXPECT_NEAR(d.right + 1, area.at(0.4105, 0).x() + kHalfWidth, 1);
}

TEST(Chart, AMissingNumberLeavesAGap) {
    for (const double missing : {kNaN, std::numeric_limits<double>::infinity()}) {
        const Chart broken = black_line({0.1, 0.3, 0.5, 0.7, 0.9}, {0.5, 0.5, missing, 0.5, 0.5});
        const PlotArea area = area_of(broken);
        const Picture with = draw_chart(broken), without = draw_chart(nothing());
        const int row = static_cast<int>(area.at(0, 0.5).y());
        const auto is_drawn = [&](double x) {
            const int column = static_cast<int>(area.at(x, 0).x());
            return pixel(with, column, row) != pixel(without, column, row);
        };
        for (const double x : {0.11, 0.2, 0.29, 0.71, 0.8, 0.89}) EXPECT_TRUE(is_drawn(x)) << x;
        for (const double x : {0.05, 0.31, 0.4, 0.5, 0.6, 0.69, 0.95})
            EXPECT_FALSE(is_drawn(x)) << x;
    }
}

TEST(Chart, LinesAreCutAtAGivenRange) {
    const Chart wild = black_line({0, 0.5, 1}, {-7, 1e90, -1e90});
    const Difference d = difference(draw_chart(wild), draw_chart(nothing()));
    const PlotArea area = area_of(wild);
    EXPECT_GT(d.count, 100);
    EXPECT_GE(d.top, area.rect.top - 2);
    EXPECT_LE(d.bottom, area.rect.bottom + 1);
}

std::vector<Line> many_lines(int count) {
    std::vector<Line> lines;
    for (int i = 0; i < count; ++i) {
        const double height = (i + 1.0) / (count + 1.0);
        lines.push_back({"muscle " + std::to_string(i), {0, 1}, {height, height}});
    }
    return lines;
}

TEST(Chart, EachNameIsInTheLegend) {
    const std::vector<Line> lines = many_lines(12);
    const Picture all = draw_chart(chart_of(lines));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::vector<Line> renamed = lines;
        renamed[i].name = "Muscle " + std::to_string(i);
        const Picture other = draw_chart(chart_of(renamed));
        ASSERT_EQ(other.height, all.height);
        const Difference d = difference(all, other);
        EXPECT_GT(d.count, 0) << i;
        EXPECT_GE(d.top, area_of(chart_of(lines)).outer.bottom) << i;  // below all lines
    }
    EXPECT_LT(draw_chart(nothing()).height, all.height);  // no name, no legend
    // What has room is not shortened, at any scale.
    for (const double scale : {0.5, 1.0, 1.5, 1.7, 3.0})
        EXPECT_EQ(lay_out(chart_of(lines), {.scale = scale}).legends.front().looks,
                  looks_of({.lines = lines}));
}

TEST(Chart, PanelsWithTheSameLegendShareIt) {
    Chart chart = chart_of(many_lines(3));
    chart.columns = 2;
    chart.panels.resize(4, chart.panels.front());
    EXPECT_EQ(lay_out(chart, {}).legends.size(), 1U);
    const Picture shared = draw_chart(chart);
    chart.panels[2].lines[1].name = "another";
    EXPECT_EQ(lay_out(chart, {}).legends.size(), 4U);
    EXPECT_LT(shared.height, draw_chart(chart).height);
    EXPECT_EQ(shared.width, 2 * 480);
    // However long, a name stays with its panel.
    chart.panels[2].lines[1].name = std::string(500, 'w');
    const Picture with = draw_chart(chart);
    EXPECT_EQ(with.width, shared.width);
    for (int y = with.height - 100; y < with.height; ++y)
        EXPECT_EQ(pixel(with, 481, y), kWhitePixel);
}

TEST(Chart, ColoursComeAgainWithDashesThenDots) {
    const std::vector<Look> looks = looks_of({.lines = many_lines(20)});
    for (std::size_t i = 0; i < looks.size(); ++i) {
        EXPECT_EQ(looks[i].colour, kPalette[i % 8]);
        EXPECT_EQ(looks[i].style, i < 8    ? LineStyle::solid
                                  : i < 16 ? LineStyle::dashed
                                           : LineStyle::dotted);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_FALSE(looks[i].colour == looks[j].colour && looks[i].style == looks[j].style);
    }
    // Lines that choose their colour leave the order of the others as it is.
    std::vector<Line> lines = many_lines(3);
    lines[1].colour = 5;
    EXPECT_EQ(looks_of({.lines = lines})[1].colour, kPalette[5]);
    EXPECT_EQ(looks_of({.lines = lines})[2].colour, kPalette[1]);

    const Picture picture = draw_chart(chart_of(many_lines(8)));
    for (const Colour& colour : kPalette) {
        std::array<int, 3> wanted{};
        for (int c = 0; c < 3; ++c) wanted[c] = static_cast<int>(std::lround(255 * colour[c]));
        bool found = false;
        for (int y = 0; y < picture.height && !found; ++y)
            for (int x = 0; x < picture.width && !found; ++x)
                found = pixel(picture, x, y) == wanted;
        EXPECT_TRUE(found);
    }
}

TEST(Chart, ShowsConstantMissingAndExtremeData) {
    const auto range = [](std::vector<double> y) {
        Chart chart{"", "", {{"", "", {{"", std::vector<double>(y.size(), 1.0), y}}, {}}}, 1};
        (void)draw_chart(chart);
        return area_of(chart).y;
    };
    for (const Range& r : {range({}), range({kNaN}), range({kNaN, kNaN})}) {
        EXPECT_EQ(r.least, 0);
        EXPECT_EQ(r.most, 1);
    }
    for (const double c : {0.0, 5.0, -3e-7, 1e99, -1e99, 1e-99, 1e-300}) {
        const Range r = range({c, c});
        EXPECT_TRUE(r.least < c && c < r.most) << c;
    }
    const Range wide = range({-1e99, 1e99});
    EXPECT_LT(wide.least, -1e99);
    const Range usual = range({2, 7, 4});
    EXPECT_DOUBLE_EQ(usual.least, 1.75);
    EXPECT_DOUBLE_EQ(usual.most, 7.25);
    EXPECT_NO_THROW((void)draw_chart({"", "", {{}, {}, {}}, 2}));
}

TEST(Chart, GrowsWithItsScale) {
    const Chart chart = chart_of(many_lines(5));
    const Picture one = draw_chart(chart);
    const Picture two = draw_chart(chart, {.scale = 2});
    EXPECT_EQ(one.width, 480);
    EXPECT_EQ(two.width, 960);
    EXPECT_NEAR(two.height, 2 * one.height, 1);
}

TEST(Chart, SameChartSameBytes) {
    const testing::TemporaryFolder folder;
    Chart chart = chart_of(many_lines(12));
    chart.title = "Forces";
    write_png(draw_chart(chart), folder / "a.png");
    write_png(draw_chart(chart), folder / "b.png");
    EXPECT_EQ(testing::read_bytes(folder / "a.png"), testing::read_bytes(folder / "b.png"));
}

// What draw_chart says against a chart.
std::string refusal(const Chart& chart, const ChartOptions& options = {}) {
    try {
        (void)draw_chart(chart, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

TEST(Chart, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(refusal({}), "a chart cannot be drawn: it has no panel; give at least one");
    Chart chart = chart_of({{"FCR", {0, 1, 2}, {0, 1}}});
    chart.panels.front().title = "wrist";
    EXPECT_EQ(refusal(chart),
              "a chart cannot be drawn: panel 0 'wrist', line 0 'FCR' has 3 x and 2 y; give as "
              "many of each");
    EXPECT_EQ(refusal(chart_of({{"", {0, 2, 1}, {0, 1, 2}}})),
              "a chart cannot be drawn: panel 0, line 0: x falls from 2 to 1 at point 2; sort "
              "the points by x");
    EXPECT_EQ(refusal(chart_of({{"", {0, 1, 1}, {0, 1, 2}}})), "nothing");  // a step
    const auto says = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    EXPECT_TRUE(says(refusal(chart_of({{"", {0, kNaN}, {0, 1}}})), "x 1 is nan"));
    EXPECT_TRUE(says(refusal(chart_of({{"", {0, 1}, {0, 1e200}}})), "y 1 is 1e+200"));
    EXPECT_TRUE(says(refusal(chart_of({{"", {0}, {0}, {}, 8}})), "has colour 8"));
    EXPECT_TRUE(says(refusal(chart_of({{"", {0}, {0}, {}, -1}})), "has colour -1"));
    chart = nothing();
    chart.columns = 0;
    EXPECT_TRUE(says(refusal(chart), "0 columns"));
    chart = nothing();
    chart.panels.front().y_range = Range{3, 2};
    EXPECT_TRUE(says(refusal(chart), "from 3 to 2"));
    EXPECT_TRUE(says(refusal(nothing(), {.panel_width = 100}), "100 x 300 pixels"));
    EXPECT_TRUE(says(refusal(nothing(), {.scale = kNaN}), "scale is nan"));
    EXPECT_TRUE(says(refusal(nothing(), {.panel_width = 16384, .scale = 8}), "a picture's width"));
}

}  // namespace
}  // namespace myotet::report
