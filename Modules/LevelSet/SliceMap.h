// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace myotet::levelset {

/// A point of a slice in pixel indices, or a length along its two axes.
using Point2 = std::array<double, 2>;

/// Pixels of a slice that belong to something.
struct SliceMask {
    std::array<int, 2> first{0, 0}, size{0, 0};  ///< index of the first pixel; pixels
    std::vector<std::uint8_t> inside;            ///< per pixel, first axis fastest

    [[nodiscard]] std::size_t offset(int x, int y) const {
        return static_cast<std::size_t>(y - first[1]) * size[0] + (x - first[0]);
    }
};

/// Signed distances within one slice, at the pixels' centres: mm, negative inside.
struct SliceMap {
    std::array<int, 2> first{0, 0}, size{0, 0};
    Point2 spacing{1, 1};  ///< mm
    std::vector<float> phi;
    double depth = 0;  ///< largest -phi, mm

    /// Linear interpolation; outside the map the value at its nearest point and
    /// the distance to that.
    [[nodiscard]] double value(const Point2& p) const;
};

/// Distances to the walls of the pixels of `mask`, whose outermost pixels are
/// outside. The staircase is evened out as far as each pixel's centre
/// keeps its side; parts up to two pixels thin stay as they are.
/// Source: Felzenszwalb and Huttenlocher (2012), Distance transforms of sampled
/// functions, Theory of Computing 8, for the nearest pixel.
/// Cost: O(pixels of the mask).
[[nodiscard]] SliceMap slice_distances(const SliceMask& mask, const Point2& spacing);

}  // namespace myotet::levelset
