// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/GiveBack.h"
#include "LevelSet/VoxelBand.h"

namespace myotet::levelset {

/// What the voxels of `owner` fill of each cell of four samples a side in the
/// region's stored blocks, exactly, mm^3: where smoothing must leave how much.
[[nodiscard]] CellVolumes voxel_volumes(const VoxelScene& scene, RegionMap::Owner owner,
                                        const RegionBand& region);

}  // namespace myotet::levelset
