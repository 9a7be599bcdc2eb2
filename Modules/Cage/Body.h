// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cage/Sculpt.h"

namespace myotet::cage {

/// A cage while its nodes move: the mesh and what is around each node.
struct Body {
    std::vector<Vec3> points;                     ///< mm
    std::vector<Tet> tets;                        ///< positive
    std::vector<std::vector<std::int32_t>> star;  ///< a node: its tetrahedra
    std::vector<Triangle> faces;                  ///< of the boundary, outward
    std::vector<std::vector<std::int32_t>> fan;   ///< a node: its boundary faces; none inside

    [[nodiscard]] bool on_boundary(std::int32_t node) const { return !fan[node].empty(); }
    [[nodiscard]] Corners4 corners(std::size_t tet) const {
        const Tet& t = tets[tet];
        return {points[t[0]], points[t[1]], points[t[2]], points[t[3]]};
    }
    [[nodiscard]] TetMesh mesh() const { return {points, tets, {}}; }
};

/// Makes star, faces and fan from points and tetrahedra; nodes of no tetrahedron go.
void connect(Body& body);

/// The kept tetrahedra. Where parts of them meet in a node without a common face there, each
/// gets a node of its own, so that they can part; `split` counts the nodes added.
[[nodiscard]] Body body_of(const Sculpture& sculpture, std::int64_t& split);

}  // namespace myotet::cage
