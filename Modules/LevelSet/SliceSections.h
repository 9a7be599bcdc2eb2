// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "LevelSet/RegionMap.h"
#include "LevelSet/SliceMap.h"

namespace myotet::levelset {

/// A connected part of a region within one slice.
struct Section {
    int slice = 0;
    std::array<int, 2> low{0, 0}, high{0, 0};  ///< pixel box, both ends inclusive
    std::int64_t area = 0;                     ///< pixels
    Point2 centre{0, 0};                       ///< mean of its pixels' indices
    /// Mean square of the first index, of the product, of the second, from the centre's.
    std::array<double, 3> spread{0, 0, 0};
    std::vector<int> above, below;  ///< sections it shares pixels with, by number
};

/// The sections of one region in the slices across `axis`.
struct SliceSections {
    int axis = 2;
    int first_slice = 0, slices = 0;
    std::array<int, 2> first{0, 0}, size{0, 0};  ///< pixels of the region's box
    std::vector<std::int32_t> number;            ///< per pixel and slice: its section, or -1
    std::vector<Section> sections;               ///< by slice, then by first pixel

    /// Section at a pixel, -1 where there is none or outside the box.
    [[nodiscard]] int at(int x, int y, int slice) const;
    /// The pixels of these sections of one slice, with `margin` empty ones around.
    [[nodiscard]] SliceMask mask_of(std::span<const int> which, int margin) const;
};

/// Axes of a slice across `axis`, as indices of the volume.
[[nodiscard]] constexpr std::array<int, 2> slice_axes(int axis) {
    return {(axis + 1) % 3, (axis + 2) % 3};
}

/// Finds the sections of `owner` (not the background) and which of them lie on
/// each other. Cost: two passes over the region's box; 4 bytes a voxel of it.
[[nodiscard]] SliceSections find_sections(const RegionMap& map, RegionMap::Owner owner, int axis);

/// Pixels that two sets of sections in neighbouring slices share when the lower
/// one is moved by `shift` pixels.
[[nodiscard]] std::int64_t shared_pixels(const SliceSections& sections, std::span<const int> lower,
                                         std::span<const int> upper, std::array<int, 2> shift);

}  // namespace myotet::levelset
