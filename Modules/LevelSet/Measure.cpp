// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Measure.h"

#include <algorithm>
#include <cmath>

#include "Core/Parallel.h"
#include "LevelSet/Seams.h"

namespace myotet::levelset {
namespace {

// Fraction of a tetrahedron where the linear function with these values at its
// corners is negative.
double negative_part(double a, double b, double c, double d) {
    const auto order = [](double& low, double& high) {
        const double smaller = std::min(low, high);
        high = std::max(low, high);
        low = smaller;
    };
    order(a, b);
    order(c, d);
    order(a, c);
    order(b, d);
    order(b, c);
    if (!(a < 0)) return 0;
    if (d < 0) return 1;
    if (!(b < 0)) return a * a * a / ((a - b) * (a - c) * (a - d));
    if (c < 0) return 1 - d * d * d / ((d - a) * (d - b) * (d - c));
    // Two in, two out: a prism, cut into three tetrahedra by the points where
    // the edges ac, ad, bc, bd cross zero, at these fractions from a or b.
    const double ac = a / (a - c), ad = a / (a - d), bc = b / (b - c), bd = b / (b - d);
    return bc * bd + ac * ad * (1 - bd) + ac * bd * (1 - bc);
}

}  // namespace

double inside_fraction(const std::array<float, 8>& corner) {
    const int negative = static_cast<int>(
        std::count_if(corner.begin(), corner.end(), [](float v) { return v < 0; }));
    if (negative == 0) return 0;
    if (negative == 8) return 1;
    // Paths 0 -> x -> y -> 7 over the six orders of the axes.
    constexpr int paths[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
    double sum = 0;
    for (const auto& p : paths)
        sum += negative_part(corner[0], corner[p[0]], corner[p[1]], corner[7]);
    return sum / 6;
}

double enclosed_volume(const LevelSet& phi) {
    constexpr int n = LevelSet::kBrickSamples, cells = LevelSet::kBrickCells;
    const double count =
        parallel_sum(0, phi.brick_of.size(), 64, [&](std::size_t first, std::size_t last) {
            double sum = 0;
            for (std::size_t s = first; s < last; ++s) {
                const std::int32_t number = phi.brick_of[s];
                if (number < 0) {
                    const std::size_t i = s % phi.bricks[0], j = s / phi.bricks[0] % phi.bricks[1],
                                      k = s / phi.bricks[0] / phi.bricks[1];
                    const std::size_t at =
                        ((2 * k + 1) * phi.coarse_size[1] + 2 * j + 1) * phi.coarse_size[0] +
                        2 * i + 1;
                    if (phi.coarse_values[at] < 0) sum += cells * cells * cells;
                    continue;
                }
                const float* v =
                    phi.values.data() + static_cast<std::size_t>(number) * LevelSet::kBrickSize;
                for (int k = 0; k < cells; ++k)
                    for (int j = 0; j < cells; ++j)
                        for (int i = 0; i < cells; ++i) {
                            if (const auto pieces = phi.pieces_at(number, i, j, k);
                                !pieces.empty()) {
                                sum += inside_fraction(pieces);
                                continue;
                            }
                            const float* p = v + (k * n + j) * n + i;
                            sum += inside_fraction({p[0], p[1], p[n], p[n + 1], p[n * n],
                                                    p[n * n + 1], p[n * n + n], p[n * n + n + 1]});
                        }
            }
            return sum;
        });
    return count * std::pow(phi.spacing, 3);
}

double inscribed_radius(const LevelSet& phi) {
    double deepest = 0;
    for (const float v : phi.values) deepest = std::max(deepest, -double(v));
    for (const float v : phi.coarse_values) deepest = std::max(deepest, -double(v));
    return deepest;
}

}  // namespace myotet::levelset
