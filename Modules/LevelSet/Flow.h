// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/Band.h"

#include <cstdint>
#include <span>

namespace myotet::levelset {

/// Bounds that a flow must respect; see RegionBand.
struct Locks {
    std::span<const std::int8_t> of_sample;  ///< per stored sample, or empty
    double unit = 0;                         ///< mm
};

/// Motion by mean curvature, phi_t = b kappa |grad phi| with kappa = k1 + k2
/// (a sphere's radius obeys R^2 = R0^2 - 4 b t), for b t = `time` mm^2, with
/// redistancing every few explicit steps [Teran05, sec. 5]. The stored blocks
/// stay, so that the interface may move by no more than the band's margin.
/// Returns how many samples a lock due to a thin part has stopped.
/// Cost: O(stored samples * time / spacing^2).
std::int64_t flow_by_mean_curvature(Band& band, double time, const Locks& locks,
                                    double give_back_radius = 0);

/// The flow time after which the edge of a right angle has moved by `distance`
/// mm, on its own.
[[nodiscard]] double flow_time(double distance);

}  // namespace myotet::levelset
