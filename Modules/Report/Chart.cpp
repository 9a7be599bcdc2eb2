// SPDX-License-Identifier: Apache-2.0
#include "Report/Chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "Report/ChartLayout.h"
#include "Report/Lettering.h"
#include "Report/Text.h"

namespace myotet::report {
namespace {

constexpr double kLineWidth = 2.2, kAxisWidth = 1, kTitleWeight = 1.15;  // pixels; squares
constexpr double kDash = 3, kDashGap = 2.6, kDotGap = 2.2;               // of a line's width
constexpr Colour kGridGrey{0.88, 0.88, 0.88}, kAxisGrey{0.35, 0.35, 0.35},
    kTextGrey{0.13, 0.13, 0.13};
constexpr double kFarthest = 1e99;  // so that a range with its margin is within 1e100
constexpr int kNarrowest = 240, kLowest = 160;
constexpr double kLeastScale = 0.5, kMostScale = 8;

[[noreturn]] void refuse(const std::string& why) {
    throw InputError("a chart cannot be drawn: " + why);
}

void validate(const Line& line, const std::string& where) {
    if (line.x.size() != line.y.size())
        refuse(where + " has " + std::to_string(line.x.size()) + " x and " +
               std::to_string(line.y.size()) + " y; give as many of each");
    if (line.colour && !(*line.colour >= 0 && *line.colour < static_cast<int>(kPalette.size())))
        refuse(where + " has colour " + std::to_string(*line.colour) +
               ", but colours are from 0 to 7; choose one of them or none");
    for (std::size_t i = 0; i < line.x.size(); ++i) {
        if (!(std::abs(line.x[i]) <= kFarthest))
            refuse(where + ": x " + std::to_string(i) + " is " + rounded(line.x[i]) +
                   ", but must be a number within 1e99; leave that point out");
        if (std::isfinite(line.y[i]) && !(std::abs(line.y[i]) <= kFarthest))
            refuse(where + ": y " + std::to_string(i) + " is " + rounded(line.y[i]) +
                   ", but must be within 1e99; give NaN to leave a gap");
        if (i > 0 && !(line.x[i] >= line.x[i - 1]))
            refuse(where + ": x falls from " + rounded(line.x[i - 1]) + " to " +
                   rounded(line.x[i]) + " at point " + std::to_string(i) +
                   "; sort the points by x");
    }
}

void validate(const Chart& chart) {
    if (chart.panels.empty()) refuse("it has no panel; give at least one");
    if (chart.columns < 1)
        refuse("it has " + std::to_string(chart.columns) + " columns; give at least one");
    for (std::size_t p = 0; p < chart.panels.size(); ++p) {
        const Panel& panel = chart.panels[p];
        const std::string where =
            "panel " + std::to_string(p) + (panel.title.empty() ? "" : " '" + panel.title + "'");
        if (panel.y_range) validate(*panel.y_range, "a chart's " + where + ": the range of y");
        for (std::size_t l = 0; l < panel.lines.size(); ++l) {
            const Line& line = panel.lines[l];
            validate(line, where + ", line " + std::to_string(l) +
                               (line.name.empty() ? "" : " '" + line.name + "'"));
        }
    }
}

// The middle of the pixel that holds a coordinate, so that thin lines are sharp.
double sharp(double coordinate) { return std::floor(coordinate) + 0.5; }

// Draws with all lengths of a layout's scale.
class Artist {
public:
    Artist(const ChartLayout& layout, const ChartOptions& options)
        : layout_(layout), scale_(options.scale), picture_(blank(layout.width, layout.height)) {}

    void write(const std::string& text, const Vec2& place, Lettering lettering) {
        lettering.colour = kTextGrey;
        draw_lettering(picture_, text, place, lettering);
    }

    void title(const std::string& text) {
        const double size = kChartTitleFactor * layout_.size, edge = scale_ * kEdge;
        write(shortened(text, size, layout_.width - 2 * edge),
              {0.5 * layout_.width, edge + size * kLetterHeight},
              {.size = size, .weight = kTitleWeight, .align = 0.5});
    }

    void labels(const Panel& panel, const std::string& x_label, const PlotArea& area) {
        const auto& [left, top, right, bottom] = area.rect;
        const double size = layout_.size, title_size = kTitleFactor * size;
        const double edge = scale_ * kEdge, middle = 0.5 * (left + right);
        write(shortened(panel.title, title_size, area.outer.right - area.outer.left - 2 * edge),
              {middle, top - scale_ * kLabelGap},
              {.size = title_size, .weight = kTitleWeight, .align = 0.5});
        write(shortened(x_label, size, right - left), {middle, area.outer.bottom - edge},
              {.size = size, .align = 0.5});
        write(shortened(panel.y_label, size, bottom - top),
              {area.outer.left + edge + size * kLetterHeight, 0.5 * (top + bottom)},
              {.size = size, .align = 0.5, .upward = true});
    }

