// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "Core/Progress.h"
#include "LevelSet/Band.h"
#include "LevelSet/WindingTree.h"

namespace myotet::levelset {

/// Winding numbers on the lattice of a band: at all samples within two spacings
/// of a triangle, and from there on wherever the number nears 1/2, so that the
/// interface in a gap is found from the gap's rim inwards. (Off the triangles
/// the winding number is harmonic: no surface of 1/2 hides elsewhere.)
struct HealGrid {
    static constexpr float kUnmeasured = std::numeric_limits<float>::max();
    /// Inside from here on: not what lies on a flat sheet, whose winding number
    /// is 1/2 but for rounding.
    static constexpr double kInside = 0.5001;

    WindingTree tree;
    std::vector<std::uint8_t> bounding;  ///< per triangle: has inside and outside on its two sides
    Band band;                           ///< geometry and blocks; no values yet
    /// Per sample, as band.values: the winding number, where measured, or one of
    /// the same side of 1/2 ...
    std::vector<float> winding;
    /// ... and the distance to the nearest triangle, mm; kUnmeasured otherwise.
    std::vector<float> away;

    /// Whole lattice coordinates of sample n of block b.
    [[nodiscard]] Index3 sample(std::size_t b, int n) const {
        constexpr int s = Band::kSide;
        const Index3& p = band.position[b];
        return {p[0] * s + n % s, p[1] * s + n / s % s, p[2] * s + n / (s * s)};
    }
    [[nodiscard]] Vec3 place(const Index3& s) const {
        return band.origin + band.spacing * Vec3(s[0], s[1], s[2]);
    }
    /// Where a sample is stored, or -1.
    [[nodiscard]] std::int64_t slot(const Index3& s) const {
        constexpr int n = Band::kSide;
        const std::int32_t b = band.find({s[0] / n, s[1] / n, s[2] / n});
        if (b < 0) return -1;
        return std::int64_t{b} * Band::kSize + (s[2] % n * n + s[1] % n) * n + s[0] % n;
    }
    /// NaN where no block is stored.
    [[nodiscard]] float winding_at(const Index3& s) const {
        const std::int64_t at = slot(s);
        return at < 0 ? std::numeric_limits<float>::quiet_NaN() : winding[at];
    }
};

/// Throws InputError when the interface leaves the box of the surface.
[[nodiscard]] HealGrid make_heal_grid(const TriMesh& surface, double spacing, double half_width,
                                      ProgressSink& progress);

}  // namespace myotet::levelset
