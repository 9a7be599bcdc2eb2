// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Report/Picture.h"
#include "Report/Ticks.h"

namespace myotet::report {

/// Eight colours that the colour-blind tell apart (M. Okabe and K. Ito, Color Universal
/// Design, 2008), the palest on white at the end.
inline constexpr std::array<Colour, 8> kPalette{{
    {0 / 255.0, 114 / 255.0, 178 / 255.0},    // blue
    {213 / 255.0, 94 / 255.0, 0 / 255.0},     // vermilion
    {0 / 255.0, 158 / 255.0, 115 / 255.0},    // bluish green
    {204 / 255.0, 121 / 255.0, 167 / 255.0},  // reddish purple
    {230 / 255.0, 159 / 255.0, 0 / 255.0},    // orange
    {86 / 255.0, 180 / 255.0, 233 / 255.0},   // sky blue
    {0, 0, 0},                                // black
    {240 / 255.0, 228 / 255.0, 66 / 255.0},   // yellow
}};

enum class LineStyle { solid, dashed, dotted };

/// A quantity over time.
struct Line {
    std::string name;          ///< in the legend; empty: not there
    std::vector<double> x, y;  ///< as many of each; x finite and never falling
    LineStyle style = LineStyle::solid;
    /// A number in kPalette, as for a line and its reference. None: as many as there are such
    /// lines before it in the panel; from 8 on, colours come again and solid lines are dashed,
    /// from 16 on dotted.
    std::optional<int> colour;
};

/// Lines on the same axes. A y that is not finite breaks its line.
struct Panel {
    std::string title, y_label;
    std::vector<Line> lines;       ///< the later is drawn over the earlier
    std::optional<Range> y_range;  ///< none: of the lines, with 5 % more at either end
};

/// Panels from left to right in rows; all show the same range of x.
struct Chart {
    std::string title, x_label;
    std::vector<Panel> panels;
    int columns = 1;
};

/// Sizes, pixels.
struct ChartOptions {
    int panel_width = 480;   ///< with the numbers and the label of y
    int panel_height = 300;  ///< with title, numbers and label of x, without the legend
    double scale = 1;        ///< all that is drawn, panels too, times this: 2 for dense displays

    /// Throws InputError unless a panel is from 240 x 160 to kLongestSide and the scale from
    /// 0.5 to 8.
    void validate() const;
};

/// Draws a chart on white: grid and axes with round numbers, smooth lines, each panel's
/// legend below it, or one below all when it would be the same for each. Lines that leave a
/// given y_range are cut off at the panel; of data that are constant or missing, a range
/// around them or from 0 to 1 is shown. Texts too long for their place end in "..". The same
/// bytes for the same chart.
///
/// Throws InputError that says which panel and line: no panel or no column, an x without its
/// y, an x that falls or is not finite, a colour below 0 or above 7, a y_range that is not
/// valid, a number beyond 1e99.
/// Cost: points, and the pixels their lines pass.
[[nodiscard]] Picture draw_chart(const Chart& chart, const ChartOptions& options = {});

}  // namespace myotet::report
