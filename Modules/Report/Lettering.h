// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "Report/Stroke.h"

namespace myotet::report {

/// How a line of smooth text is written.
struct Lettering {
    double size = 1.5;    ///< side of a letter's square, pixels; capitals are 7 squares high
    double weight = 0.9;  ///< width of strokes, squares
    double align = 0;     ///< share of the text that is before its place: 0.5 centres it
    bool upward = false;  ///< reads from below to above, not from the left to the right
    Colour colour = kBlack;
};

/// Length of a line of text, pixels.
[[nodiscard]] double lettering_width(std::string_view text, double size);

/// The text, or its beginning and ".." where it is longer than `width` pixels.
[[nodiscard]] std::string shortened(std::string_view text, double size, double width);

/// Writes a line of text with its baseline through `place`: the letters of draw_text with
/// their squares joined by strokes, each as wide as its ink, with g j p q y below the line.
void draw_lettering(Picture& picture, std::string_view text, const Vec2& place,
                    const Lettering& lettering);

}  // namespace myotet::report
