// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "Core/TetMesh.h"

namespace myotet::cage {

// Signs of determinants of the given coordinates, without rounding: a bound on the error of
// the ordinary sum decides almost always, else the determinant is expanded exactly
// [Shewchuk 1997, Discrete Comput. Geom. 18:305-363]. Differences and products must neither
// overflow nor fall below 1e-290: coordinates between 1e-90 and 1e90 in magnitude, or zero.

/// Sign of (b - a) x (c - a) . (d - a): 1 when the tetrahedron is positive, 0 when the four
/// points lie in one plane, -1 otherwise.
[[nodiscard]] int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of the area of (a, b, c) seen along `axis`, of coordinates (axis + 1, axis + 2) mod 3:
/// the sign of that component of (b - a) x (c - a).
[[nodiscard]] int orient2d(int axis, const Vec3& a, const Vec3& b, const Vec3& c);

using Corners3 = std::array<Vec3, 3>;
using Corners4 = std::array<Vec3, 4>;

/// Whether the three corners lie on one line.
[[nodiscard]] bool flat(const Corners3& t);

/// Whether the closed segment p q and the closed triangle, which is not flat, have a point in
/// common; touching counts. Exact.
[[nodiscard]] bool segment_meets(const Vec3& p, const Vec3& q, const Corners3& t);

/// Whether two closed triangles have a point in common; touching counts. `s` must not be flat,
/// `t` may be. Exact.
[[nodiscard]] bool triangles_meet(const Corners3& s, const Corners3& t);

/// Whether p lies in a closed positive tetrahedron. Exact.
[[nodiscard]] bool holds(const Corners4& tet, const Vec3& p);

/// Whether a closed positive tetrahedron and a closed triangle have a point in common. Exact.
[[nodiscard]] bool meets(const Corners4& tet, const Corners3& t);

/// How a segment p q passes a triangle: 1 when it goes through the inside against the normal
/// (b - a) x (c - a), that is from outside inwards, -1 with it, 0 when it misses.
/// `doubtful` becomes true when it touches the triangle's plane at an end or its rim. Exact.
[[nodiscard]] int passes(const Vec3& p, const Vec3& q, const Corners3& t, bool& doubtful);

}  // namespace myotet::cage
