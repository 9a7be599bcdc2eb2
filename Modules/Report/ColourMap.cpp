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

}  // namespace myotet::report
