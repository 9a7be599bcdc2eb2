// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/SliceSections.h"

#include <algorithm>

namespace myotet::levelset {
namespace {

// Fills the section at pixel p, which has number -2 as all that are not found yet.
void fill_section(SliceSections& s, int slice, std::array<int, 2> seed,
                  std::vector<std::array<int, 2>>& stack) {
    const auto id = static_cast<std::int32_t>(s.sections.size());
    Section section{.slice = slice, .low = seed, .high = seed};
    const auto place = [&](const std::array<int, 2>& p) -> std::int32_t& {
        return s.number[(static_cast<std::size_t>(slice - s.first_slice) * s.size[1] + p[1] -
                         s.first[1]) *
                            s.size[0] +
                        p[0] - s.first[0]];
    };
    place(seed) = id;
    stack.assign(1, seed);
    while (!stack.empty()) {
        const auto p = stack.back();
        stack.pop_back();
        ++section.area;
        const double x = p[0] - seed[0], y = p[1] - seed[1];
        const std::array<double, 3> square{x * x, x * y, y * y};
        for (int n = 0; n < 3; ++n) section.spread[n] += square[n];
        for (int a = 0; a < 2; ++a) {
            section.centre[a] += p[a] - seed[a];
            section.low[a] = std::min(section.low[a], p[a]);
            section.high[a] = std::max(section.high[a], p[a]);
            for (const int step : {-1, 1}) {
                auto q = p;
                q[a] += step;
                if (q[a] < s.first[a] || q[a] >= s.first[a] + s.size[a] || place(q) != -2) continue;
                place(q) = id;
                stack.push_back(q);
            }
        }
    }
    const auto area = static_cast<double>(section.area);
    for (double& c : section.centre) c /= area;
    const double x = section.centre[0], y = section.centre[1];
    const std::array<double, 3> square{x * x, x * y, y * y};
    for (int n = 0; n < 3; ++n) section.spread[n] = section.spread[n] / area - square[n];
    for (int a = 0; a < 2; ++a) section.centre[a] += seed[a];
    s.sections.push_back(section);
}

void link(SliceSections& s) {
    const std::size_t plane = static_cast<std::size_t>(s.size[0]) * s.size[1];
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (std::size_t at = 0; at + plane < s.number.size(); ++at) {
        const std::array<std::int32_t, 2> pair{s.number[at], s.number[at + plane]};
        if (pair[0] >= 0 && pair[1] >= 0 && (pairs.empty() || pairs.back() != pair))
            pairs.push_back(pair);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [lower, upper] : pairs) {
        s.sections[lower].above.push_back(upper);
        s.sections[upper].below.push_back(lower);
    }
}

}  // namespace

int SliceSections::at(int x, int y, int slice) const {
    x -= first[0], y -= first[1], slice -= first_slice;
    if (x < 0 || y < 0 || slice < 0 || x >= size[0] || y >= size[1] || slice >= slices) return -1;
    return number[(static_cast<std::size_t>(slice) * size[1] + y) * size[0] + x];
}

SliceMask SliceSections::mask_of(std::span<const int> which, int margin) const {
    SliceMask mask;
    std::array<int, 2> low = sections[which[0]].low, high = sections[which[0]].high;
    for (const int n : which)
        for (int a = 0; a < 2; ++a) {
            low[a] = std::min(low[a], sections[n].low[a]);
            high[a] = std::max(high[a], sections[n].high[a]);
        }
    for (int a = 0; a < 2; ++a) {
        mask.first[a] = low[a] - margin;
        mask.size[a] = high[a] - low[a] + 1 + 2 * margin;
    }
    mask.inside.assign(static_cast<std::size_t>(mask.size[0]) * mask.size[1], 0);
    const int slice = sections[which[0]].slice;
    for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x) {
            const int n = at(x, y, slice);
            if (n >= 0 && std::find(which.begin(), which.end(), n) != which.end())
                mask.inside[mask.offset(x, y)] = 1;
        }
    return mask;
}

SliceSections find_sections(const RegionMap& map, RegionMap::Owner owner, int axis) {
    const VoxelRegion& region = map.regions[owner - 1];
    const auto axes = slice_axes(axis);
    SliceSections s;
    s.axis = axis;
    s.first_slice = region.min[axis];
    s.slices = region.max[axis] - region.min[axis] + 1;
    for (int a = 0; a < 2; ++a) {
        s.first[a] = region.min[axes[a]];
        s.size[a] = region.max[axes[a]] - region.min[axes[a]] + 1;
    }
    s.number.assign(static_cast<std::size_t>(s.slices) * s.size[0] * s.size[1], -1);
    std::size_t at = 0;
    Index3 v;
    for (int k = 0; k < s.slices; ++k)
        for (int y = 0; y < s.size[1]; ++y)
            for (int x = 0; x < s.size[0]; ++x, ++at) {
                v[axis] = s.first_slice + k;
                v[axes[0]] = s.first[0] + x;
                v[axes[1]] = s.first[1] + y;
                if (map.owner[map.offset(v[0], v[1], v[2])] == owner) s.number[at] = -2;
            }
    std::vector<std::array<int, 2>> stack;
    at = 0;
    for (int k = 0; k < s.slices; ++k)
        for (int y = 0; y < s.size[1]; ++y)
            for (int x = 0; x < s.size[0]; ++x, ++at)
                if (s.number[at] == -2)
                    fill_section(s, s.first_slice + k, {s.first[0] + x, s.first[1] + y}, stack);
    link(s);
    return s;
}

std::int64_t shared_pixels(const SliceSections& s, std::span<const int> lower,
                           std::span<const int> upper, std::array<int, 2> shift) {
    std::int64_t count = 0;
    for (const int n : lower) {
        const Section& from = s.sections[n];
        for (int y = from.low[1]; y <= from.high[1]; ++y)
            for (int x = from.low[0]; x <= from.high[0]; ++x) {
                if (s.at(x, y, from.slice) != n) continue;
                const int other = s.at(x + shift[0], y + shift[1], from.slice + 1);
                count += other >= 0 && std::find(upper.begin(), upper.end(), other) != upper.end();
            }
    }
    return count;
}

}  // namespace myotet::levelset
