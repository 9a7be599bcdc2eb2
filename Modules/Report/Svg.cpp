// SPDX-License-Identifier: Apache-2.0
#include "Report/Svg.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "Report/Html.h"

namespace myotet::report {
namespace {

// The drawing, in its own units; a page scales it.
constexpr double kWidth = 560, kHeight = 260;
constexpr double kLeft = 78, kRight = 20, kTop = 12, kBottom = 44;
constexpr int kMostXTicks = 8, kMostYTicks = 6;
constexpr double kRoom = 0.05;        // of a range, at either end
constexpr double kLeastShare = 1e-6;  // of a range's larger end: what a scale can show
constexpr double kFarthest = 1e99;

std::string coordinate(double x) { return formatted("%.1f", x); }

struct Axes {
    Range x, y;
    [[nodiscard]] double across(double value) const {
        return kLeft + (kWidth - kLeft - kRight) * (value - x.least) / (x.most - x.least);
    }
    [[nodiscard]] double down(double value) const {
        return kHeight - kBottom -
               (kHeight - kTop - kBottom) * (value - y.least) / (y.most - y.least);
    }
};

// The range of what was found, widened where a scale could not show it.
Range range_of(double least, double most, double room) {
    if (!(least <= most)) return {0, 1};
    const double size = std::max({std::abs(least), std::abs(most), 1e-9});
    if (most - least < kLeastShare * size) return {least - 0.05 * size, most + 0.05 * size};
    return {least - room * (most - least), most + room * (most - least)};
}

Axes axes_of(const Panel& panel) {
    double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
    for (const Line& line : panel.lines) {
        if (line.x.size() != line.y.size())
            throw InputError("a chart cannot be drawn: line '" + line.name + "' has " +
                             std::to_string(line.x.size()) + " x and " +
                             std::to_string(line.y.size()) + " y; give as many of each");
        for (std::size_t i = 0; i < line.x.size(); ++i) {
            const double x = line.x[i], y = line.y[i];
            if (!(std::abs(x) <= kFarthest) || (std::isfinite(y) && std::abs(y) > kFarthest))
                throw InputError("a chart cannot be drawn: a number of line '" + line.name +
                                 "' is beyond 1e99; leave that point out");
            x0 = std::min(x0, x);
            x1 = std::max(x1, x);
            if (!std::isfinite(y)) continue;
            y0 = std::min(y0, y);
            y1 = std::max(y1, y);
        }
    }
    return {range_of(x0, x1, 0), panel.y_range.value_or(range_of(y0, y1, kRoom))};
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
    return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor +
           "\">" + escaped(text) + "</text>";
}

// Grid, numbers and the names of the axes.
std::string axes_svg(const Axes& axes, const std::string& x_label, const std::string& y_label) {
    std::string grid, numbers;
    for (const Tick& tick : round_ticks(axes.x, kMostXTicks)) {
        const double x = axes.across(tick.value);
        grid += "M" + coordinate(x) + " " + coordinate(kTop) + "V" + coordinate(kHeight - kBottom);
        numbers += text_at(x, kHeight - kBottom + 17, "middle", tick.text);
    }
    for (const Tick& tick : round_ticks(axes.y, kMostYTicks)) {
        const double y = axes.down(tick.value);
        grid += "M" + coordinate(kLeft) + " " + coordinate(y) + "H" + coordinate(kWidth - kRight);
        numbers += text_at(kLeft - 6, y + 4, "end", tick.text);
    }
    const double middle = 0.5 * (kLeft + kWidth - kRight), half = 0.5 * (kTop + kHeight - kBottom);
    numbers += text_at(middle, kHeight - 6, "middle", x_label);
    if (!y_label.empty())
        numbers += "<text transform=\"translate(14 " + coordinate(half) +
                   ") rotate(-90)\" text-anchor=\"middle\">" + escaped(y_label) + "</text>";
    return "<path class=\"rules\" d=\"" + grid + "\"/>" + numbers;
}

std::string line_class(std::size_t number) {
    const std::size_t colours = kPalette.size();
    return "line-" + std::to_string(number % colours) + (number >= colours ? " again" : "");
}

std::string path_of(const Line& line, const Axes& axes) {
    std::string path;
    bool drawn = false;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
        const bool there = std::isfinite(line.y[i]);
        if (there)
            path += (drawn ? "L" : "M") + coordinate(axes.across(line.x[i])) + " " +
                    coordinate(axes.down(line.y[i]));
        drawn = there;
    }
    return path;
}

std::string svg_of(const std::string& alternative, const std::string& content) {
    return "<svg viewBox=\"0 0 " + coordinate(kWidth) + " " + coordinate(kHeight) +
           "\" role=\"img\" aria-label=\"" + escaped(alternative) + "\">" + content + "</svg>";
}

std::string figure_of(const std::string& title, const std::string& content) {
    return "<figure class=\"chart\"><figcaption>" + escaped(title) + "</figcaption>" + content +
           "</figure>\n";
}

// What a line says to those who do not see it.
std::string spoken(const Line& line) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const double y : line.y) {
        if (!std::isfinite(y)) continue;
        least = std::min(least, y);
        most = std::max(most, y);
    }
    if (!(least <= most)) return line.name + " without numbers";
    return line.name + " from " + rounded(least) + " to " + rounded(most);
}

}  // namespace

std::string chart_figure(const Panel& panel, const std::string& x_label) {
    const Axes axes = axes_of(panel);
    std::string legend, lines, alternative = panel.title + " over " + x_label + ": ";
    for (std::size_t l = 0; l < panel.lines.size(); ++l) {
        const Line& line = panel.lines[l];
        legend +=
            "<li><span class=\"key " + line_class(l) + "\"></span>" + escaped(line.name) + "</li>";
        lines += "<path class=\"line " + line_class(l) + "\" d=\"" + path_of(line, axes) + "\"/>";
        alternative += (l > 0 ? ", " : "") + spoken(line);
    }
    return figure_of(panel.title,
                     "<ul class=\"legend\">" + legend + "</ul>" +
                         svg_of(alternative, axes_svg(axes, x_label, panel.y_label) + lines));
}

std::string histogram_figure(const Histogram& histogram, const std::string& title,
                             const std::string& x_label) {
    const std::int64_t most = *std::ranges::max_element(histogram.counts);
    std::int64_t total = 0;
    for (const std::int64_t count : histogram.counts) total += count;
    const Axes axes{histogram.range,
                    {0, 1.05 * static_cast<double>(std::max<std::int64_t>(most, 1))}};
    const auto parts = static_cast<double>(histogram.counts.size());
    const double width = (histogram.range.most - histogram.range.least) / parts;
    std::string bars;
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        const std::int64_t count = histogram.counts[i];
        if (count == 0) continue;
        const double from = histogram.range.least + width * static_cast<double>(i);
        const double left = axes.across(from), right = axes.across(from + width);
        const double top = axes.down(static_cast<double>(count));
        bars += "<rect class=\"bar\" x=\"" + coordinate(left + 0.5) + "\" y=\"" + coordinate(top) +
                "\" width=\"" + coordinate(right - left - 1) + "\" height=\"" +
                coordinate(kHeight - kBottom - top) + "\"><title>" + rounded(from) + " to " +
                rounded(from + width) + ": " + std::to_string(count) + "</title></rect>";
    }
    std::string text = svg_of(title + ", " + std::to_string(total) + " in all",
                              axes_svg(axes, x_label, "") + bars);
    if (histogram.not_finite > 0)
        text += paragraph(std::to_string(histogram.not_finite) + " have no such number.");
    return figure_of(title, text);
}

}  // namespace myotet::report
