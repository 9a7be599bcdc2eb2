// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::cage {

/// Coordinates of a point by a tetrahedron's corners; their sum is 1.
using Weights = std::array<double, 4>;

/// The tetrahedron that a point belongs to.
struct Holder {
    std::int32_t tet = -1;
    Weights weights{0, 0, 0, 0};
    double distance = 0;  ///< from the point to the tetrahedron, mm; 0: it is inside
};

/// Boxes around tetrahedra, halved at the middle of their centres along the longest side:
/// finds the tetrahedron of a point in about log |T|, however sizes differ.
class TetTree {
public:
    /// Keeps a copy of what it needs. Throws MeshError naming the tetrahedron when there is
    /// none, one names a point that is not there or is not positive. Cost: |T| log |T|.
    TetTree(std::span<const Vec3> points, std::span<const Tet> tets);

    /// The tetrahedron that holds p; of several, on a shared face, that in which p's least
    /// weight is greatest, the first of equals. Where none holds it, the nearest one, and p's
    /// weights there are extrapolated, so that they still give p back.
    [[nodiscard]] Holder find(const Vec3& p) const;

private:
    struct Cell {
        Box box;
        std::int32_t first = 0, last = 0;  // of order_, in a leaf
        std::int32_t right = -1;           // the left half follows its parent; -1: a leaf
    };
    struct Edges {
        Mat3 inverse;  // of the edges from the first corner
        std::array<Vec3, 4> corner;
    };
    std::int32_t build(std::span<const Box> boxes, std::int32_t first, std::int32_t last);
    [[nodiscard]] Weights weights(std::int32_t tet, const Vec3& p) const;
    [[nodiscard]] Holder nearest(const Vec3& p) const;

    std::vector<Edges> tets_;
    std::vector<std::int32_t> order_;
    std::vector<Cell> cells_;
};

}  // namespace myotet::cage
