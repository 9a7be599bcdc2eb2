// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/Progress.h"
#include "LevelSetStage.h"
#include "MeshReport.h"
#include "Meshing/MeshLevelSet.h"
#include "Scan.h"

namespace myotet::app {

/// A tissue's mesh in the patient's frame, and what there is to say about it.
struct TissueMesh {
    TetMesh mesh;
    TissueReport report;
};

/// What meshing made of one region.
struct RegionMesh {
    TetMesh mesh;  ///< patient's frame
    meshing::Summary summary;
    quality::SurfaceDistance distance;
    std::size_t boundary_faces = 0;
    double seconds_check = 0;
    std::string failure;  ///< why there is no mesh; empty: there is
};

/// Puts the meshes of a tissue's regions together and judges the whole; a
/// component of at least two edge lengths without mesh breaks a promise, a
/// thinner one is noted. Empties the elements of `made` that it takes.
[[nodiscard]] TissueMesh join_regions(const Tissue& tissue,
                                      const std::vector<levelset::Region>& regions,
                                      std::vector<RegionMesh>& made, double edge_length);

/// What becomes of the level sets when they were meshed.
enum class LevelSets { released, kept };

/// Meshes every region, several at a time, and puts each tissue's components
/// together; one tissue each of `tissues`, in their order, whatever the number
/// of threads. A region that cannot be meshed is reported, not thrown.
/// Throws ResourceError, Interrupted.
[[nodiscard]] std::vector<TissueMesh> mesh_tissues(levelset::LabelLevelSets& sets,
                                                   const std::vector<Tissue>& tissues,
                                                   const meshing::Options& sizes, LevelSets after,
                                                   ProgressSink& progress);

}  // namespace myotet::app
