// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "LevelSet/FromLabels.h"
#include "MeshFiles/NamedMesh.h"
#include "Meshing/MeshLevelSet.h"

namespace myotet::contraction {

/// A tissue of a body, as level sets of its connected pieces.
struct TissuePieces {
    std::int32_t label = 0;
    std::string name;
    std::vector<const levelset::LevelSet*> pieces;  ///< at least one; on one lattice for all
};

/// One mesh of tissues that touch, such as a muscle and its tendons: their union, its
/// largest connected piece, meshed as one; each tetrahedron is labelled by the tissue in
/// which its centroid lies deepest. Patient's frame. What is left out is added to `notes`.
/// Throws MeshError when the union cannot be meshed, and what mesh_level_set throws.
[[nodiscard]] meshfiles::NamedMesh mesh_of_tissues(const std::vector<TissuePieces>& tissues,
                                                   const Frame& frame, meshing::Options options,
                                                   std::vector<std::string>& notes,
                                                   ProgressSink& progress);

}  // namespace myotet::contraction
