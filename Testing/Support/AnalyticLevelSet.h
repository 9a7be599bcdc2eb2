// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>

#include "LevelSet/LevelSet.h"

namespace myotet::support {

/// A level set whose samples are an analytic signed distance, all bricks stored.
inline levelset::LevelSet sample_level_set(const Box& box, double spacing,
                                           const std::function<double(const Vec3&)>& distance) {
    using levelset::LevelSet;
    LevelSet phi;
    phi.origin = box.min;
    phi.spacing = spacing;
    phi.band = box.diagonal();
    for (int a = 0; a < 3; ++a)
        phi.bricks[a] =
            static_cast<int>(std::ceil(box.extent()[a] / (spacing * LevelSet::kBrickCells)));
    const int count = phi.bricks[0] * phi.bricks[1] * phi.bricks[2];
    phi.coarse_spacing = 4 * spacing;
    for (int a = 0; a < 3; ++a) phi.coarse_size[a] = 2 * phi.bricks[a] + 1;
    constexpr int n = LevelSet::kBrickSamples, m = LevelSet::kBrickCells;
    for (int b = 0; b < count; ++b) {
        phi.brick_of.push_back(b);
        const int bi = b % phi.bricks[0], bj = b / phi.bricks[0] % phi.bricks[1],
                  bk = b / (phi.bricks[0] * phi.bricks[1]);
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                    phi.values.push_back(static_cast<float>(
                        distance(phi.origin + spacing * Vec3(bi * m + i, bj * m + j, bk * m + k))));
    }
    for (int k = 0; k < phi.coarse_size[2]; ++k)
        for (int j = 0; j < phi.coarse_size[1]; ++j)
            for (int i = 0; i < phi.coarse_size[0]; ++i)
                phi.coarse_values.push_back(
                    static_cast<float>(distance(phi.origin + phi.coarse_spacing * Vec3(i, j, k))));
    return phi;
}

inline Box cube(double half) {
    Box b;
    b.include(Vec3::Constant(-half));
    b.include(Vec3::Constant(half));
    return b;
}

}  // namespace myotet::support
