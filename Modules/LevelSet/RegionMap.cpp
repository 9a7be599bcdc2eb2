// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/RegionMap.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>

#include "Core/Components.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "LevelSet/Necks.h"

namespace myotet::levelset {
namespace {

struct LabelBox {
    std::int32_t label = 0;
    bool found = false;
    Index3 min{0, 0, 0}, max{0, 0, 0};
};

std::vector<LabelBox> find_boxes(const LabelVolume& volume, std::vector<std::int32_t> labels) {
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    std::vector<LabelBox> boxes;
    for (const std::int32_t l : labels) boxes.push_back({.label = l});
    LabelBox* last = nullptr;
    std::size_t at = 0;
    for (int k = 0; k < volume.size[2]; ++k)
        for (int j = 0; j < volume.size[1]; ++j)
            for (int i = 0; i < volume.size[0]; ++i, ++at) {
                const std::int32_t value = volume.values[at];
                if (value == 0) continue;
                if (!last || last->label != value) {
                    const auto it = std::lower_bound(labels.begin(), labels.end(), value);
                    if (it == labels.end() || *it != value) continue;
                    last = &boxes[it - labels.begin()];
                }
                const Index3 p{i, j, k};
                if (!last->found) last->min = last->max = p;
                last->found = true;
                for (int a = 0; a < 3; ++a) {
                    last->min[a] = std::min(last->min[a], p[a]);
                    last->max[a] = std::max(last->max[a], p[a]);
                }
            }
    return boxes;
}

void require_present(const std::vector<LabelBox>& boxes) {
    if (boxes.empty()) throw InputError("no labels were asked for; name at least one");
    for (const LabelBox& b : boxes) {
        if (b.label == 0)
            throw InputError("label 0 was asked for, which is the background; leave it out");
        if (!b.found)
            throw InputError("label " + std::to_string(b.label) +
                             " is not in the volume; ask only for labels that it holds");
    }
}

void add_components(const LabelVolume& volume, const LabelBox& box, RegionMap& map) {
    const Components parts = label_components(volume, box.label, box.min, box.max);
    const std::size_t first = map.regions.size() + 1;
    if (first + parts.components.size() > std::numeric_limits<RegionMap::Owner>::max())
        throw ResourceError("label " + std::to_string(box.label) +
                            " brings the number of connected components above 65 000; remove "
                            "the specks from the segmentation first");
    for (std::size_t c = 0; c < parts.components.size(); ++c) {
        const ComponentBox& part = parts.components[c];
        map.regions.push_back({.label = box.label,
                               .component = static_cast<int>(c),
                               .voxels = part.voxels,
                               .min = part.min,
                               .max = part.max});
    }
    std::size_t at = 0;
    for (int k = 0; k < parts.size[2]; ++k)
        for (int j = 0; j < parts.size[1]; ++j) {
            RegionMap::Owner* row =
                map.owner.data() +
                map.offset(parts.origin[0], parts.origin[1] + j, parts.origin[2] + k);
            for (int i = 0; i < parts.size[0]; ++i, ++at)
                if (parts.number[at] >= 0)
                    row[i] = static_cast<RegionMap::Owner>(first + parts.number[at]);
        }
}

template <class Body>
void each_voxel(const RegionMap& map, Body&& body) {
    parallel_for(0, map.size[2], 1, [&](std::size_t first, std::size_t last) {
        for (int k = static_cast<int>(first); k < static_cast<int>(last); ++k) {
            std::size_t at = map.offset(0, 0, k);
            for (int j = 0; j < map.size[1]; ++j)
                for (int i = 0; i < map.size[0]; ++i, ++at) body(i, j, k, at);
        }
    });
}

// A separable erosion: the same owner three in a row along i, then three such
// rows along j, then three such planes along k. Outside, owner 0 goes on.
void mark_core(RegionMap& map) {
    std::vector<std::uint8_t> rows(map.owner.size()), planes(map.owner.size());
    const auto outside = [&](std::size_t at) { return map.owner[at] == 0; };
    const std::size_t step_j = map.size[0], step_k = step_j * map.size[1];
    const auto same = [&](const std::vector<std::uint8_t>* of, std::size_t at, std::size_t other) {
        return map.owner[at] == map.owner[other] && (!of || (*of)[other]);
    };
    each_voxel(map, [&](int i, int, int, std::size_t at) {
        rows[at] = (i > 0 ? same(nullptr, at, at - 1) : outside(at)) &&
                   (i + 1 < map.size[0] ? same(nullptr, at, at + 1) : outside(at));
    });
    each_voxel(map, [&](int, int j, int, std::size_t at) {
        planes[at] = rows[at] && (j > 0 ? same(&rows, at, at - step_j) : outside(at)) &&
                     (j + 1 < map.size[1] ? same(&rows, at, at + step_j) : outside(at));
    });
    each_voxel(map, [&](int, int, int k, std::size_t at) {
        const bool core = planes[at] && (k > 0 ? same(&planes, at, at - step_k) : outside(at)) &&
                          (k + 1 < map.size[2] ? same(&planes, at, at + step_k) : outside(at));
        map.flags[at] = core ? RegionMap::kCore : 0;
    });
}

// Whether some voxel of the same owner within `radius` of (i, j, k) has mark.
// What lies outside the volume counts as thick background.
bool any_near(const RegionMap& map, const std::vector<std::uint8_t>& marks, const Index3& p,
              int radius) {
    const RegionMap::Owner own = map.owner[map.offset(p[0], p[1], p[2])];
    for (int k = p[2] - radius; k <= p[2] + radius; ++k)
        for (int j = p[1] - radius; j <= p[1] + radius; ++j)
            for (int i = p[0] - radius; i <= p[0] + radius; ++i) {
                if (!map.holds(i, j, k)) continue;
                const std::size_t at = map.offset(i, j, k);
                if (map.owner[at] == own && marks[at]) return true;
            }
    return false;
}

void mark_thin(RegionMap& map) {
    // Covered by a core's block (1), far from all that is covered (2).
    std::vector<std::uint8_t> covered(map.owner.size()), far(map.owner.size());
    each_voxel(map, [&](int i, int j, int k, std::size_t at) {
        if (map.flags[at] & RegionMap::kCore) {
            covered[at] = 1;
            return;
        }
        const bool rim = i == 0 || j == 0 || k == 0 || i + 1 == map.size[0] ||
                         j + 1 == map.size[1] || k + 1 == map.size[2];
        covered[at] = map.owner[at] == 0 && rim;  // goes on outside
        for (int n = 0; n < 27 && !covered[at]; ++n) {
            const int x = i + n % 3 - 1, y = j + n / 3 % 3 - 1, z = k + n / 9 - 1;
            covered[at] = map.holds(x, y, z) && map.flags[map.offset(x, y, z)] & RegionMap::kCore;
        }
    });
    each_voxel(map, [&](int i, int j, int k, std::size_t at) {
        far[at] = !covered[at] && !any_near(map, covered, {i, j, k}, 2);
    });
    each_voxel(map, [&](int i, int j, int k, std::size_t at) {
        if (!covered[at] && any_near(map, far, {i, j, k}, 3)) map.flags[at] |= RegionMap::kThin;
    });
    mark_necks(map, covered);
}

}  // namespace

RegionMap map_regions(const LabelVolume& volume, std::span<const std::int32_t> labels) {
    const auto boxes = find_boxes(volume, {labels.begin(), labels.end()});
    require_present(boxes);
    RegionMap map;
    map.size = volume.size;
    map.owner.assign(volume.values.size(), 0);
    map.flags.assign(volume.values.size(), 0);
    for (const LabelBox& box : boxes) add_components(volume, box, map);
    mark_core(map);
    mark_thin(map);
    return map;
}

}  // namespace myotet::levelset
