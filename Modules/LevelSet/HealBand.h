// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/Band.h"
#include "LevelSet/HealSurface.h"

namespace myotet::levelset {

/// Signed distances to the solid that an open surface means, in a band of
/// `half_width` samples: inside is where the generalised winding number is at
/// least 1/2. Next to the interface they are distances to the triangles that
/// bound the solid, and in gaps to the surface on which the winding number is
/// 1/2; farther away their signs are right. The surface is to be oriented
/// (orient_surface). Fills in what was guessed. The same bytes for any thread
/// count.
/// Throws InputError when nothing is inside, or the guess leaves the surface's
/// own box; Interrupted.
/// Cost: O(log n) for each sample within two spacings of a triangle or next to
/// the interface.
[[nodiscard]] Band healed_band(const TriMesh& oriented, double spacing, double half_width,
                               HealSummary& summary, ProgressSink& progress);

}  // namespace myotet::levelset
