// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/Band.h"

namespace myotet::levelset {

/// The lattice of a band about a surface: its table, in which all is outside. `half_width`
/// is in samples.
[[nodiscard]] Band empty_band(const TriMesh& surface, double spacing, double half_width);

/// Exact signed distances to a closed surface in a band of `half_width` samples, at
/// least 1. Outside is what can be reached from afar without cutting the surface, which
/// may be turned inside out or cross itself.
/// Cost: O(samples of the band x triangles next to their block). Throws Interrupted.
[[nodiscard]] Band surface_band(const TriMesh& surface, double spacing, double half_width,
                                ProgressSink& progress);

}  // namespace myotet::levelset