    void grid(const PlotArea& area) {
        const Pen pen{.width = pixels(1), .colour = kGridGrey};
        for (const Tick& tick : area.x_ticks) {
            const double x = sharp(area.at(tick.value, area.y.least).x());
            stroke({{x, area.rect.top}, {x, area.rect.bottom}}, pen);
        }
        for (const Tick& tick : area.y_ticks) {
            const double y = sharp(area.at(area.x.least, tick.value).y());
            stroke({{area.rect.left, y}, {area.rect.right, y}}, pen);
        }
    }

    void axes(const PlotArea& area) {
        const Pen pen{.width = pixels(kAxisWidth), .colour = kAxisGrey};
        const double left = sharp(area.rect.left), bottom = sharp(area.rect.bottom);
        const double length = scale_ * kTickLength, gap = length + scale_ * kTickGap;
        const double size = layout_.size, letter = size * kLetterHeight;
        stroke({{left, sharp(area.rect.top)}, {left, bottom}, {sharp(area.rect.right), bottom}},
               pen);
        for (const Tick& tick : area.x_ticks) {
            const double x = sharp(area.at(tick.value, area.y.least).x());
            stroke({{x, bottom}, {x, bottom + length}}, pen);
            write(tick.text, {x, bottom + gap + letter}, {.size = size, .align = 0.5});
        }
        for (const Tick& tick : area.y_ticks) {
            const double y = sharp(area.at(area.x.least, tick.value).y());
            stroke({{left - length, y}, {left, y}}, pen);
            write(tick.text, {left - gap, y + 0.5 * letter}, {.size = size, .align = 1});
        }
    }

    void line(const Line& line, const Look& look, const PlotArea& area) {
        std::vector<Vec2> path;
        path.reserve(line.x.size());
        for (std::size_t i = 0; i < line.x.size(); ++i)
            path.push_back(area.at(line.x[i], line.y[i]));
        Pen pen = pen_of(look);
        const double half = 0.5 * pen.width;  // a line along the panel's side is drawn whole
        pen.clip = {area.rect.left - half, area.rect.top - half, area.rect.right + half,
                    area.rect.bottom + half};
        draw_path(picture_, path, pen);
    }

    void legend(const LegendPlace& place) {
        for (std::size_t i = 0; i < place.looks.size(); ++i) {
            const Vec2 middle = place.corners[i] + Vec2(0, 0.5 * scale_ * kLegendLine);
            const double length = scale_ * kSampleLength, size = layout_.size;
            stroke({middle, middle + Vec2(length, 0)}, pen_of(place.looks[i]));
            write(place.looks[i].name,
                  middle + Vec2(length + scale_ * kSampleGap, 0.5 * size * kLetterHeight),
                  {.size = size});
        }
    }

    [[nodiscard]] Picture take() { return std::move(picture_); }

private:
    [[nodiscard]] double pixels(double width) const {
        return std::max(1.0, std::round(scale_ * width));
    }

    void stroke(std::initializer_list<Vec2> path, const Pen& pen) {
        draw_path(picture_, {path.begin(), path.size()}, pen);
    }

    [[nodiscard]] Pen pen_of(const Look& look) const {
        const double width = scale_ * kLineWidth;
        Pen pen{.width = width, .colour = look.colour};
        if (look.style == LineStyle::dashed) pen.down = kDash * width, pen.up = kDashGap * width;
        if (look.style == LineStyle::dotted) pen.up = kDotGap * width;
        return pen;
    }

    const ChartLayout& layout_;
    double scale_;
    Picture picture_;
};

}  // namespace

void ChartOptions::validate() const {
    const auto is_side = [](int side, int least) { return side >= least && side <= kLongestSide; };
    if (!is_side(panel_width, kNarrowest) || !is_side(panel_height, kLowest))
        refuse("its panels are " + std::to_string(panel_width) + " x " +
               std::to_string(panel_height) + " pixels, but must be from " +
               std::to_string(kNarrowest) + " x " + std::to_string(kLowest) + " to " +
               std::to_string(kLongestSide) + " a side");
    if (!(scale >= kLeastScale && scale <= kMostScale))
        refuse("its scale is " + rounded(scale) + ", but must be from 0.5 to 8");
}

Picture draw_chart(const Chart& chart, const ChartOptions& options) {
    options.validate();
    validate(chart);
    const ChartLayout layout = lay_out(chart, options);
    Artist artist(layout, options);
    artist.title(chart.title);
    for (std::size_t p = 0; p < chart.panels.size(); ++p) {
        const Panel& panel = chart.panels[p];
        const PlotArea& area = layout.areas[p];
        const std::vector<Look> looks = looks_of(panel);
        artist.grid(area);
        artist.axes(area);
        for (std::size_t l = 0; l < looks.size(); ++l) artist.line(panel.lines[l], looks[l], area);
        artist.labels(panel, chart.x_label, area);
    }
    for (const LegendPlace& legend : layout.legends) artist.legend(legend);
    return artist.take();
}

}  // namespace myotet::report
