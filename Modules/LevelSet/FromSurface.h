// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/HealSurface.h"
#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// How a surface becomes a level set.
struct SurfaceOptions {
    double spacing = 0;       ///< sample distance, mm; must be positive
    double smooth = 0;        ///< how far motion by mean curvature moves a sharp edge, mm
    double max_memory = 8e9;  ///< bytes the work may hold at its peak
    /// Guess what an open surface encloses; without it, it is refused.
    bool heal = false;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Signed distance to a surface, in its own coordinates: exact in a band of
/// four samples, to the interface's nearest point beyond it. A closed surface
/// may be turned inside out, touch or cross itself; what cannot be reached from
/// outside is inside, and crossing triangles are a warning. Of an open surface
/// that is to be healed, inside is where its generalised winding number is at
/// least 1/2, after its triangles were turned outwards where that is sure
/// (HealSurface.h, HealBand.h). Smoothing takes away detail below about three
/// times `smooth` and keeps volume on the larger scale.
/// `summary`, if given, receives what was wrong and what was guessed.
/// Throws InputError when the surface is open and not to be healed (with the
/// number of open edges and where one lies), cannot be healed or has no
/// triangles, ResourceError when the grid would not fit.
[[nodiscard]] LevelSet from_surface(const TriMesh& surface, const SurfaceOptions& options,
                                    ProgressSink& progress, HealSummary* summary = nullptr);

}  // namespace myotet::levelset
