// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

/// What a label volume holds of one label.
struct LabelCount {
    std::int32_t value = 0;
    std::int64_t voxels = 0;
    Index3 min{0, 0, 0}, max{0, 0, 0};  ///< index box, both ends inclusive
    Vec3 centroid = Vec3::Zero();       ///< mean of the voxel centres, LPS, mm
};

/// Every label but 0, by value. Cost: one pass.
[[nodiscard]] std::vector<LabelCount> count_labels(const LabelVolume& volume);

/// Turns what a user asks for ("3,7,biceps") into label values, sorted. A name
/// matches without regard to case. Empty text: every label of the volume.
/// Throws InputError for a value or name that is not in the volume, with the
/// nearest names.
[[nodiscard]] std::vector<std::int32_t> choose_labels(const LabelVolume& volume,
                                                      std::span<const LabelCount> counts,
                                                      const std::string& asked);

}  // namespace myotet::segmentation
