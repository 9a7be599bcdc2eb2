// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::report {

/// Where a point's coordinates are guessed from, points by their new numbers: of a point that
/// makes a tetrahedron on the face a, b, c of another whose fourth corner is d,
///   guess = 2 (a + b + c) / 3 - d,
/// the mirror of d where both are regular. With only `a`: that point. With none: 0.
struct Guess {
    std::int32_t a = -1, b = -1, c = -1, d = -1;
};

/// A mesh's connections in few bytes, and the order in which they are told.
struct Connections {
    std::string bytes;
    std::vector<std::int32_t> points;    ///< old number of each new one; points of no element go
    std::vector<std::int32_t> elements;  ///< the same of tetrahedra or triangles
    std::vector<Guess> guesses;          ///< of each new point
};

/// Tetrahedra as they grow over their faces, after the cut-border machine of [Gumhold99]: a queue
/// of open faces, and for each one number, of 7 bits a byte, the lowest first:
///   0      what lies behind it was told before, or will not be told;
///   1      nothing lies behind it: it is of the boundary;
///   2      a tetrahedron with a new point;
///   2 + k  a tetrahedron with the k-th last point.
/// A tetrahedron on a face a, b, c (outward, as face_of gives it) is a, b, c, v; its faces
/// opposite a, b and c join the queue. Each piece begins with four such numbers for the corners
/// of its first tetrahedron, 2 or 2 + k, whose four faces join the queue.
/// Two bytes a tetrahedron or so before compression; O(|T|).
[[nodiscard]] Connections tell_tets(const std::vector<Tet>& tets, std::size_t point_count);

/// Triangles one after the other, corner by corner: 0 is a new point, k the k-th last.
[[nodiscard]] Connections tell_triangles(const std::vector<Triangle>& triangles,
                                         std::size_t point_count);

}  // namespace myotet::report
