// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Membrane/Active.h"

namespace myotet::membrane {

/// A node beside a part of the wall that faced it at rest, across the cavity or across
/// the outside.
struct Facing {
    std::int32_t node = 0;
    double side = 1;                  ///< 1: across the cavity, -1: across the outside
    double gap = 0;                   ///< what is kept between the two surfaces, mm
    std::size_t first = 0, last = 0;  ///< of FacingWalls::triangles
};

/// What of the wall may meet soon, found now and then.
struct FacingWalls {
    std::vector<Facing> nodes;
    std::vector<Triangle> triangles;
};

/// Pairs of nodes and drawn triangles that face each other, at rest and now, and are less
/// than `margin` from touching. Across the cavity the surfaces keep twice the thickness, the
/// wall being inside of them, but never more than nine tenths of their distance at rest.
/// Cost: O(nodes in use) and near pairs.
[[nodiscard]] FacingWalls find_facing(const Levels& levels, const Wall& wall, const Active& active,
                                      std::span<const Vec3> x, double margin);

/// Least distance at rest between parts of the given surface that face each other, less
/// what refinement may take of it, mm: no two parts that face can touch before they have
/// come nearer by so much. 0 where that is too much work to find.
[[nodiscard]] double least_clearance(const Levels& levels);

/// Adds, for each node whose distance s from the nearest of its triangles is less than its
/// gap, k A (gap - s) along the line between them, and the opposite to the triangle's
/// corners by that point's barycentric coordinates: minus the gradient of
/// k A (gap - s)^2 / 2, whose sum is returned, N mm.
double add_self_contact(const FacingWalls& facing, const Wall& wall, const Active& active,
                        std::span<const Vec3> x, std::vector<Vec3>& force);

}  // namespace myotet::membrane
