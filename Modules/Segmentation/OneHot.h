// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "Segmentation/LayerPacker.h"

namespace myotet::segmentation {

/// Turns volumes, each the mask of one label, into labels: volume n, counted
/// from 0, becomes label n + 1. Volumes may overlap.
class OneHot {
public:
    OneHot(const Index3& size, const std::filesystem::path& file)
        : packer_(size, file), file_(file) {}

    /// The next volume. Throws InputError when it holds more than 0 and one other value.
    void take(const std::vector<std::int32_t>& values);

    /// The labels in layers; a warning for volumes without a voxel.
    [[nodiscard]] std::vector<LabelVolume> finish(const Eigen::Affine3d& index_to_lps,
                                                  const std::map<std::int32_t, LabelName>& names,
                                                  std::vector<std::string>& warnings);

private:
    LayerPacker packer_;
    std::filesystem::path file_;
    std::int32_t taken_ = 0;
    std::string empty_;  // volumes without a voxel, apart by commas
};

}  // namespace myotet::segmentation
