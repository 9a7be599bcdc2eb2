// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cage/SurfaceTree.h"
#include "Core/Progress.h"

namespace myotet::cage {

/// How the lattice lies in space.
struct Placement {
    Mat3 rotation = Mat3::Identity();  ///< from the lattice's axes to the surface's
    Vec3 shift = Vec3::Zero();         ///< along the lattice's axes, in cells
};

/// The lattice over a surface's box, and which of its tetrahedra make the mesh.
struct Sculpture {
    std::vector<Vec3> points;        ///< mm
    std::vector<Tet> tets;           ///< positive
    std::vector<Tet> neighbours;     ///< behind the face opposite each node, or -1
    std::vector<std::uint8_t> kept;  ///< a tetrahedron
    [[nodiscard]] std::size_t count() const;
};

/// Keeps the tetrahedra that the solid inside the closed surface has a point in common with:
/// the surface meets them, or they lie within it [Stuart13, sec. 3.1-3.2]. The first is
/// decided exactly for each; what the surface does not meet falls into parts connected by
/// faces, each of which is inside or outside as a whole, decided exactly for one node.
/// There are tetrahedra all around those kept, two thick at least.
/// Throws InputError when the cell (mm) is not positive, ResourceError where the lattice does.
/// Cost: |T| log |F| for a lattice of |T| tetrahedra.
[[nodiscard]] Sculpture sculpt(const SurfaceTree& surface, double cell, const Placement& placement);

}  // namespace myotet::cage
