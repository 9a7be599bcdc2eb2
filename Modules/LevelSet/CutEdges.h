// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "Core/Geometry.h"

namespace myotet::levelset {

/// Corners of a triangle on a lattice so fine that everything below is exact.
struct SnappedTriangle {
    /// Steps of the fine lattice between two samples.
    static constexpr std::int64_t kFine = std::int64_t{1} << 14;
    /// Coordinates in samples must be at least 0 and below this.
    static constexpr double kMost = 65536;

    std::array<std::array<std::int64_t, 3>, 3> corners;
};

/// The nearest one to corners given in samples.
[[nodiscard]] SnappedTriangle snap(const std::array<Vec3, 3>& corners);

/// Which edges between neighbouring samples a triangle cuts: calls take(axis, low)
/// for each, `low` being the lower of its two samples, where low lies within the
/// box of samples from `first` to `last`, both included.
///
/// Exact, in whole numbers. What would lie on a sample or an edge is moved by an
/// infinitesimal (ex, ey, ez), ex >> ey >> ez > 0, the same for all triangles
/// (simulation of simplicity, Edelsbrunner and Muecke 1990): so every way from one
/// side of a closed surface to the other has a cut edge.
void for_each_cut_edge(const SnappedTriangle& triangle, const Index3& first, const Index3& last,
                       const std::function<void(int axis, const Index3& low)>& take);

}  // namespace myotet::levelset
