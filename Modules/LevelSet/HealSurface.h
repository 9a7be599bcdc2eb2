// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "Core/TetMesh.h"

namespace myotet::levelset {

/// How much of a surface was wrong, and how much of the result is a guess.
struct HealSummary {
    std::int64_t open_edges = 0;         ///< edges of one triangle alone
    std::int64_t holes = 0;              ///< connected rims of such edges, all closed
    std::int64_t doubled_triangles = 0;  ///< left out: another has the same corners
    std::int64_t turned_triangles = 0;   ///< turned around to face outwards
    std::int64_t crossing_pairs = 0;     ///< triangles that cross each other
    double guessed_area = 0;             ///< of the closing surface, mm^2
    double guessed_share = 0;            ///< of the whole surface, 0 to 1
    /// Of the samples more than one spacing away from all triangles and near
    /// the surface: how many have a winding number between 0.1 and 0.9, that
    /// is, neither surely inside nor surely outside.
    double doubtful_share = 0;
};

/// The surface without doubled triangles and with its triangles turned to face
/// outwards where that is sure: alike across edges of two triangles; a piece
/// against the rims of others that run along its own; and all that hangs
/// together so by the sign of its volume, unless it is a cavity of the rest.
/// What is not sure stays as it is. Fills in the first four counts.
/// Cost: O(n log n), and the square of the number of open edges.
[[nodiscard]] TriMesh orient_surface(const TriMesh& surface, HealSummary& summary);

}  // namespace myotet::levelset
