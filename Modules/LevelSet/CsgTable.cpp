// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/CsgTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "LevelSet/Csg.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kSize = Band::kSize;

// A box of blocks, in some band's numbers; max exclusive.
struct Blocks {
    Index3 min, max;
};

Blocks covered(const Band& first, const std::vector<Index3>& offsets,
               const std::vector<const Band*>& bands, Extent extent) {
    Blocks box{{0, 0, 0}, first.blocks};
    if (extent == Extent::first) return box;
    for (std::size_t n = 1; n < bands.size(); ++n)
        for (int a = 0; a < 3; ++a) {
            box.min[a] = std::min(box.min[a], offsets[n][a]);
            box.max[a] = std::max(box.max[a], offsets[n][a] + bands[n]->blocks[a]);
        }
    return box;
}

// What op makes of one block of all bands.
struct BlockMerger {
    const std::vector<const Band*>& bands;
    const std::vector<Index3>& offsets;
    const std::function<float(const float*)>& op;
    std::vector<float> at_sample;
    std::vector<std::int32_t> numbers;

    // False when no band has the block; then `out` holds one value.
    bool operator()(const Index3& b, float width, float* out) {
        bool stored = false;
        for (std::size_t n = 0; n < bands.size(); ++n) {
            const Index3& o = offsets[n];
            numbers[n] = bands[n]->find({b[0] - o[0], b[1] - o[1], b[2] - o[2]});
            at_sample[n] = bands[n]->empty_value(numbers[n]);
            stored = stored || numbers[n] >= 0;
        }
        const int count = stored ? kSize : 1;
        for (int at = 0; at < count; ++at) {
            for (std::size_t n = 0; n < bands.size(); ++n)
                if (numbers[n] >= 0) at_sample[n] = bands[n]->block(numbers[n])[at];
            out[at] = std::clamp(op(at_sample.data()), -width, width);
        }
        return stored;
    }
};

}  // namespace

Index3 block_offset(const Band& a, const Band& b) {
    Index3 offset;
    for (int i = 0; i < 3; ++i) {
        const double blocks = (b.origin[i] - a.origin[i]) / (kSide * a.spacing);
        offset[i] = static_cast<int>(std::lround(blocks));
        MYOTET_CHECK(std::abs(blocks - offset[i]) < 1e-4 &&
                         std::abs(b.spacing - a.spacing) <= 1e-9 * a.spacing,
                     "two bands do not lie on one lattice");
    }
    return offset;
}

Band merge(std::vector<const Band*> bands, Extent extent,
           const std::function<float(const float*)>& op) {
    const Band& first = *bands.front();
    std::vector<Index3> offsets;
    Band out;
    out.spacing = first.spacing;
    out.width = first.width;
    for (const Band* band : bands) {
        offsets.push_back(block_offset(first, *band));
        out.width = std::min(out.width, band->width);
    }
    const Blocks box = covered(first, offsets, bands, extent);
    out.origin = first.origin + kSide * first.spacing * Vec3(box.min[0], box.min[1], box.min[2]);
    for (int a = 0; a < 3; ++a) out.blocks[a] = box.max[a] - box.min[a];
    BlockMerger merge_block{bands, offsets, op, std::vector<float>(bands.size()),
                            std::vector<std::int32_t>(bands.size())};
    std::array<float, kSize> values;
    for (int k = box.min[2]; k < box.max[2]; ++k)
        for (int j = box.min[1]; j < box.max[1]; ++j)
            for (int i = box.min[0]; i < box.max[0]; ++i) {
                const bool stored = merge_block({i, j, k}, out.width, values.data());
                const bool near = stored && std::any_of(values.begin(), values.end(), [&](float v) {
                                      return std::abs(v) < out.width || (v < 0) != (values[0] < 0);
                                  });
                if (!near) {
                    out.block_of.push_back(values[0] < 0 ? Band::kInside : Band::kOutside);
                    continue;
                }
                out.block_of.push_back(static_cast<std::int32_t>(out.position.size()));
                out.position.push_back({i - box.min[0], j - box.min[1], k - box.min[2]});
                out.values.insert(out.values.end(), values.begin(), values.end());
            }
    return out;
}

Band framed(const Band& band, int margin) {
    Index3 min = band.blocks, max{-1, -1, -1};
    std::size_t slot = 0;
    for (int k = 0; k < band.blocks[2]; ++k)
        for (int j = 0; j < band.blocks[1]; ++j)
            for (int i = 0; i < band.blocks[0]; ++i, ++slot) {
                if (band.block_of[slot] == band.beyond) continue;
                const Index3 p{i, j, k};
                for (int a = 0; a < 3; ++a) {
                    min[a] = std::min(min[a], p[a]);
                    max[a] = std::max(max[a], p[a]);
                }
            }
    if (max[0] < 0) min = max = {0, 0, 0};
    Band out;
    out.spacing = band.spacing;
    out.width = band.width;
    out.beyond = band.beyond;
    for (int a = 0; a < 3; ++a) {
        min[a] -= margin;
        out.blocks[a] = max[a] + margin + 1 - min[a];
    }
    out.origin = band.origin + kSide * band.spacing * Vec3(min[0], min[1], min[2]);
    for (int k = 0; k < out.blocks[2]; ++k)
        for (int j = 0; j < out.blocks[1]; ++j)
            for (int i = 0; i < out.blocks[0]; ++i)
                out.block_of.push_back(band.find({i + min[0], j + min[1], k + min[2]}));
    out.position = band.position;
    for (Index3& p : out.position)
        for (int a = 0; a < 3; ++a) p[a] -= min[a];
    out.values = band.values;
    return out;
}

Band cropped(const Band& band, const Box& box) {
    const double block = kSide * band.spacing;
    Index3 min, max;  // both ends inclusive
    Band out;
    out.spacing = band.spacing;
    out.width = band.width;
    for (int a = 0; a < 3; ++a) {
        min[a] = static_cast<int>(std::floor((box.min[a] - band.origin[a]) / block));
        max[a] = static_cast<int>(std::floor((box.max[a] - band.origin[a]) / block));
        out.origin[a] = band.origin[a] + min[a] * block;
        out.blocks[a] = max[a] - min[a] + 1;
    }
    for (int k = min[2]; k <= max[2]; ++k)
        for (int j = min[1]; j <= max[1]; ++j)
            for (int i = min[0]; i <= max[0]; ++i) {
                const std::int32_t number = band.find({i, j, k});
                out.block_of.push_back(number);
                if (number < 0) continue;
                out.block_of.back() = static_cast<std::int32_t>(out.position.size());
                out.position.push_back({i - min[0], j - min[1], k - min[2]});
                out.values.insert(out.values.end(), band.block(number), band.block(number) + kSize);
            }
    return out;
}

bool is_empty(const Band& band) {
    return std::none_of(band.values.begin(), band.values.end(), [](float v) { return v < 0; });
}

Box inside_box(const Band& band) {
    Box box;
    for (std::size_t b = 0; b < band.position.size(); ++b) {
        const float* values = band.block(static_cast<std::int32_t>(b));
        const Index3& p = band.position[b];
        for (int at = 0; at < kSize; ++at)
            if (values[at] < 0)
                box.include(band.origin + band.spacing * Vec3(p[0] * kSide + at % kSide,
                                                              p[1] * kSide + at / kSide % kSide,
                                                              p[2] * kSide + at / (kSide * kSide)));
    }
    return box;
}

}  // namespace myotet::levelset
