// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/GiveBack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "Core/Parallel.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kStep = kVolumeStep;     // samples a coarse cell, along an axis
constexpr int kCells = kSide / kStep;  // coarse cells a block, along an axis
constexpr int kCount = kCells * kCells * kCells;
constexpr int kApron = kCells + 2;

// Displacement summed over the samples near the interface of a coarse cell,
// and their number.
struct Cell {
    float sum = 0, weight = 0;
};
using Cells = std::array<Cell, kCount>;
using Around = std::array<Cell, kApron * kApron * kApron>;

// The 27 blocks around each stored one.
using Neighbours = std::array<std::int32_t, 27>;

Neighbours neighbours_of(const Band& band, std::size_t b) {
    const Index3 p = band.position[b];
    Neighbours out;
    for (int n = 0; n < 27; ++n)
        out[n] = band.find({p[0] + n % 3 - 1, p[1] + n / 3 % 3 - 1, p[2] + n / 9 - 1});
    return out;
}

Around cells_around(const Neighbours& neighbours, const std::vector<Cells>& cells) {
    Around out;
    const auto side = [](int x) { return (x + kCells - 1) / kCells; };
    const auto local = [](int x) { return (x + kCells - 1) % kCells; };
    for (int k = 0, at = 0; k < kApron; ++k)
        for (int j = 0; j < kApron; ++j)
            for (int i = 0; i < kApron; ++i, ++at) {
                const std::int32_t n = neighbours[(side(k) * 3 + side(j)) * 3 + side(i)];
                out[at] =
                    n < 0 ? Cell{} : cells[n][(local(k) * kCells + local(j)) * kCells + local(i)];
            }
    return out;
}

// What a sample adds to, by its place in the block.
Cell& cell_of(Cells& cells, int at) {
    return cells[((at / 64 / kStep) * kCells + at / 8 % 8 / kStep) * kCells + at % 8 / kStep];
}

// Samples on either side of the interface whose values are distances: three
// deep, so that a third of their number is the area in squared spacings.
bool near(float phi, double spacing) { return std::abs(phi) <= 1.5f * static_cast<float>(spacing); }

void sum_displacement(const Band& band, std::span<const float> before, std::size_t b, Cells& out) {
    for (int at = 0; at < Band::kSize; ++at) {
        const float was = before[b * Band::kSize + at];
        if (!near(was, band.spacing)) continue;
        Cell& cell = cell_of(out, at);
        cell.sum += band.values[b * Band::kSize + at] - was;
        cell.weight += 1;
    }
}

void sum_volume(const Band& band, const CellVolumes& missing, std::size_t b, Cells& out) {
    // Displacement times area in squared spacings is volume over squared
    // spacing; phi falls where volume is missing.
    const auto scale = static_cast<float>(1 / (band.spacing * band.spacing));
    for (int c = 0; c < kCount; ++c) out[c].sum = missing[b][c] * scale;
    for (int at = 0; at < Band::kSize; ++at)
        if (near(band.values[b * Band::kSize + at], band.spacing))
            cell_of(out, at).weight += 1.0f / 3;
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
                    const Cell& c = in[((k + n / 9) * kApron + j + n / 3 % 3) * kApron + i + n % 3];
                    sum.sum += f * c.sum;
                    sum.weight += f * c.weight;
                }
                out[(k * kCells + j) * kCells + i] = sum;
            }
}

void subtract_block(const Around& in, float width, float most, float* values) {
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
        if (!(weight > 0)) continue;
        const float change = std::clamp(sum / weight, -most, most);
        values[at] = std::clamp(values[at] - change, -width, width);
    }
}

// Sums over cells, blurred over about `radius`, taken from the samples.
template <class Sum>
void spread(Band& band, double radius, double most, Sum&& sum_block) {
    const std::size_t blocks = band.position.size();
    const auto each_block = [&](auto&& body) {
        parallel_for(0, blocks, 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b) body(b);
        });
    };
    std::vector<Cells> cells(blocks), blurred(blocks);
    std::vector<Neighbours> around(blocks);
    each_block([&](std::size_t b) {
        around[b] = neighbours_of(band, b);
        sum_block(b, cells[b]);
    });
    // A pass adds half a squared cell of variance; interpolation about as much.
    const double cell = kStep * band.spacing;
    const int passes = std::max(1, static_cast<int>(std::lround(2 * std::pow(radius / cell, 2))));
    for (int pass = 0; pass < passes; ++pass) {
        each_block([&](std::size_t b) { blur_block(cells_around(around[b], cells), blurred[b]); });
        cells.swap(blurred);
    }
    each_block([&](std::size_t b) {
        subtract_block(cells_around(around[b], cells), band.width, static_cast<float>(most),
                       band.block(static_cast<std::int32_t>(b)));
    });
}

}  // namespace

void give_back(Band& band, std::span<const float> before, double radius) {
    spread(band, radius, band.width,
           [&](std::size_t b, Cells& out) { sum_displacement(band, before, b, out); });
}

void restore_volume(Band& band, const CellVolumes& missing, double radius) {
    spread(band, radius, 0.25 * band.spacing,
           [&](std::size_t b, Cells& out) { sum_volume(band, missing, b, out); });
}

}  // namespace myotet::levelset
