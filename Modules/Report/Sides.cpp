// SPDX-License-Identifier: Apache-2.0
#include "Report/Sides.h"

#include <algorithm>

#include "Report/Lettering.h"
#include "Report/Text.h"

namespace myotet::report {
namespace {

constexpr Colour kGrey{0.35, 0.35, 0.35};
constexpr double kSidePerLetterSize = 190, kHalo = 3;  // pixels a square; squares
constexpr double kMargin = 3;                          // squares

void draw_letter(Picture& picture, char side, const Vec2& place, double size) {
    const std::string_view text(&side, 1);
    draw_lettering(picture, text, place,
                   {.size = size, .weight = kHalo, .align = 0.5, .colour = kWhite});
    draw_lettering(picture, text, place,
                   {.size = size, .weight = 1.2, .align = 0.5, .colour = kGrey});
}

}  // namespace

char side_of(const Vec3& direction) {
    int axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    constexpr char kAbove[] = "LPS", kBelow[] = "RAI";
    return direction[axis] > 0 ? kAbove[axis] : kBelow[axis];
}

Sides sides_of(const Vec3& direction, const Vec3& up) {
    const Vec3 away = direction.normalized(), right = away.cross(up).normalized();
    const Vec3 down = away.cross(right);
    return {side_of(-right), side_of(right), side_of(-down), side_of(down)};
}

void draw_sides(Picture& picture, const Sides& sides) {
    const double size = std::max(1.0, std::min(picture.width, picture.height) / kSidePerLetterSize);
    const double margin = kMargin * size, high = kLetterHeight * size;
    const double middle = 0.5 * picture.width, half = 0.5 * (picture.height + high);
    draw_letter(picture, sides.left, {margin + 0.5 * kLetterWidth * size, half}, size);
    draw_letter(picture, sides.right, {picture.width - margin - 0.5 * kLetterWidth * size, half},
                size);
    draw_letter(picture, sides.top, {middle, margin + high}, size);
    draw_letter(picture, sides.bottom, {middle, picture.height - margin}, size);
}

}  // namespace myotet::report
