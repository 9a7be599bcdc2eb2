// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "Repair/YamlTree.h"
#include "Skeleton/Table.h"
#include "Skeleton/Trajectory.h"

namespace myotet::contraction {

/// Whether a motion's file holds key frames, .yaml, rather than rows of numbers.
[[nodiscard]] bool is_key_frames(const std::filesystem::path& file);

/// Postures at times, from a file:
///
///     myotet_motion: 1
///     keys:
///       - {time: 0, elbow_flexion: 10, shoulder_flexion: 0}
///       - {time: 1, elbow_flexion: 90}
///
/// Angles in degrees, lengths in m, as in .mot. A coordinate that the first key alone names
/// is held; another one stands in each. Throws IoError, InputError "file:line: ...".
[[nodiscard]] skeleton::Table read_key_frames(const std::filesystem::path& file);

/// The same from the list of keys in another file.
[[nodiscard]] skeleton::Table read_key_frames(const repair::YamlTree& keys,
                                              const std::filesystem::path& file);

/// The rows of a motion of any kind, and how they become one: key frames begin and end at
/// rest, others go on by splines of degree 5, or 3 where there are two rows.
struct MotionRows {
    skeleton::Table table;
    skeleton::TrajectoryOptions smooth;
};
[[nodiscard]] MotionRows read_motion_rows(const std::filesystem::path& file);

/// skeleton::make_trajectory, its refusals with the file in front.
[[nodiscard]] skeleton::Trajectory trajectory_of(const MotionRows& rows,
                                                 const skeleton::Model& model,
                                                 const std::filesystem::path& file);

}  // namespace myotet::contraction
