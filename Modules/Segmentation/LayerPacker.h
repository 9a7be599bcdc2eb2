// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

/// A run of voxels, 1 where they belong to a tissue and 0 elsewhere.
struct MaskRun {
    std::size_t offset = 0;  ///< of the run's first voxel in the volume, i fastest
    std::span<const std::uint8_t> mask;
};

/// Packs tissues that may overlap into layers: each goes to the first layer in
/// which all its voxels are free, so tissues that do not overlap share one.
/// Cost: a pass over each mask for each layer tried. Memory: 4 bytes a voxel
/// and layer.
class LayerPacker {
public:
    /// `most_voxels`: what all layers together may take; a ResourceError beyond.
    LayerPacker(const Index3& size, std::filesystem::path file,
                double most_voxels = std::numeric_limits<double>::infinity())
        : size_(size), file_(std::move(file)), most_voxels_(most_voxels) {}

    /// Writes `label`, which is not 0 and new, where the masks are set.
    /// Returns the number of its layer.
    std::size_t add(std::int32_t label, std::span<const MaskRun> runs);

    /// The layers, at least one, with `names` given to the layer of each label.
    [[nodiscard]] std::vector<LabelVolume> finish(const Eigen::Affine3d& index_to_lps,
                                                  const std::map<std::int32_t, LabelName>& names);

private:
    [[nodiscard]] std::vector<std::int32_t> empty_layer() const;

    Index3 size_;
    std::filesystem::path file_;
    double most_voxels_;
    std::vector<std::vector<std::int32_t>> layers_;
    std::map<std::int32_t, std::size_t> layer_of_;
};

}  // namespace myotet::segmentation
