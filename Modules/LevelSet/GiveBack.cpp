// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/GiveBack.h"

#include "Core/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kStep = 4;                // samples a coarse cell, along an axis
constexpr int kCells = kSide / kStep;   // coarse cells a block, along an axis
constexpr int kCount = kCells * kCells * kCells;
constexpr int kApron = kCells + 2;

// Displacement summed over the samples near the interface of a coarse cell,
// and their number.
struct Cell {
    float sum = 0, weight = 0;
};
using Cells = std::array<Cell, kCount>;
using Around = std::array<Cell, kApron * kApron * kApron>;

Around cells_around(const Band& band, const std::vector<Cells>& cells, std::size_t b) {
    Around out;
    const Index3 p = band.position[b];
    for (int k = 0, at = 0; k < kApron; ++k)
        for (int j = 0; j < kApron; ++j)
            for (int i = 0; i < kApron; ++i, ++at) {
                const auto side = [](int x) { return (x + kCells - 1) / kCells - 1; };
                const auto local = [](int x) { return (x + kCells - 1) % kCells; };
                const std::int32_t n = band.find({p[0] + side(i), p[1] + side(j), p[2] + side(k)});
                out[at] = n < 0 ? Cell{}
                                : cells[n][(local(k) * kCells + local(j)) * kCells + local(i)];
            }
    return out;
}

void sum_block(const Band& band, std::span<const float> before, std::size_t b, Cells& out) {
    // Samples on either side of the interface whose values are distances.
    const float near = 1.5f * static_cast<float>(band.spacing);
    for (int at = 0; at < Band::kSize; ++at) {
        const float was = before[b * Band::kSize + at];
        if (std::abs(was) > near) continue;
        Cell& cell = out[((at / 64 / kStep) * kCells + at / 8 % 8 / kStep) * kCells +
                         at % 8 / kStep];
        cell.sum += band.values[b * Band::kSize + at] - was;
        cell.weight += 1;
    }
}

// (1 2 1) / 4 along each axis.
void blur_block(const Around& in, Cells& out) {
    constexpr float w[3] = {0.25f, 0.5f, 0.25f};
    for (int k = 0; k < kCells; ++k)
        for (int j = 0; j < kCells; ++j)
            for (int i = 0; i < kCells; ++i) {
                Cell sum;
                for (int n = 0; n < 27; ++n) {
                    const float f = w[n % 3] * w[n / 3 % 3] * w[n / 9];
                    const Cell& c =
                        in[((k + n / 9) * kApron + j + n / 3 % 3) * kApron + i + n % 3];
                    sum.sum += f * c.sum;
                    sum.weight += f * c.weight;
                }
                out[(k * kCells + j) * kCells + i] = sum;
            }
}

void subtract_block(const Around& in, float width, float* values) {
    for (int at = 0; at < Band::kSize; ++at) {
        if (!(std::abs(values[at]) < width)) continue;
        // Cell centres lie at 1.5, 5.5, ... samples.
        int low[3];
        float t[3];
        const int p[3] = {at % 8, at / 8 % 8, at / 64};
        for (int a = 0; a < 3; ++a) {
            const float g = (p[a] - 0.5f * (kStep - 1)) / kStep + 1;
            low[a] = static_cast<int>(g);
            t[a] = g - float(low[a]);
        }
        float sum = 0, weight = 0;
        for (int n = 0; n < 8; ++n) {
            const int d[3] = {n & 1, n >> 1 & 1, n >> 2};
            float f = 1;
            for (int a = 0; a < 3; ++a) f *= d[a] ? t[a] : 1 - t[a];
            const Cell& c = in[((low[2] + d[2]) * kApron + low[1] + d[1]) * kApron + low[0] + d[0]];
            sum += f * c.sum;
            weight += f * c.weight;
        }
        if (weight > 0) values[at] = std::clamp(values[at] - sum / weight, -width, width);
    }
}

}  // namespace

void give_back(Band& band, std::span<const float> before, double radius) {
    const std::size_t blocks = band.position.size();
    const auto each_block = [&](auto&& body) {
        parallel_for(0, blocks, 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b) body(b);
        });
    };
    std::vector<Cells> cells(blocks), blurred(blocks);
    each_block([&](std::size_t b) { sum_block(band, before, b, cells[b]); });
    // A pass adds half a squared cell of variance; interpolation about as much.
    const double cell = kStep * band.spacing;
    const int passes = std::max(1, static_cast<int>(std::lround(2 * std::pow(radius / cell, 2))));
    for (int pass = 0; pass < passes; ++pass) {
        each_block([&](std::size_t b) { blur_block(cells_around(band, cells, b), blurred[b]); });
        cells.swap(blurred);
    }
    each_block([&](std::size_t b) {
        subtract_block(cells_around(band, cells, b), band.width,
                       band.block(static_cast<std::int32_t>(b)));
    });
}

}  // namespace myotet::levelset
