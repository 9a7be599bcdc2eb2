// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "Core/Progress.h"
#include "Skeleton/Trajectory.h"

namespace myotet::activation {

/// A skeleton in motion as its muscles see it. Coordinates and muscles are in the model's
/// order; of a coordinate that is a length, torques are forces, N, and arms pure numbers.
struct MuscleMotion {
    std::vector<double> times;                 ///< s
    std::vector<std::vector<double>> torques;  ///< [time][coordinate]: inverse dynamics, N mm
    std::vector<std::vector<double>> lengths;  ///< [time][muscle] of the whole unit, mm
    std::vector<std::vector<double>> speeds;   ///< [time][muscle] of its lengthening, mm/s
    std::vector<Eigen::MatrixXd> arms;         ///< [time] (coordinate, muscle): -dL/dq, mm
    std::vector<std::string> notes;            ///< a sentence each
};

/// Inverse dynamics, muscle lengths and moment arms at times, which ascend: paths are
/// followed from one to the next, so that none jumps over what it wraps around. `still`:
/// without speeds and accelerations, static torques. Cost: some 50 us a time for six muscles.
[[nodiscard]] MuscleMotion follow_muscles(const skeleton::Model& model,
                                          const skeleton::Trajectory& trajectory,
                                          std::span<const double> times, bool still,
                                          ProgressSink& progress);

}  // namespace myotet::activation
