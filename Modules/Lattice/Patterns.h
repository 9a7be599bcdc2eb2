// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::lattice {

/// Edge e of a tetrahedron joins nodes kEdge[e][0] and kEdge[e][1]. Edges 0
/// and 5, 1 and 4, 2 and 3 are opposite.
inline constexpr int kEdge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/// Edges of the faces opposite nodes 0, 1, 2, 3.
inline constexpr int kFaceEdges[4][3] = {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}};

/// Patterns are bit sets of bisected edges.
inline constexpr unsigned kAllEdges = 63;

/// The smallest allowed pattern that contains `pattern`: nothing, one edge,
/// two opposite edges, the three edges of a face, or all six (red)
/// [Teran05, sec. 4].
[[nodiscard]] unsigned closed_pattern(unsigned pattern);

/// The eight red children, with the order of nodes that RedGreenLattice keeps;
/// `mids` are the six midpoints. Children of a positive parent are positive.
[[nodiscard]] std::array<Tet, 8> red_children(const Tet& parent,
                                              const std::array<std::int32_t, 6>& mids);

/// Appends the green children for a closed pattern other than 0 and red.
void append_green_children(const Tet& parent, unsigned pattern,
                           const std::array<std::int32_t, 6>& mids, std::vector<Tet>& children);

}  // namespace myotet::lattice
