// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::levelset {

/// One 6-connected component of one label, as voxels.
struct VoxelRegion {
    std::int32_t label = 0;
    int component = 0;  ///< 0 is the label's largest
    std::int64_t voxels = 0;
    Index3 min{0, 0, 0}, max{0, 0, 0};  ///< index box, both ends inclusive
};

/// Which region owns each voxel. Owner 0 is the background: everything that
/// was not asked for, and all that lies outside the volume.
struct RegionMap {
    using Owner = std::uint16_t;
    static constexpr std::uint8_t kCore = 1;  ///< all 27 voxels around have the same owner
    static constexpr std::uint8_t kThin = 2;  ///< belongs to a sheet, tube, speck or neck

    Index3 size{0, 0, 0};
    std::vector<Owner> owner;          ///< per voxel, i fastest
    std::vector<std::uint8_t> flags;   ///< per voxel
    std::vector<VoxelRegion> regions;  ///< of owner r: regions[r - 1]; by label, then component

    [[nodiscard]] bool holds(int i, int j, int k) const {
        return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
    }
    [[nodiscard]] std::size_t offset(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * size[1] + j) * size[0] + i;
    }
    [[nodiscard]] Owner owner_at(int i, int j, int k) const {
        return holds(i, j, k) ? owner[offset(i, j, k)] : Owner{0};
    }
};

/// Finds the components of the asked labels and marks what is thin: voxels
/// that no block of 3 x 3 x 3 voxels of their owner covers, in parts that
/// reach at least three voxels away from what such blocks cover, or that join
/// two parts of it. Bumps and the rims of steps are not thin in this sense; they are what smoothing
/// is for. The background is judged like any other owner. Throws InputError when a label is 0 or
/// not in the volume, ResourceError when there are more components than owners can be numbered.
[[nodiscard]] RegionMap map_regions(const LabelVolume& volume,
                                    std::span<const std::int32_t> labels);

}  // namespace myotet::levelset
