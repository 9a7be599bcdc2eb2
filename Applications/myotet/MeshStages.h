// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "LevelSetStage.h"
#include "MeshJob.h"
#include "Scan.h"
#include "TissueMesh.h"

namespace myotet::app {

/// Meshes all tissues. When a number of tetrahedra is wished for, finds the
/// edge length for it first, and leaves it in `sizes`.
[[nodiscard]] std::vector<TissueMesh> mesh_to_size(TissueSets& sets, const Scan& scan,
                                                   meshing::Options& sizes,
                                                   std::int64_t wished_tets,
                                                   ProgressSink& progress);

/// The run's part of the report, but for times and tissues.
[[nodiscard]] RunReport describe_run(const JobOptions& options, const Scan& scan,
                                     const meshing::Options& sizes, const TissueSets& sets);

}  // namespace myotet::app
