// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "Report/Draw.h"

namespace myotet::report {

/// A ball of rings and meridians around a centre.
inline TriMesh ball(const Vec3& centre, double radius, int rings, int meridians) {
    TriMesh made;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < meridians; ++j) {
            const double a = std::numbers::pi * i / rings;
            const double b = 2 * std::numbers::pi * j / meridians;
            made.points.push_back(centre + radius * Vec3(std::sin(a) * std::cos(b),
                                                         std::sin(a) * std::sin(b), std::cos(a)));
        }
    const auto at = [&](int i, int j) { return i * meridians + j % meridians; };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < meridians; ++j) {
            made.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            made.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return made;
}

/// A square across y, from -half to half in x and z.
inline TriMesh square(double half, double y) {
    return {.points = {{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}},
            .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

/// A pixel's channels, 0 to 255.
inline std::array<int, 3> pixel(const Picture& picture, int x, int y) {
    const std::size_t at = picture.offset(x, y);
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

inline constexpr std::array<int, 3> kWhitePixel{255, 255, 255};

}  // namespace myotet::report
