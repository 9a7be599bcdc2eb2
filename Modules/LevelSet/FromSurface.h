// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// How a closed surface becomes a level set.
struct SurfaceOptions {
    double spacing = 0;       ///< sample distance, mm; must be positive
    double smooth = 0;        ///< how far motion by mean curvature moves a sharp edge, mm
    double max_memory = 8e9;  ///< bytes the work may hold at its peak
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Signed distance to a closed surface, in the surface's own coordinates:
/// exact in a band of four samples, to the interface's nearest point beyond
/// it. The surface may be turned inside out, touch or cross itself; what
/// cannot be reached from outside is inside. Smoothing takes away detail below
/// about three times `smooth` and keeps volume on the larger scale.
/// Throws InputError when the surface is open or has no triangles (with the
/// number of open edges and where one lies), ResourceError when the grid would
/// not fit.
[[nodiscard]] LevelSet from_surface(const TriMesh& surface, const SurfaceOptions& options,
                                    ProgressSink& progress);

}  // namespace myotet::levelset
