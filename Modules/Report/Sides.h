// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"
#include "Report/Picture.h"

namespace myotet::report {

/// The patient's side that a direction in LPS points to most: L, R, P, A, S or I.
[[nodiscard]] char side_of(const Vec3& direction);

/// The patient's sides at a picture's four.
struct Sides {
    char left = ' ', right = ' ', top = ' ', bottom = ' ';
};

/// Of a picture seen along `direction` with `up` upwards; see View.
[[nodiscard]] Sides sides_of(const Vec3& direction, const Vec3& up);

/// Writes the letters at the middles of a picture's sides, grey on a halo of white.
void draw_sides(Picture& picture, const Sides& sides);

}  // namespace myotet::report
