// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "LevelSet/RegionMap.h"

namespace myotet::levelset {

/// Marks as thin the necks that hold a region together: where the voxels
/// covered by blocks of 3 x 3 x 3 (`covered`) fall into several parts, the
/// shortest ways between them through the region's other voxels, and the
/// region's uncovered voxels around these ways.
/// Cost: a few passes over each region's box.
void mark_necks(RegionMap& map, const std::vector<std::uint8_t>& covered);

}  // namespace myotet::levelset
