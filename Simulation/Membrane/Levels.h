// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Butterfly.h"

namespace myotet::membrane {

/// A surface and its refinements, all made beforehand [Choi05, spatial
/// adaptation]. A vertex keeps its number from level to level: those of a level
/// come first in the next one, then the midpoints of its edges.
struct Levels {
    std::vector<HalfEdges> meshes;                  ///< from the given surface to the finest
    std::vector<Vec3> rest;                         ///< of the finest, mm
    std::vector<Stencil> stencils;                  ///< of vertices after the given surface's
    std::vector<std::array<std::int32_t, 2>> ends;  ///< of the edges these lie on

    [[nodiscard]] int finest() const { return static_cast<int>(meshes.size()) - 1; }
    [[nodiscard]] std::int32_t given() const { return meshes.front().vertex_count; }
    [[nodiscard]] const Stencil& stencil(std::int32_t v) const { return stencils[v - given()]; }
    [[nodiscard]] std::array<std::int32_t, 2> ends_of(std::int32_t v) const {
        return ends[v - given()];
    }
    [[nodiscard]] std::int32_t midpoint(int level, std::int32_t half_edge) const {
        return meshes[level].vertex_count + meshes[level].edge[half_edge];
    }
    /// The surface at a level, at rest.
    [[nodiscard]] TriMesh surface(int level) const;
};

/// Refines `count` times by the modified butterfly scheme. Throws InputError
/// for a surface that is no oriented manifold, has places that are not finite,
/// a triangle without area or triangles that cross, and for a count below 0 or
/// one that gives more than 2^30 triangles.
[[nodiscard]] Levels make_levels(const TriMesh& surface, int count);

}  // namespace myotet::membrane
