// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Report/Chart.h"
#include "Report/Stroke.h"

namespace myotet::report {

/// How a line looks in its panel and in the legend.
struct Look {
    std::string name;
    Colour colour;
    LineStyle style = LineStyle::solid;

    bool operator==(const Look&) const = default;
};

/// The looks of a panel's lines, in their order.
[[nodiscard]] std::vector<Look> looks_of(const Panel& panel);

/// Where a panel's lines are.
struct PlotArea {
    Rect outer;  ///< with numbers and labels, without the legend
    Rect rect;   ///< of the lines
    Range x, y;
    std::vector<Tick> x_ticks, y_ticks;

    /// Where a point is in the picture; beyond 1e6 pixels, there.
    [[nodiscard]] Vec2 at(double x_value, double y_value) const;
};

/// A legend: entries below one another in columns, each from its own upper left corner.
struct LegendPlace {
    std::vector<Look> looks;  ///< names as they are written, too long ones shortened
    std::vector<Vec2> corners;
};

/// Where what goes in a chart's picture, pixels.
struct ChartLayout {
    int width = 0, height = 0;
    double size = 1.5;            ///< a letter's square
    std::vector<PlotArea> areas;  ///< one a panel
    std::vector<LegendPlace> legends;
};

/// Lengths in a chart, pixels at scale 1.
inline constexpr double kEdge = 10, kTickLength = 4, kTickGap = 5, kLabelGap = 9,
                        kSampleLength = 34, kSampleGap = 8, kLegendLine = 20, kTitleFactor = 1.12,
                        kChartTitleFactor = 1.4;

/// Lays out a chart that keeps draw_chart's rules, with options that are valid.
[[nodiscard]] ChartLayout lay_out(const Chart& chart, const ChartOptions& options);

}  // namespace myotet::report
