// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/TetMesh.h"

namespace myotet::fibres {

/// Distance of a point from a triangle, mm.
[[nodiscard]] double triangle_distance(const Vec3& point, const Vec3& a, const Vec3& b,
                                       const Vec3& c);

/// Distances of points from the nearest of some triangles, on all threads. Cost: 6 ns a
/// pair.
[[nodiscard]] std::vector<double> surface_distances(const std::vector<Vec3>& points,
                                                    const TriMesh& surface);

}  // namespace myotet::fibres
