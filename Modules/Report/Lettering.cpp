// SPDX-License-Identifier: Apache-2.0
#include "Report/Lettering.h"

#include <algorithm>
#include <limits>

#include "Report/Text.h"

namespace myotet::report {
namespace {

constexpr int kRows = kLetterHeight + 2;  // two below the baseline
constexpr int kSpace = 3;                 // squares, without the gaps beside it
constexpr double kGap = 1.4;              // between letters, squares

// What strokes draw otherwise than squares do.
constexpr std::string_view kLetters = "0il.,:;gjpqy";
constexpr std::string_view kLetterRows[kRows] = {
    ".##.. #.... #.... ..... ..... ..... ..... ..... ..... ..... ..... .....",
    "#..#. ..... #.... ..... ..... ..... ..... ..... ..#.. ..... ..... .....",
    "#..#. #.... #.... ..... ..... ..... ..... .###. ..... ####. .#### #...#",
    "#..#. #.... #.... ..... ..... .#... .#... #...# ..#.. #...# #...# #...#",
    "#..#. #.... #.... ..... ..... ..... ..... #...# ..#.. #...# #...# #...#",
    "#..#. #.... #.... ..... ..... ..... ..... #...# ..#.. #...# #...# #...#",
    ".##.. #.... #.... .#... .#... .#... .#... .#### ..#.. ####. .#### .####",
    "..... ..... ..... ..... #.... ..... #.... ....# ..#.. #.... ....# ....#",
    "..... ..... ..... ..... ..... ..... ..... .###. ##... #.... ....# .###."};
static_assert(std::ranges::all_of(kLetterRows, [](std::string_view row) {
    return row.size() == kLetters.size() * kLetterStep - 1;
}));

bool is_stroked(char letter, int column, int row) {
    if (column < 0 || column >= kLetterWidth || row < 0 || row >= kRows) return false;
    if (const std::size_t at = kLetters.find(letter); at != std::string_view::npos)
        return kLetterRows[row][at * kLetterStep + column] == '#';
    return row < kLetterHeight && is_inked(letter, column, row);
}

// The first column with ink and the last; a space has kSpace of none.
struct Columns {
    int first, last;
};

Columns columns_of(char letter) {
    Columns columns{kLetterWidth, -1};
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kLetterWidth; ++column)
            if (is_stroked(letter, column, row))
                columns = {std::min(columns.first, column), std::max(columns.last, column)};
    return columns.last < 0 ? Columns{0, kSpace - 1} : columns;
}

double width_of(char letter) {
    const Columns columns = columns_of(letter);
    return columns.last - columns.first + 1;
}

// Adds a letter's strokes, squares: from each square to those after it that touch it, to
// those at its corners where no other square leads there.
void add_strokes(char letter, double left, std::vector<Vec2>& path) {
    const Vec2 lift = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    const int first = columns_of(letter).first;
    const auto centre = [&](int column, int row) {
        return Vec2(left + column - first + 0.5, row + 0.5 - kLetterHeight);
    };
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kLetterWidth; ++column) {
            if (!is_stroked(letter, column, row)) continue;
            const bool right = is_stroked(letter, column + 1, row);
            const bool below = is_stroked(letter, column, row + 1);
            path.insert(path.end(), {centre(column, row), lift});
            const auto join = [&](int to_column, int to_row) {
                path.insert(path.end(), {centre(column, row), centre(to_column, to_row), lift});
            };
            if (right) join(column + 1, row);
            if (below) join(column, row + 1);
            if (!right && !below && is_stroked(letter, column + 1, row + 1))
                join(column + 1, row + 1);
            if (!below && is_stroked(letter, column - 1, row + 1) &&
                !is_stroked(letter, column - 1, row))
                join(column - 1, row + 1);
        }
}

}  // namespace

double lettering_width(std::string_view text, double size) {
    double squares = 0;
    for (const char letter : text) squares += width_of(letter) + kGap;
    return text.empty() ? 0 : size * (squares - kGap);
}

std::string shortened(std::string_view text, double size, double width) {
    if (lettering_width(text, size) <= width) return std::string(text);
    std::string made;
    for (std::size_t count = text.size(); count-- > 0;) {
        made = std::string(text.substr(0, count)) + "..";
        if (lettering_width(made, size) <= width) break;
    }
    return made;
}

void draw_lettering(Picture& picture, std::string_view text, const Vec2& place,
                    const Lettering& lettering) {
    std::vector<Vec2> path;
    double left = 0;
    for (const char letter : text) {
        add_strokes(letter, left, path);
        left += width_of(letter) + kGap;
    }
    const double shift = lettering.align * lettering_width(text, lettering.size);
    for (Vec2& p : path) {
        const Vec2 along(lettering.size * p.x() - shift, lettering.size * p.y());
        p = place + (lettering.upward ? Vec2(along.y(), -along.x()) : along);
    }
    draw_path(picture, path,
              {.width = lettering.weight * lettering.size, .colour = lettering.colour});
}

}  // namespace myotet::report
