// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "Activation/Distribution.h"
#include "Activation/MuscleMotion.h"
#include "Activation/UnitsOf.h"

namespace myotet::activation {

/// Whether tendons stretch.
enum class Tendons { as_modelled, rigid, elastic };

/// A number a muscle over time; NaN: none.
struct MuscleTable {
    std::vector<double> times;              ///< s, ascending; empty: none at all
    std::vector<std::vector<double>> rows;  ///< [time][muscle]

    /// Straight between its times and constant beyond; nothing when it is empty.
    [[nodiscard]] std::vector<double> at(double time) const;
};

struct SharingOptions {
    DistributionOptions distribution;
    Tendons tendons = Tendons::as_modelled;
    bool passive = true;          ///< whether relaxed muscles resist stretch
    bool force_velocity = true;   ///< whether the speed of fibres matters
    MuscleTable lowest, highest;  ///< bounds, within the model's own; empty: the model's
    MuscleTable measured;         ///< see Demand::measured
    /// Coordinates whose torque is left to what holds them: locked ones and those that no
    /// muscle moves are, too.
    std::vector<bool> held;
};

/// Who pulls how much over a motion.
struct Sharing {
    std::vector<Distribution> at;    ///< [time]
    std::vector<Demand> demands;     ///< [time] what was asked, tendons being rigid
    std::vector<bool> held;          ///< a coordinate: left to what holds it
    std::vector<std::string> notes;  ///< a sentence each
    /// The worst of all times; converged only when all are.
    Status status = Status::not_converged;
    std::string message;  ///< the first time that is not, and why
};

/// The muscles of a model, without their passive pull where that is left out.
[[nodiscard]] std::vector<SkeletonUnit> units_for(const skeleton::Model& model,
                                                  const SharingOptions& options);

/// What is asked of the muscles at each time, with rigid tendons.
[[nodiscard]] std::vector<Demand> demands_of(const skeleton::Model& model,
                                             std::span<const SkeletonUnit> units,
                                             const MuscleMotion& motion,
                                             const SharingOptions& options);

/// Pulls of the muscles at one of the motion's times; those of rigid tendons are in
/// proportion to activation. All arguments must outlive it.
[[nodiscard]] PullOf pulls_at(std::span<const SkeletonUnit> units, const Demand& demand,
                              const MuscleMotion& motion, std::size_t time,
                              const SharingOptions& options);

/// Static optimisation of a whole motion, each time on its own. Elastic tendons: fibres
/// are in equilibrium with them and lengthen as they would at a constant activation.
/// Throws InputError.
[[nodiscard]] Sharing share(const skeleton::Model& model, const MuscleMotion& motion,
                            const SharingOptions& options, ProgressSink& progress);

}  // namespace myotet::activation
