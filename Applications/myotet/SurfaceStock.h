// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "SurfaceJob.h"
#include "TrimSolid.h"

namespace myotet::app {

/// All that surfaces are made from, whatever the input was.
struct SurfaceStock {
    Scan scan;
    TissueSets sets;
    std::vector<TriMesh> starts;  ///< one a region, to begin with
    double edge_length = 0;       ///< mm
    std::optional<TrimSolid> trim;
};

// Samples along a mesh's edge for its level set, and along an edge of the
// result for a trimming solid's.
inline constexpr double kSamplesAlongEdge = 3;

/// Reads labels or a closed surface, as `myotet mesh` does; a tetrahedral mesh,
/// of which each label is a tissue; or level sets (.vdb). Throws UsageError for
/// options that mean nothing for the input's kind, InputError, IoError.
[[nodiscard]] SurfaceStock take_stock(const SurfaceJobOptions& options, ProgressSink& progress);

}  // namespace myotet::app
