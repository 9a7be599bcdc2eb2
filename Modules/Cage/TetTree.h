// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/BoxTree.h"
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

/// Finds the tetrahedron of a point in about log |T|, however sizes differ.
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
    struct Edges {
        Mat3 inverse;  // of the edges from the first corner
        std::array<Vec3, 4> corner;
    };
    [[nodiscard]] Weights weights(std::int32_t tet, const Vec3& p) const;
    [[nodiscard]] Holder nearest(const Vec3& p) const;

    std::vector<Edges> tets_;
    BoxTree tree_;
};

}  // namespace myotet::cage
