// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::quality {

/// How far points are from the faces between a label's voxels and others, mm: the staircase
/// that the label is in the scan, to which nothing was added. Exact where the volume's axes are
/// at right angles. Distances beyond `limit` mm are `limit`. Outside the volume is no label.
/// Cost: each point looks at the voxels within its distance; on all threads.
[[nodiscard]] std::vector<double> distance_to_label(const LabelVolume& labels, std::int32_t label,
                                                    std::span<const Vec3> points, double limit);

}  // namespace myotet::quality
