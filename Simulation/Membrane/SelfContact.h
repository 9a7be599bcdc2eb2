// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Membrane/Active.h"

namespace myotet::membrane {

/// A triangle that a node faces, and what is kept between them, mm.
struct FacingPart {
    Triangle corners;
    double gap = 0;
};

/// A node, and the parts of the wall that it faced at rest, across the cavity or across the
/// outside, and may meet.
struct Facing {
    std::int32_t node = 0;
    std::size_t first = 0, last = 0;  ///< of FacingWalls::parts
};

/// What of the wall may meet soon, found now and then.
struct FacingWalls {
    std::vector<Facing> nodes;
    std::vector<FacingPart> parts;
};

/// Pairs of nodes and drawn triangles that face each other, at rest and now, and are less
/// than `margin` from touching. Across the cavity surfaces keep twice the thickness, the wall
/// being inside of them, across the outside half of it; never more than nine tenths of their
/// distance at rest. Cost: O(nodes in use) and near pairs.
[[nodiscard]] FacingWalls find_facing(const Levels& levels, const Wall& wall, const Active& active,
                                      std::span<const Vec3> x, double margin);

/// Least distance at rest between parts of the given surface that face each other, less
/// what refinement may take of it, mm: no two parts that face can touch before they have
/// come nearer by so much. 0 where that is too much work to find.
[[nodiscard]] double least_clearance(const Levels& levels);

/// Adds, for each node, of the parts that it faces the one with the largest gap - s, s being
/// its distance from the part's nearest point: k A (gap - s), where positive, along the line
/// between them, and the opposite to the part's corners by that point's barycentric
/// coordinates. It is minus the gradient of k A (gap - s)^2 / 2, whose sum is returned, N mm.
double add_self_contact(const FacingWalls& facing, const Wall& wall, const Active& active,
                        std::span<const Vec3> x, std::vector<Vec3>& force);

}  // namespace myotet::membrane
