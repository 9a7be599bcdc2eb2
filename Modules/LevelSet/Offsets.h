// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "LevelSet/Partition.h"

namespace myotet::levelset {

/// Offsets c that give each region the volume it misses, to first order: the
/// wall between a and b moves by (c_b - c_a) / 2 towards b, so that
///   missing_a = sum over b of area_ab (c_b - c_a) / 2,
/// with c = 0 for the background (number 0).
[[nodiscard]] std::vector<double> offsets_for(std::span<const double> missing,
                                              std::span<const SharedWall> walls);

}  // namespace myotet::levelset
