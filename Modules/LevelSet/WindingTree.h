// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::levelset {

/// Triangles in a tree of boxes, each with what the winding number needs to
/// know of its triangles from afar.
struct WindingTree {
    struct Node {
        Box box = {};
        std::int32_t first = 0, count = 0;  ///< triangles in `order`
        std::int32_t child = -1;            ///< the first of two neighbouring nodes; -1: a leaf
        Vec3 centre = Vec3::Zero();         ///< of the area
        Vec3 dipole = Vec3::Zero();         ///< sum of area times normal, mm^2
        Mat3 moment = Mat3::Zero();         ///< sum of area times normal (x) place, mm^3
        double radius = 0;                  ///< of the ball around `centre` that holds all, mm
    };
    std::vector<Node> nodes;                   ///< the root first; none without triangles
    std::vector<std::int32_t> order;           ///< triangle numbers of the surface
    std::vector<std::array<Vec3, 3>> corners;  ///< in that order
};

/// Cost: O(n log n).
[[nodiscard]] WindingTree build_winding_tree(const TriMesh& surface);

/// Generalised winding number at a point: the solid angle of all triangles over
/// 4 pi; 1 inside and 0 outside a closed outward surface, in between near the
/// gaps of an open one (Jacobson, Kavan, Sorkine-Hornung 2013, ACM Trans. Graph.
/// 32(4)). Nodes farther away than three of their radii count by their
/// expansion to second order (Barill, Dickson, Schmidt, Levin, Jacobson 2018,
/// ACM Trans. Graph. 37(4)); errs by less than 0.02.
/// Cost: O(log n).
[[nodiscard]] double winding_number(const WindingTree& tree, const Vec3& point);

/// The same by the sum over all triangles. Cost: O(n).
[[nodiscard]] double exact_winding_number(const WindingTree& tree, const Vec3& point);

/// Distance to the nearest triangle, or `bound` when none is nearer. With a
/// mask, per triangle of the surface, those that are 0 do not count.
[[nodiscard]] double distance_to_triangles(const WindingTree& tree, const Vec3& point, double bound,
                                           std::span<const std::uint8_t> mask = {});

/// True when a triangle of the mask crosses the segment a b.
[[nodiscard]] bool crosses_triangle(const WindingTree& tree, const Vec3& a, const Vec3& b,
                                    std::span<const std::uint8_t> mask = {});

/// Pairs of triangles that cross each other; those with a corner in common do
/// not count. Cost: O(n log n) where triangles are of like size.
[[nodiscard]] std::int64_t count_crossing_pairs(const WindingTree& tree);

}  // namespace myotet::levelset
