// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/Band.h"

namespace myotet::levelset {

/// Exact signed distances to a closed surface in a band of `half_width`
/// samples, by OpenVDB's mesh conversion. Throws Interrupted.
[[nodiscard]] Band surface_band(const TriMesh& surface, double spacing, double half_width,
                                ProgressSink& progress);

}  // namespace myotet::levelset
