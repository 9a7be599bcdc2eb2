// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/Progress.h"
#include "LevelSet/VoxelBand.h"

namespace myotet::levelset {

/// Brings every voxel's centre back to the side that its label says (Whitaker
/// 2000), by the least change of the samples around it (Kaczmarz's method):
/// at the centre of each voxel of r, the interpolants shall obey f_r < f_q for
/// each other region q, which is what the partition decides by. Samples must
/// lie no farther apart than voxels, or this asks for the impossible. Locks are
/// not looked at. Returns how many voxels are still on the wrong side: none
/// but where the bands of two regions do not reach. Throws Interrupted.
/// Cost: a pass or a few over the voxels beside walls.
std::int64_t hold_voxels(std::vector<RegionBand>& regions, const RegionMap& map,
                         const SharedLattice& lattice, const ProgressSink& progress);

}  // namespace myotet::levelset
