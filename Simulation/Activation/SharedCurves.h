// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Activation/FitCurves.h"
#include "Activation/Sharing.h"

namespace myotet::activation {

/// A load shared over a whole motion at once.
struct SharedCurves {
    FitSummary fit;
    std::vector<std::vector<double>> activations;  ///< [time][muscle]
    std::vector<std::vector<double>> forces;       ///< [time][muscle], N
    std::vector<std::vector<double>> left;  ///< [time][coordinate] that they leave, N mm or N
};

/// Instead of each time on its own, as `sharing`: activations that are cubic splines of time
/// with knots each `spacing` s and keep to the muscles' rise and fall, see fit_curves. Of
/// torques a hundredth of the largest is an error of usual size; measured activations count
/// too. Bounds are the models', none over time.
/// Throws InputError.
[[nodiscard]] SharedCurves share_by_curves(const skeleton::Model& model, const MuscleMotion& motion,
                                           const SharingOptions& options, const Sharing& sharing,
                                           double spacing);

}  // namespace myotet::activation
