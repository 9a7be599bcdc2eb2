// SPDX-License-Identifier: Apache-2.0
#include "Report/ColourMap.h"

#include <algorithm>
#include <cmath>

namespace myotet::report {
namespace {

constexpr int kPieces = 8;
constexpr int kKnots[kPieces + 1][3] = {{68, 1, 84},    {71, 45, 123},  {59, 82, 139},
                                        {44, 114, 142}, {33, 145, 140}, {40, 174, 128},
                                        {94, 201, 98},  {173, 220, 48}, {253, 231, 37}};

}  // namespace

Colour map_colour(double share) {
    const double at = kPieces * std::clamp(share, 0.0, 1.0);
    const int piece = std::min(static_cast<int>(at), kPieces - 1);
    const double part = at - piece;
    Colour colour;
    for (int c = 0; c < 3; ++c)
        colour[c] = ((1 - part) * kKnots[piece][c] + part * kKnots[piece + 1][c]) / 255;
    return colour;
}

Colour distinct_colour(std::size_t number) {
    constexpr double kGolden = 0.618033988749895, kFirst = 0.58;  // of a turn; blue
    constexpr double kLightness[] = {0.50, 0.64, 0.38};
    constexpr double kSaturation[] = {0.75, 0.55};
    const double hue = std::fmod(kFirst + kGolden * static_cast<double>(number), 1.0);
    const double light = kLightness[number % 3];
    const double reach = kSaturation[number % 2] * std::min(light, 1 - light);
    Colour colour;
    for (int c = 0; c < 3; ++c) {  // hue, saturation, lightness to red, green, blue
        const double k = std::fmod((c == 0 ? 0.0 : c == 1 ? 8.0 : 4.0) + 12 * hue, 12.0);
        colour[c] = light - reach * std::max(-1.0, std::min({k - 3, 9 - k, 1.0}));
    }
    return colour;
}

}  // namespace myotet::report
