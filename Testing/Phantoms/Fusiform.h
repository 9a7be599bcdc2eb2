// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"

namespace myotet::phantoms {

/// A spindle about the z axis between two tendons of the same fibres, mm: tendons where
/// z is in [0, 20] and [80, 100], a belly between them of the radius
///   R(z) = 5 + 5 sin^2(pi s),  s = (z - 20) / 60.
inline constexpr double kFusiformLength = 100, kFusiformTendon = 20, kFusiformThin = 5,
                        kFusiformThick = 10;
inline constexpr double kFusiformBelly = kFusiformLength - 2 * kFusiformTendon;

[[nodiscard]] double fusiform_radius(double z);
/// dR/dz
[[nodiscard]] double fusiform_slope(double z);

/// The fibre through a point: along (x R'/R, y R'/R, 1), of length 1; a streamline keeps
/// its share of the radius from end to end.
[[nodiscard]] Vec3 fusiform_fibre(const Vec3& point);

/// Exact signed distances, mm, negative inside; to all of the belly's surface and to that
/// of the nearer tendon, ends included.
[[nodiscard]] double fusiform_belly_distance(const Vec3& point);
[[nodiscard]] double fusiform_tendon_distance(const Vec3& point);

/// mm^3: pi R^2 from end to end, in closed form; of both tendons together.
[[nodiscard]] double fusiform_belly_volume();
[[nodiscard]] double fusiform_tendon_volume();

}  // namespace myotet::phantoms
