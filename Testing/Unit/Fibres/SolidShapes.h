// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FibreShapes.h"
#include "Fibres/BSplineSolid.h"

namespace myotet::fibres::test {

/// A block of 20 x 30 x 100 mm, bent and widened, its control points moved at random by
/// less than would fold it.
inline BSplineSolid some_solid(const SolidShape& shape, unsigned seed = 5) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> by(-0.8, 0.8);
    BSplineSolid solid{shape, {}};
    const auto g = [&](int a, int i) { return greville(shape.degree[a], shape.count[a], i); };
    for (int k = 0; k < shape.count[2]; ++k)
        for (int j = 0; j < shape.count[1]; ++j)
            for (int i = 0; i < shape.count[0]; ++i) {
                const double u = g(0, i), v = g(1, j), w = g(2, k);
                const double wide = 1 + 0.8 * w * (1 - w);
                solid.control.push_back(
                    Vec3(20 * wide * (u - 0.5) + 25 * w * w, 30 * wide * (v - 0.5), 100 * w) +
                    Vec3(by(random), by(random), by(random)));
            }
    return solid;
}

inline std::vector<SolidShape> some_shapes() {
    return {{{1, 1, 1}, {2, 3, 5}},
            {{2, 2, 2}, {4, 5, 6}},
            {{3, 3, 3}, {5, 5, 8}},
            {{1, 2, 3}, {3, 4, 6}}};
}

}  // namespace myotet::fibres::test
