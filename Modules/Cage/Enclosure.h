// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "Cage/SurfaceTree.h"

namespace myotet::cage {

/// What stands against a mesh enclosing a surface; all counts are exact.
struct Enclosure {
    std::int64_t tets_not_positive = 0;
    std::int64_t faces_that_meet = 0;   ///< boundary faces with a point in common with the surface
    std::int64_t faces_that_cross = 0;  ///< pairs of boundary faces, not neighbours, that meet
    std::int64_t parts_outside = 0;     ///< connected parts of the surface in no tetrahedron
    std::string where;                  ///< the first of these; empty when enclosed
    [[nodiscard]] bool enclosed() const { return where.empty(); }
};

/// Proves that a mesh encloses a surface: its tetrahedra are positive, its boundary neither
/// meets the surface nor itself, and of each connected part of the surface one point lies in a
/// tetrahedron. A connected part that does not meet the boundary is then inside as a whole.
/// Every decision is exact (Predicates.h); touching counts as meeting. Faces count as
/// neighbours when they have a corner at the same place; of those with one such corner, an edge
/// of one may not pass through the other.
/// Cost: |boundary| log |F| + |T| times the number of parts.
[[nodiscard]] Enclosure prove_enclosure(const TetMesh& mesh, const TriMesh& surface,
                                        const SurfaceTree& tree);

}  // namespace myotet::cage
