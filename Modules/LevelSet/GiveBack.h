// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "LevelSet/Band.h"

namespace myotet::levelset {

/// Undoes what a flow did on the large: the interface's displacement since
/// `before` (values of the same blocks) is averaged over about `radius` mm
/// along the interface and taken back. What stays is the removal of detail
/// below that size; a sphere, a cylinder or a plane larger than it is left as
/// it was, and volume is kept where it was lost rather than anywhere.
/// Cost: O(stored samples).
void give_back(Band& band, std::span<const float> before, double radius);

/// Samples a cell of volumes takes, along an axis.
inline constexpr int kVolumeStep = 4;

/// Volume in each of a stored block's cells, mm^3, i fastest.
using CellVolumes = std::vector<std::array<float, 8>>;

/// Gives back volume itself, place by place: moves the interface so that, over
/// about `radius` mm, the region gains the volume it is `missing` (negative:
/// loses), to first order and by no more than a quarter of the spacing. Its
/// mass then stays where it was. Cost: O(stored samples).
void restore_volume(Band& band, const CellVolumes& missing, double radius);

}  // namespace myotet::levelset
