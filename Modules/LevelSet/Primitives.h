// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"

namespace myotet::levelset {

/// Exact signed distances (mm, negative inside) from a point to solids. All
/// lengths are in mm and must be positive where a solid needs them to be.
[[nodiscard]] double sphere_distance(const Vec3& point, const Vec3& centre, double radius);

/// Ellipsoid about the origin along the axes. Bisection for the foot, as in
/// D. Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a
/// Hyperellipsoid (2013), sec. 3.
[[nodiscard]] double ellipsoid_distance(const Vec3& point, const Vec3& semi_axes);

/// The hull of two balls: a capsule where their radii are equal. Where one
/// ball holds the other it is that ball.
struct RoundCone {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double radius_from = 0, radius_to = 0;
};
[[nodiscard]] double round_cone_distance(const Vec3& point, const RoundCone& cone);

/// A cone with flat ends, cut across its axis at `from` and `to`: a cylinder
/// where the radii are equal. One radius may be zero.
[[nodiscard]] double cone_distance(const Vec3& point, const RoundCone& cone);

/// Box about the origin along the axes, of half these side lengths.
[[nodiscard]] double box_distance(const Vec3& point, const Vec3& half_sides);

/// Torus about the origin and the z axis: `ring` from there to the tube's middle.
[[nodiscard]] double torus_distance(const Vec3& point, double ring, double tube);

/// Half-space behind the plane through `on` across the unit vector `outward`.
[[nodiscard]] double half_space_distance(const Vec3& point, const Vec3& on, const Vec3& outward);

}  // namespace myotet::levelset
