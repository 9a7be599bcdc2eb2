// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "LevelSet/Band.h"

namespace myotet::test {

using Field = std::function<double(const Vec3&)>;

/// A band of `width` samples of any field whose zero set is the interface, in
/// a cube from the origin of `blocks` blocks a side.
inline levelset::Band make_band(const Field& phi, int blocks, double spacing, double width = 3) {
    levelset::Band band;
    band.spacing = spacing;
    band.width = static_cast<float>(width * spacing);
    band.blocks = {blocks, blocks, blocks};
    band.block_of.assign(static_cast<std::size_t>(blocks) * blocks * blocks,
                         levelset::Band::kOutside);
    for (int k = 0; k < blocks; ++k)
        for (int j = 0; j < blocks; ++j)
            for (int i = 0; i < blocks; ++i) {
                std::array<float, levelset::Band::kSize> values;
                bool near = false;
                for (int at = 0; at < levelset::Band::kSize; ++at) {
                    const Vec3 p(8 * i + at % 8, 8 * j + at / 8 % 8, 8 * k + at / 64);
                    const double v = phi(spacing * p);
                    near = near || std::abs(v) < 1.5 * band.width;
                    values[at] = std::clamp(static_cast<float>(v), -band.width, band.width);
                }
                if (!near) continue;
                band.block_of[band.slot({i, j, k})] =
                    static_cast<std::int32_t>(band.position.size());
                band.position.push_back({i, j, k});
                band.values.insert(band.values.end(), values.begin(), values.end());
            }
    levelset::mark_unstored_blocks(band);
    return band;
}

inline Field sphere_field(const Vec3& centre, double radius) {
    return [=](const Vec3& p) { return (p - centre).norm() - radius; };
}

/// Distance along `direction` from `from` to where the band changes sign.
inline double distance_to_zero(const levelset::Band& band, const Vec3& from, const Vec3& direction,
                               double longest) {
    double low = 0, high = longest;
    const bool inside = levelset::sample(band, from).value < 0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        const bool same = (levelset::sample(band, from + middle * direction).value < 0) == inside;
        (same ? low : high) = middle;
    }
    return low;
}

}  // namespace myotet::test
