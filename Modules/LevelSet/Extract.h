// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/TetMesh.h"
#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// The zero set as triangles, outward, in the level set's own coordinates: one
/// vertex for each patch of it in a cell, one quadrilateral for each edge of
/// the lattice that crosses it (dual marching cubes, Nielson 2004), vertices
/// pulled onto the zero of the interpolant and evened out along it. Closed,
/// and manifold at every edge and vertex, whatever the samples: on a face
/// whose diagonals disagree the one from its lowest to its highest corner
/// decides. Edges are about as long as the spacing, two triangles an edge cut.
/// Empty where nothing is inside. Cost: one pass over the bricks.
[[nodiscard]] TriMesh extract_surface(const LevelSet& phi);

}  // namespace myotet::levelset
