// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "Core/TetMesh.h"

namespace myotet::contraction {

/// For each of some nodes the tetrahedron that holds it, or else the nearest one within
/// `reach` mm, or -1. Of several equally near ones that in which the node's least
/// barycentric coordinate is greatest, so that as little as possible is extrapolated.
/// Flat and inverted tetrahedra are passed over.
///
/// Through a grid of the tetrahedra near the nodes, searched ring by ring. Cost: about
/// 10 ns a tetrahedron and a few us a node that finds one; same result on any number of
/// threads.
[[nodiscard]] std::vector<std::int32_t> nearest_tets(const std::vector<Vec3>& x,
                                                     std::span<const std::int32_t> nodes,
                                                     const std::vector<Tet>& tets, double reach);

/// Barycentric coordinates of a point in a tetrahedron that is not flat.
[[nodiscard]] std::array<double, 4> barycentric(const std::array<Vec3, 4>& corner, const Vec3& p);

}  // namespace myotet::contraction
