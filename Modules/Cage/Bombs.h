// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cage/Sculpt.h"

namespace myotet::cage {

/// What was found and done.
struct BombSummary {
    std::int64_t bombs = 0;       ///< tetrahedra with two or more boundary faces
    std::int64_t pinched = 0;     ///< edges and nodes that the boundary passes more than once
    std::int64_t added_tets = 0;  ///< put back
    std::int64_t groups = 0;      ///< independent of each other
    std::int64_t greedy = 0;      ///< groups too large to be searched through
};

/// Kept tetrahedra with two or more faces that belong to no other kept one.
[[nodiscard]] std::vector<std::int32_t> find_bombs(const Sculpture& s);

/// Puts tetrahedra back until there are no bombs: for each, all those around one of its
/// nodes, a snowflake, and of all such choices one that adds the fewest [Stuart13, sec. 3.2].
/// Bombs whose choices share no removed tetrahedron are independent; each group is searched by
/// branch and bound, and one that takes more than `kSearch` steps keeps the best found by then,
/// which is at least as good as taking the cheapest snowflake for one bomb after another.
/// Edges around which the kept tetrahedra form more than one fan, and nodes around which the
/// removed ones do, are closed the same way: there the boundary is no surface, nor would it be
/// with the node split (Body.h).
inline constexpr std::int64_t kSearch = 200000;
BombSummary defuse(Sculpture& s);

}  // namespace myotet::cage
