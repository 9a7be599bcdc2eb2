// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Skeleton/Wrap.h"

namespace myotet::skeleton {

using Vec2 = Eigen::Vector2d;

/// A string around a circle about the origin, one way or the other.
struct Winding {
    int sense = 1;      ///< +1: counterclockwise
    double first = 0;   ///< angle of the point where it meets the circle, rad
    double arc = 0;     ///< angle along the circle; not positive: it does not touch
    double before = 0;  ///< length of the straight piece to the circle
    double after = 0;   ///< and from it
    Vec2 middle{1, 0};  ///< unit direction halfway between the ends, by that way
};

/// From one point outside to another by less than a turn.
[[nodiscard]] Winding wind(const Vec2& from, const Vec2& to, double radius, int sense);

/// As find_wrap, in closed form; ends outside.
[[nodiscard]] Wrap wrap_sphere(const WrapObject& object, const Vec3& from, const Vec3& to,
                               const WrapMemory& before);
[[nodiscard]] Wrap wrap_cylinder(const WrapObject& object, const Vec3& from, const Vec3& to,
                                 const WrapMemory& before);

/// Whether a path is held on one half of the object, and the unit direction of that half.
[[nodiscard]] bool has_quadrant(const WrapObject& object);
[[nodiscard]] Vec3 quadrant_direction(const WrapObject& object);

}  // namespace myotet::skeleton
