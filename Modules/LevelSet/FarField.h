// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "LevelSet/Band.h"

namespace myotet::levelset {

/// Samples a coarse lattice takes for each fine one, along an axis.
inline constexpr int kCoarseStep = 4;

/// What is known beyond the band, on the coarse lattice that covers its
/// blocks: 2 * blocks + 1 samples along each axis, i fastest.
struct FarField {
    Index3 size{0, 0, 0};
    std::vector<float> value;           ///< signed distance, mm
    std::vector<Eigen::Vector3f> foot;  ///< nearest interface point, in fine spacings from origin
};

/// Exact where the band is; elsewhere the distance to the nearest interface
/// point, found by sweeping nearest points through the lattice and sliding
/// each along the interface.
[[nodiscard]] FarField far_field(const Band& band);

}  // namespace myotet::levelset
