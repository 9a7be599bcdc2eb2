// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Band.h"

#include <algorithm>

namespace myotet::levelset {
namespace {

float value_at(const Band& band, const Index3& p) {
    constexpr int n = Band::kSide;
    const std::int32_t number = band.block_of[band.slot({p[0] / n, p[1] / n, p[2] / n})];
    return number >= 0 ? band.block(number)[((p[2] % n) * n + p[1] % n) * n + p[0] % n]
                       : band.empty_value(number);
}

}  // namespace

void gather(const Band& band, const Index3& b, int low, int high, float* out) {
    gather(
        band, band.values.data(), b, low, high,
        [&](std::int32_t number) { return band.empty_value(number); }, out);
}

void mark_unstored_blocks(Band& band) {
    // Along a row of blocks the sign can change only inside stored ones.
    constexpr int last = Band::kSide - 1;
    std::size_t slot = 0;
    for (int k = 0; k < band.blocks[2]; ++k)
        for (int j = 0; j < band.blocks[1]; ++j) {
            std::int32_t now = band.beyond;
            for (int i = 0; i < band.blocks[0]; ++i, ++slot) {
                std::int32_t& number = band.block_of[slot];
                if (number >= 0)
                    now = band.block(number)[last] < 0 ? Band::kInside : Band::kOutside;
                else
                    number = now;
            }
        }
}

Sample sample(const Band& band, const Vec3& point) {
    constexpr int n = Band::kSide;
    const Vec3 g = (point - band.origin) / band.spacing;
    Index3 cell;
    Vec3 t;
    for (int a = 0; a < 3; ++a) {
        cell[a] = std::clamp(static_cast<int>(g[a]), 0, band.blocks[a] * n - 2);
        t[a] = std::clamp(g[a] - cell[a], 0.0, 1.0);
    }
    double v[2][2][2];
    const int i = cell[0] % n, j = cell[1] % n, k = cell[2] % n;
    const std::int32_t home = band.block_of[band.slot({cell[0] / n, cell[1] / n, cell[2] / n})];
    if (home >= 0 && i < n - 1 && j < n - 1 && k < n - 1) {
        const float* from = band.block(home) + (k * n + j) * n + i;
        for (int c = 0; c < 2; ++c)
            for (int b = 0; b < 2; ++b)
                for (int a = 0; a < 2; ++a) v[c][b][a] = from[(c * n + b) * n + a];
    } else {
        for (int c = 0; c < 2; ++c)
            for (int b = 0; b < 2; ++b)
                for (int a = 0; a < 2; ++a)
                    v[c][b][a] = value_at(band, {cell[0] + a, cell[1] + b, cell[2] + c});
    }
    double e[2][2], ex[2][2];  // interpolated along x, and its slope
    for (int c = 0; c < 2; ++c)
        for (int b = 0; b < 2; ++b) {
            ex[c][b] = v[c][b][1] - v[c][b][0];
            e[c][b] = v[c][b][0] + t.x() * ex[c][b];
        }
    const double e0 = e[0][0] + t.y() * (e[0][1] - e[0][0]);
    const double e1 = e[1][0] + t.y() * (e[1][1] - e[1][0]);
    const double x0 = ex[0][0] + t.y() * (ex[0][1] - ex[0][0]);
    const double x1 = ex[1][0] + t.y() * (ex[1][1] - ex[1][0]);
    const double y0 = e[0][1] - e[0][0], y1 = e[1][1] - e[1][0];
    return {e0 + t.z() * (e1 - e0),
            Vec3(x0 + t.z() * (x1 - x0), y0 + t.z() * (y1 - y0), e1 - e0) / band.spacing};
}

}  // namespace myotet::levelset
