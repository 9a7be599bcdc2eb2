// SPDX-License-Identifier: Apache-2.0
#include "Report/ChartLayout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Report/Lettering.h"
#include "Report/Text.h"

namespace myotet::report {
namespace {

constexpr double kSize = 1.5;  // of a letter's square
constexpr double kLetter = kSize * kLetterHeight;
constexpr double kMarginX = 0.02, kMarginY = 0.05;  // of a range, at either end
constexpr double kConstant = 0.1;                   // of a constant: shown above and below it
constexpr double kFlat = 1e-6, kNothing = 1e-99;    // of the larger end; below, a constant
constexpr int kMostTicks = 9, kFewestTicks = 3;
constexpr double kTickRoomX = 18, kTickRoomY = 26;  // between numbers; from line to line
constexpr double kLegendColumnGap = 22;
constexpr double kFarthest = 1e6;  // pixels

// A range that shows values from least to most, with a share more at either end.
Range around(double least, double most, double margin) {
    if (!(least <= most)) return {};
    const double larger = std::max(std::abs(least), std::abs(most));
    if (most - least <= std::max(2 * kFlat * larger, kNothing)) {
        const double middle = 0.5 * (least + most);
        const double half = larger > kNothing ? kConstant * larger : 1;
        return {middle - half, middle + half};
    }
    const double more = margin * (most - least);
    return {least - more, most + more};
}

Range range_of_x(const Chart& chart) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Panel& panel : chart.panels)
        for (const Line& line : panel.lines)
            if (!line.x.empty()) {
                least = std::min(least, line.x.front());
                most = std::max(most, line.x.back());
            }
    return around(least, most, kMarginX);
}

Range range_of_y(const Panel& panel) {
    if (panel.y_range) return *panel.y_range;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Line& line : panel.lines)
        for (const double y : line.y)
            if (std::isfinite(y)) {
                least = std::min(least, y);
                most = std::max(most, y);
            }
    return around(least, most, kMarginY);
}

double widest(const std::vector<Tick>& ticks) {
    double width = 0;
    for (const Tick& tick : ticks) width = std::max(width, lettering_width(tick.text, kSize));
    return width;
}

// As many numbers as have room beside one another on `length` pixels.
std::vector<Tick> ticks_of_x(const Range& range, double length) {
    for (int most = kMostTicks;; --most) {
        std::vector<Tick> ticks = round_ticks(range, most);
        const double step = ticks.size() < 2 ? length
                                             : (ticks[1].value - ticks[0].value) /
                                                   (range.most - range.least) * length;
        if (most == kFewestTicks || step >= widest(ticks) + kTickRoomX) return ticks;
    }
}

std::vector<Tick> ticks_of_y(const Range& range, double length) {
    return round_ticks(range,
                       std::clamp(static_cast<int>(length / kTickRoomY), kFewestTicks, kMostTicks));
}

std::vector<Look> named(const Panel& panel) {
    std::vector<Look> looks = looks_of(panel);
    std::erase_if(looks, [](const Look& look) { return look.name.empty(); });
    return looks;
}

// Entries in rows within `width`: as many columns as fit, as even as they can be.
struct LegendGrid {
    int rows = 0, columns = 0;
    double name_width = 0, column_width = 0, width = 0;
};

LegendGrid grid_of(const std::vector<Look>& looks, double width) {
    if (looks.empty()) return {};
    double name = 0;
    for (const Look& look : looks) name = std::max(name, lettering_width(look.name, kSize));
    LegendGrid grid;
    const int count = static_cast<int>(looks.size());
    const double sample = kSampleLength + kSampleGap;
    grid.name_width = std::min(name, width - sample);
    grid.column_width = sample + grid.name_width + kLegendColumnGap;
    const int fit = static_cast<int>((width + kLegendColumnGap) / grid.column_width);
    grid.columns = std::clamp(fit, 1, count);
    grid.rows = (count + grid.columns - 1) / grid.columns;
    grid.columns = (count + grid.rows - 1) / grid.rows;
    grid.width = grid.columns * grid.column_width - kLegendColumnGap;
    return grid;
}

// Filled column by column, so that a line and its reference after it stand together.
LegendPlace place_legend(const std::vector<Look>& looks, const LegendGrid& grid,
                         const Vec2& corner) {
    LegendPlace place;
    for (int i = 0; i < static_cast<int>(looks.size()); ++i) {
        const Look& look = looks[i];
        place.looks.push_back(
            {shortened(look.name, kSize, grid.name_width), look.colour, look.style});
        place.corners.push_back(
            corner + Vec2(i / grid.rows * grid.column_width, i % grid.rows * kLegendLine));
    }
    return place;
}

// Room beside the lines, at scale 1.
struct Sides {
    double left = kEdge, top = kEdge, right = 1.6 * kEdge, bottom = kEdge;
};

// The same for all panels, so that their axes are in line.
Sides sides_of(const Chart& chart, const ChartOptions& options) {
    Sides sides;
    double numbers = 0;
    bool title = false, label = false;
    for (const Panel& panel : chart.panels) {
        numbers = std::max(numbers, widest(ticks_of_y(range_of_y(panel), options.panel_height)));
        title = title || !panel.title.empty();
        label = label || !panel.y_label.empty();
    }
    sides.left += numbers + kTickLength + kTickGap + (label ? kLetter + kLabelGap : 0);
    sides.top += title ? kTitleFactor * kLetter + kLabelGap : 0.5 * kLetter;
    sides.bottom += kTickLength + kTickGap + kLetter;
    if (!chart.x_label.empty()) sides.bottom += kLabelGap + kLetter;
    return sides;
}

