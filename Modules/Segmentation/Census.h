// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

/// What a label volume holds of one label.
struct LabelCount {
    int layer = 0;
    std::int32_t value = 0;
    std::int64_t voxels = 0;
    Index3 min{0, 0, 0}, max{0, 0, 0};  ///< index box, both ends inclusive
    Vec3 centroid = Vec3::Zero();       ///< mean of the voxel centres, LPS, mm
};

/// Every label but 0, by value. Cost: one pass.
[[nodiscard]] std::vector<LabelCount> count_labels(const LabelVolume& volume);

/// The same for every layer of a file, by layer, then by value.
[[nodiscard]] std::vector<LabelCount> count_labels(std::span<const LabelVolume> layers);

/// Those of `counts` that a user asks for ("3,7,biceps,1:4"), in their order. A
/// value stands for that label in every layer that has it, layer:value for one
/// of them; a name matches without regard to case. Empty text: all.
/// Throws InputError for a value or name that is not in the volume, with the
/// nearest names.
[[nodiscard]] std::vector<LabelCount> choose_labels(std::span<const LabelVolume> layers,
                                                    std::span<const LabelCount> counts,
                                                    const std::string& asked);

}  // namespace myotet::segmentation
