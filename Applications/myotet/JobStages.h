// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "LevelSet/FromLabels.h"
#include "MeshJob.h"
#include "Outputs.h"
#include "Scan.h"
#include "TissueMesh.h"

namespace myotet::app {

/// One level set a component of each tissue; a surface is one region in its
/// own coordinates, which are the patient's.
[[nodiscard]] levelset::LabelLevelSets make_level_sets(const Scan& scan,
                                                       const meshing::Options& sizes,
                                                       const JobOptions& options,
                                                       ProgressSink& progress);

/// Meshes all tissues. When a number of tetrahedra is wished for, finds the
/// edge length for it first, and leaves it in `sizes`.
[[nodiscard]] std::vector<TissueMesh> mesh_to_size(levelset::LabelLevelSets& sets, const Scan& scan,
                                                   meshing::Options& sizes,
                                                   std::int64_t wished_tets,
                                                   ProgressSink& progress);

/// Writes the tissue's tetrahedra and surface and notes the files' names.
void write_tissue(TissueMesh& tissue, OutputFolder& out);

/// The run's part of the report, but for times and tissues.
[[nodiscard]] RunReport describe_run(const JobOptions& options, const Scan& scan,
                                     const meshing::Options& sizes,
                                     const levelset::LabelLevelSets& sets);

}  // namespace myotet::app
