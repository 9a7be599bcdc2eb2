// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/Geometry.h"

namespace myotet::phantoms {

/// Exact signed distances, mm, negative inside.
[[nodiscard]] double sphere_distance(const Vec3& point, const Vec3& centre, double radius);
/// Torus about the z axis: `ring` from the axis to the tube's centre.
[[nodiscard]] double torus_distance(const Vec3& point, double ring, double tube);
[[nodiscard]] double box_distance(const Vec3& point, const Box& box);
/// Ellipsoid about the origin. Bisection as in D. Eberly, Distance from a
/// Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid (2013), sec. 3.
[[nodiscard]] double ellipsoid_distance(const Vec3& point, const Vec3& semi_axes);

/// Cross-section of a loft at height z: centre and half widths, mm.
struct Station {
    double z = 0, x = 0, y = 0, half_x = 0, half_y = 0;
};

/// A body along z whose cross-sections are superellipses
/// |dx / half_x|^n + |dy / half_y|^n <= 1, interpolated between stations by
/// monotone cubics (Fritsch and Carlson 1980) and closed by half ellipsoids.
class Loft {
public:
    /// `stations` upwards in z, at least two; `cap` is the height of the ends, mm.
    Loft(std::vector<Station> stations, double cap, double exponent = 2);
    [[nodiscard]] bool contains(const Vec3& point) const;
    [[nodiscard]] const Box& box() const { return box_; }

private:
    [[nodiscard]] Station at(double z) const;

    std::vector<Station> stations_, slopes_;
    double cap_, exponent_;
    Box box_;
};

}  // namespace myotet::phantoms
