// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/LayerPacker.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

// Tissues overlap two or three deep; a file that asks for more than this lies.
constexpr std::size_t kMostLayers = 256;

bool is_free(const std::vector<std::int32_t>& layer, const MaskRun& run) {
    for (std::size_t n = 0; n < run.mask.size(); ++n)
        if (run.mask[n] != 0 && layer[run.offset + n] != 0) return false;
    return true;
}

}  // namespace

std::vector<std::int32_t> LayerPacker::empty_layer() const {
    const double voxels = static_cast<double>(size_[0]) * size_[1] * size_[2];
    const auto layers = static_cast<double>(layers_.size() + 1);
    const auto too_many = [&](const char* why) {
        return ResourceError(file_.string() + ": its labels take " +
                             std::to_string(layers_.size() + 1) + " layers of " +
                             std::to_string(size_[0]) + " x " + std::to_string(size_[1]) + " x " +
                             std::to_string(size_[2]) + " voxels, " + why +
                             "; crop the segmentation or leave labels out");
    };
    if (layers_.size() == kMostLayers) throw too_many("more than overlap anywhere");
    if (!(voxels * layers <= most_voxels_)) throw too_many("more than a file of its size can tell");
    try {
        return std::vector<std::int32_t>(static_cast<std::size_t>(voxels), 0);
    } catch (const std::bad_alloc&) {
        throw too_many("more than fits in memory");
    } catch (const std::length_error&) {
        throw too_many("more than a program can hold");
    }
}

std::size_t LayerPacker::add(std::int32_t label, std::span<const MaskRun> runs) {
    const auto fits = [&](const std::vector<std::int32_t>& layer) {
        return std::all_of(runs.begin(), runs.end(),
                           [&](const MaskRun& run) { return is_free(layer, run); });
    };
    auto layer = std::find_if(layers_.begin(), layers_.end(), fits);
    if (layer == layers_.end()) layer = layers_.insert(layer, empty_layer());
    for (const MaskRun& run : runs)
        for (std::size_t n = 0; n < run.mask.size(); ++n)
            if (run.mask[n] != 0) (*layer)[run.offset + n] = label;
    return layer_of_[label] = static_cast<std::size_t>(layer - layers_.begin());
}

std::vector<LabelVolume> LayerPacker::finish(const Eigen::Affine3d& index_to_lps,
                                             const std::map<std::int32_t, LabelName>& names) {
    if (layers_.empty()) (void)add(1, {});
    std::vector<LabelVolume> volumes(layers_.size());
    for (std::size_t n = 0; n < layers_.size(); ++n) {
        volumes[n].size = size_;
        volumes[n].index_to_lps = index_to_lps;
        volumes[n].values = std::move(layers_[n]);
    }
    for (const auto& [label, name] : names) {
        const auto at = layer_of_.find(label);
        volumes[at == layer_of_.end() ? 0 : at->second].names.emplace(label, name);
    }
    return volumes;
}

}  // namespace myotet::segmentation
