// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet {

/// What one connected component holds.
struct ComponentBox {
    std::int64_t voxels = 0;
    Index3 min{0, 0, 0}, max{0, 0, 0};  ///< index box in the volume, both ends inclusive
};

/// The connected components of one label inside a box of voxels.
struct Components {
    Index3 origin{0, 0, 0};            ///< the box's first voxel in the volume
    Index3 size{0, 0, 0};              ///< voxels of the box along i, j, k
    std::vector<std::int32_t> number;  ///< per voxel of the box, i fastest; -1 outside the label
    std::vector<ComponentBox> components;  ///< largest first; equal ones by their first voxel
};

/// Numbers the 6-connected components of `label` inside the box [box_min,
/// box_max], both ends inclusive; what lies outside the box connects nothing.
/// Throws InputError when the box is empty or leaves the volume.
/// Cost: two passes over the box; 4 bytes a voxel of the box, and 12 a run of
/// voxels along i.
[[nodiscard]] Components label_components(const LabelVolume& volume, std::int32_t label,
                                          const Index3& box_min, const Index3& box_max);

}  // namespace myotet
