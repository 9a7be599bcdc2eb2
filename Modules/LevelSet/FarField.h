// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/Band.h"

#include <vector>

namespace myotet::levelset {

/// Samples a coarse lattice takes for each fine one, along an axis.
inline constexpr int kCoarseStep = 4;

/// Signed distances on the coarse lattice that covers the band's blocks:
/// 2 * blocks + 1 samples along each axis, i fastest, mm. Exact where the band
/// is; elsewhere the distance to the nearest interface point found by sweeping
/// nearest points through the lattice and sliding each along the interface.
[[nodiscard]] std::vector<float> far_field(const Band& band);

}  // namespace myotet::levelset
