// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Necks.h"

#include <algorithm>

#include "Core/Parallel.h"

namespace myotet::levelset {
namespace {

constexpr std::int32_t kNone = -1;

// A region cut out of the map, with a layer of other voxels around it so that
// steps never leave the box.
struct Cutout {
    const RegionMap& map;
    RegionMap::Owner owner;
    Index3 low, size;
    std::vector<std::uint8_t> own, covered;
    std::ptrdiff_t steps[6];

    Cutout(const RegionMap& m, RegionMap::Owner r, const std::vector<std::uint8_t>& is_covered)
        : map(m), owner(r) {
        const VoxelRegion& region = m.regions[r - 1];
        for (int a = 0; a < 3; ++a) {
            low[a] = region.min[a] - 1;
            size[a] = region.max[a] - region.min[a] + 3;
        }
        const std::ptrdiff_t dj = size[0], dk = dj * size[1];
        const std::ptrdiff_t all[6] = {-1, 1, -dj, dj, -dk, dk};
        std::copy(std::begin(all), std::end(all), std::begin(steps));
        own.assign(static_cast<std::size_t>(dk) * size[2], 0);
        covered = own;
        for (int k = 1; k + 1 < size[2]; ++k)
            for (int j = 1; j + 1 < size[1]; ++j)
                for (int i = 1; i + 1 < size[0]; ++i) {
                    const std::size_t at = m.offset(low[0] + i, low[1] + j, low[2] + k);
                    const std::size_t here = k * dk + j * dj + i;
                    own[here] = m.owner[at] == r;
                    covered[here] = own[here] && is_covered[at];
                }
    }
    [[nodiscard]] std::size_t in_map(std::size_t here) const {
        const std::size_t i = here % size[0], j = here / size[0] % size[1],
                          k = here / size[0] / size[1];
        return map.offset(low[0] + static_cast<int>(i), low[1] + static_cast<int>(j),
                          low[2] + static_cast<int>(k));
    }
};

// Numbers the 6-connected parts of the covered voxels; members part by part.
std::vector<std::vector<std::int32_t>> covered_parts(const Cutout& cut,
                                                     std::vector<std::int32_t>& part) {
    part.assign(cut.own.size(), kNone);
    std::vector<std::vector<std::int32_t>> parts;
    for (std::size_t seed = 0; seed < part.size(); ++seed) {
        if (!cut.covered[seed] || part[seed] != kNone) continue;
        const auto number = static_cast<std::int32_t>(parts.size());
        std::vector<std::int32_t>& members = parts.emplace_back();
        members.push_back(static_cast<std::int32_t>(seed));
        part[seed] = number;
        for (std::size_t next = 0; next < members.size(); ++next)
            for (const std::ptrdiff_t step : cut.steps) {
                const std::size_t to = members[next] + step;
                if (!cut.covered[to] || part[to] != kNone) continue;
                part[to] = number;
                members.push_back(static_cast<std::int32_t>(to));
            }
    }
    return parts;
}

void mark_around(const Cutout& cut, std::size_t here, std::vector<std::size_t>& marked) {
    for (int n = 0; n < 27; ++n) {
        const std::size_t to =
            here + (n % 3 - 1) + (n / 3 % 3 - 1) * cut.steps[3] + (n / 9 - 1) * cut.steps[5];
        if (cut.own[to] && !cut.covered[to]) marked.push_back(cut.in_map(to));
    }
}

// Grows the first part breadth-first through the region; each other part that
// is met marks the way back and joins the growing one.
std::vector<std::size_t> necks_of(const Cutout& cut) {
    std::vector<std::int32_t> part;
    const auto parts = covered_parts(cut, part);
    std::vector<std::size_t> marked;
    if (parts.size() < 2) return marked;
    std::vector<std::int32_t> from(part.size(), kNone), queue = parts.front();
    for (const std::int32_t v : queue) from[v] = v;
    std::size_t met = 1;
    for (std::size_t next = 0; next < queue.size() && met < parts.size(); ++next)
        for (const std::ptrdiff_t step : cut.steps) {
            const std::int32_t at = queue[next];
            const auto to = static_cast<std::int32_t>(at + step);
            if (!cut.own[to] || from[to] != kNone) continue;
            from[to] = at;
            if (!cut.covered[to]) {
                queue.push_back(to);
                continue;
            }
            ++met;
            for (std::int32_t way = at; !cut.covered[way]; way = from[way])
                mark_around(cut, way, marked);
            for (const std::int32_t v : parts[part[to]]) {
                from[v] = v;
                queue.push_back(v);
            }
        }
    return marked;
}

}  // namespace

void mark_necks(RegionMap& map, const std::vector<std::uint8_t>& covered) {
    std::vector<std::vector<std::size_t>> marked(map.regions.size());
    parallel_for(0, marked.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r)
            marked[r] = necks_of(Cutout(map, static_cast<RegionMap::Owner>(r + 1), covered));
    });
    for (const auto& voxels : marked)
        for (const std::size_t v : voxels) map.flags[v] |= RegionMap::kThin;
}

}  // namespace myotet::levelset
