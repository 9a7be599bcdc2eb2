// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "Core/Progress.h"
#include "LevelSet/Band.h"

namespace myotet::levelset {

/// Bounds that a flow must respect; see RegionBand. One a stored sample, kept
/// in step when blocks are laid anew; empty: none.
struct Locks {
    std::vector<std::int8_t>& of_sample;
    double unit = 0;  ///< mm
};

/// What a flow is to do.
struct FlowOptions {
    double time = 0;  ///< b t, mm^2
    /// Scale on which displacement is given back, mm; see give_back. 0: volume
    /// is lost as the flow has it.
    double give_back_radius = 0;
    /// True when nothing keeps the interface near where it was: blocks are then
    /// laid anew as it moves.
    bool wanders = false;
};

/// Lets each locked sample have no value that its lock forbids.
void apply_locks(Band& band, const Locks& locks);

/// Motion by mean curvature, phi_t = b kappa |grad phi| with kappa = k1 + k2
/// (a sphere's radius obeys R^2 = R0^2 - 4 b t), with redistancing every few
/// explicit steps [Teran05, sec. 5]. Returns how many times a lock due to a
/// thin part has stopped a sample. Throws Interrupted.
/// Cost: O(stored samples * time / spacing^2).
std::int64_t flow_by_mean_curvature(Band& band, const Locks& locks, const FlowOptions& options,
                                    const ProgressSink& progress);

/// The flow time (mm^2) after which the edge of a right angle has moved by
/// `distance` mm, on its own.
[[nodiscard]] double flow_time(double distance);

}  // namespace myotet::levelset
