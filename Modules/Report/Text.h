// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "Report/Picture.h"

namespace myotet::report {

/// Letters are 5 x 7 squares, one square apart.
inline constexpr int kLetterWidth = 5, kLetterHeight = 7, kLetterStep = 6;

/// Whether a letter's square is drawn: `column` from the left, `row` from the top.
[[nodiscard]] bool is_inked(char letter, int column, int row);

/// Width of a line of text whose squares are `size` pixels wide, pixels.
[[nodiscard]] int text_width(std::string_view text, int size);

/// Draws a line of text with its upper left corner at (x, y), in black, letters of squares
/// `size` pixels wide. Known are the letters a to z and A to Z, digits and . , : ; - + * / =
/// ( ) [ ] < > % _ ^ ' ! ?; a byte that is none of them is drawn as a box. What leaves the
/// picture is cut off.
void draw_text(Picture& picture, std::string_view text, std::array<int, 2> corner, int size);

}  // namespace myotet::report