// Where the panels' corners are, and the legends.
struct Rows {
    double top = 0, step = 0, bottom = 0;
    bool one_legend = false;
};

Rows rows_of(const Chart& chart, const ChartOptions& options) {
    Rows rows;
    rows.top = chart.title.empty() ? 0 : kEdge + kChartTitleFactor * kLetter + kEdge;
    const std::vector<Look> first = named(chart.panels.front());
    rows.one_legend = std::ranges::all_of(
        chart.panels, [&](const Panel& panel) { return named(panel) == first; });
    int most = 0;
    for (const Panel& panel : chart.panels)
        most = std::max(most, grid_of(named(panel), options.panel_width - 2 * kEdge).rows);
    const bool each = !rows.one_legend && most > 0;
    rows.step = options.panel_height + (each ? most * kLegendLine + kEdge : 0);
    const auto count = static_cast<int>(chart.panels.size());
    rows.bottom = rows.top + rows.step * ((count - 1) / chart.columns + 1);
    return rows;
}

PlotArea area_of(const Panel& panel, const Range& x, const Rect& outer, const Sides& sides) {
    const Rect rect{outer.left + sides.left, outer.top + sides.top, outer.right - sides.right,
                    outer.bottom - sides.bottom};
    const Range y = range_of_y(panel);
    return {outer,
            rect,
            x,
            y,
            ticks_of_x(x, rect.right - rect.left),
            ticks_of_y(y, rect.bottom - rect.top)};
}

// Under its panel's axis, or as far as it must be to the left for its width.
LegendPlace legend_of(const Panel& panel, const PlotArea& area) {
    const std::vector<Look> looks = named(panel);
    const LegendGrid grid = grid_of(looks, area.outer.right - area.outer.left - 2 * kEdge);
    const double room = area.outer.right - kEdge - grid.width;
    const double left = 0.5 * (area.rect.left + area.rect.right - grid.width);
    return place_legend(looks, grid, {std::min(left, room), area.outer.bottom});
}

void multiply(ChartLayout& layout, double scale) {
    layout.size *= scale;
    for (PlotArea& area : layout.areas)
        for (Rect* rect : {&area.outer, &area.rect})
            *rect = {scale * rect->left, scale * rect->top, scale * rect->right,
                     scale * rect->bottom};
    for (LegendPlace& legend : layout.legends) {
        for (Vec2& corner : legend.corners) corner *= scale;
    }
}

}  // namespace

std::vector<Look> looks_of(const Panel& panel) {
    std::vector<Look> looks;
    std::size_t next = 0;
    for (const Line& line : panel.lines) {
        const std::size_t number = line.colour ? static_cast<std::size_t>(*line.colour) : next++;
        const std::size_t round = number / kPalette.size();
        LineStyle style = line.style;
        if (style == LineStyle::solid && round > 0)
            style = round == 1 ? LineStyle::dashed : LineStyle::dotted;
        looks.push_back({line.name, kPalette[number % kPalette.size()], style});
    }
    return looks;
}

Vec2 PlotArea::at(double x_value, double y_value) const {
    const double across = (x_value - x.least) / (x.most - x.least);
    const double up = (y_value - y.least) / (y.most - y.least);
    if (!std::isfinite(across) || !std::isfinite(up))
        return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    return {std::clamp(rect.left + across * (rect.right - rect.left), -kFarthest, kFarthest),
            std::clamp(rect.bottom - up * (rect.bottom - rect.top), -kFarthest, kFarthest)};
}

ChartLayout lay_out(const Chart& chart, const ChartOptions& options) {
    const Sides sides = sides_of(chart, options);
    const Rows rows = rows_of(chart, options);
    const Range x = range_of_x(chart);
    const std::size_t count = chart.panels.size();
    const std::size_t columns = std::min(static_cast<std::size_t>(chart.columns), count);
    const double width = static_cast<double>(options.panel_width) * static_cast<double>(columns);
    double height = rows.bottom;
    ChartLayout layout;
    layout.size = kSize;
    for (std::size_t i = 0; i < count; ++i) {
        const double left = options.panel_width * static_cast<double>(i % columns);
        const double top = rows.top + rows.step * static_cast<double>(i / columns);
        const Rect outer{left, top, left + options.panel_width, top + options.panel_height};
        layout.areas.push_back(area_of(chart.panels[i], x, outer, sides));
        if (!rows.one_legend)
            layout.legends.push_back(legend_of(chart.panels[i], layout.areas.back()));
    }
    if (const std::vector<Look> looks = named(chart.panels.front());
        rows.one_legend && !looks.empty()) {
        const LegendGrid grid = grid_of(looks, width - 2 * kEdge);
        layout.legends.push_back(
            place_legend(looks, grid, {0.5 * (width - grid.width), rows.bottom}));
        height += grid.rows * kLegendLine + kEdge;
    }
    multiply(layout, options.scale);
    const auto whole = [&](double side) {  // a side beyond the longest is refused as it is made
        return static_cast<int>(std::lround(std::min(options.scale * side, 2.0 * kLongestSide)));
    };
    layout.width = whole(width);
    layout.height = whole(height);
    return layout;
}

}  // namespace myotet::report
