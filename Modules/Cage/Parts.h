// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Cage/Predicates.h"

namespace myotet::cage {

/// A part of a surface, connected by points of its triangles.
struct Part {
    Vec3 point;  ///< one of its points
    Box box;
};
[[nodiscard]] std::vector<Part> parts_of(const TriMesh& surface);

/// Whether two triangles of one surface meet. Those with a corner at the same place do there
/// by right: with one such corner they count as meeting when the edge of one that does not end
/// there meets the other, with two or three never. Exact.
[[nodiscard]] bool faces_meet(const Corners3& s, const Corners3& t);

/// Pairs of triangles of a surface that meet so, the smaller number first, in ascending order.
/// Cost: |F| log |F| where triangles are of like size.
[[nodiscard]] std::vector<std::array<std::int32_t, 2>> pairs_that_meet(const TriMesh& surface);

/// Throws InputError when a surface is not one that a cage can be proved to enclose: no
/// triangles, a coordinate that is not finite, an edge without exactly two triangles that agree
/// on their sides (an open one is said as such), triangles that meet. Says how many and where
/// the first lies.
void require_closed(const TriMesh& surface);

}  // namespace myotet::cage
