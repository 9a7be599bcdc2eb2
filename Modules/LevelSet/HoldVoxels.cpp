// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/HoldVoxels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;

// The eight samples around a voxel's centre and their share in the value there.
struct Around {
    std::array<Index3, 8> sample;  // of the shared lattice
    std::array<double, 8> weight;
    double square = 0;  // sum of squared weights
};

Around around(const SharedLattice& lattice, const Vec3& centre) {
    Around out;
    const Vec3 g = centre / lattice.spacing;
    for (int c = 0; c < 8; ++c) {
        out.weight[c] = 1;
        for (int a = 0; a < 3; ++a) {
            const double low = std::floor(g[a] + 1e-9), t = std::max(0.0, g[a] - low);
            const int up = c >> a & 1;
            out.sample[c][a] = static_cast<int>(low) + up;
            out.weight[c] *= up ? t : 1 - t;
        }
        out.square += out.weight[c] * out.weight[c];
    }
    return out;
}

struct Spot {
    float* value = nullptr;  // null where the region does not store the sample
    float held = 0;          // what it is then
};

Spot spot(RegionBand& region, const Index3& sample) {
    Index3 block;
    for (int a = 0; a < 3; ++a) block[a] = sample[a] / kSide - region.first[a];
    const std::int32_t number = region.band.find(block);
    if (number < 0) return {nullptr, region.band.empty_value(number)};
    return {region.band.block(number) + ((sample[2] % kSide) * kSide + sample[1] % kSide) * kSide +
                sample[0] % kSide,
            0};
}

double value(RegionBand& region, const Around& here) {
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
        if (here.weight[c] == 0) continue;
        const Spot s = spot(region, here.sample[c]);
        sum += here.weight[c] * (s.value ? *s.value : s.held);
    }
    return sum;
}

// The least change of the samples that changes the value by `change`.
void shift(RegionBand& region, const Around& here, double change) {
    for (int c = 0; c < 8; ++c)
        if (const Spot s = spot(region, here.sample[c]); s.value)
            *s.value =
                std::clamp(*s.value + static_cast<float>(change * here.weight[c] / here.square),
                           -region.band.width, region.band.width);
}

// The other owners among the 124 voxels around: a wall does not come from
// farther away to a centre.
struct Others {
    std::array<RegionMap::Owner, 125> owner;
    int count = 0;
};

void find_others(const RegionMap& map, const Index3& v, Others& out) {
    const RegionMap::Owner own = map.owner_at(v[0], v[1], v[2]);
    out.count = 0;
    for (int k = v[2] - 2; k <= v[2] + 2; ++k)
        for (int j = v[1] - 2; j <= v[1] + 2; ++j)
            for (int i = v[0] - 2; i <= v[0] + 2; ++i) {
                const RegionMap::Owner o = map.owner_at(i, j, k);
                auto* end = out.owner.begin() + out.count;
                if (o != own && std::find(out.owner.begin(), end, o) == end) {
                    *end = o;
                    ++out.count;
                }
            }
}

// Whether a voxel was in its place; puts it there if not.
bool hold(std::vector<RegionBand>& regions, const RegionMap& map, const SharedLattice& lattice,
          const Index3& v, const Vec3& centre, Others& others) {
    // Beyond rounding in single precision, and nothing that shows.
    const double margin = 1e-3 * lattice.spacing;
    const Around here = around(lattice, centre);
    RegionBand& own = regions[map.owner_at(v[0], v[1], v[2])];
    find_others(map, v, others);
    bool held = true;
    for (int n = 0; n < others.count; ++n) {
        RegionBand& other = regions[others.owner[n]];
        const double excess = value(own, here) - value(other, here);
        if (excess < -0.5 * margin) continue;
        held = false;
        shift(own, here, -0.5 * (excess + margin));
        shift(other, here, 0.5 * (excess + margin));
    }
    return held;
}

}  // namespace

std::int64_t hold_voxels(std::vector<RegionBand>& regions, const RegionMap& map,
                         const SharedLattice& lattice, const ProgressSink& progress) {
    constexpr int kMostSweeps = 200;
    const Eigen::Affine3d to_local = lattice.local_to_index.inverse();
    std::vector<Index3> beside;
    for (int k = 0; k < map.size[2]; ++k)
        for (int j = 0; j < map.size[1]; ++j)
            for (int i = 0; i < map.size[0]; ++i)
                if (!(map.flags[map.offset(i, j, k)] & RegionMap::kCore))
                    beside.push_back({i, j, k});
    std::int64_t wrong = 0;
    Others others;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        progress.check();
        wrong = 0;
        for (const Index3& v : beside)
            wrong += !hold(regions, map, lattice, v, to_local * Vec3(v[0], v[1], v[2]), others);
        if (wrong == 0) break;
    }
    return wrong;
}

}  // namespace myotet::levelset
