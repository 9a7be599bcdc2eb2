// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Places.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;

struct Key {
    Index3 block;  // k, j, i: sorts in memory order
    int region;
    auto operator<=>(const Key&) const = default;
};

// The region that owns the block's first sample: where it is stored nowhere
// near, it fills the block and is missed otherwise.
int owner_of(const RegionMap& map, const SharedLattice& lattice, const Index3& block) {
    const Vec3 u =
        lattice.local_to_index * (lattice.spacing * kSide * Vec3(block[0], block[1], block[2]));
    return map.owner_at(static_cast<int>(std::lround(u[0])), static_cast<int>(std::lround(u[1])),
                        static_cast<int>(std::lround(u[2])));
}

}  // namespace

Places find_places(const std::vector<RegionBand>& regions, const RegionMap& map,
                   const SharedLattice& lattice) {
    std::vector<Key> keys;
    for (std::size_t r = 0; r < regions.size(); ++r)
        for (const Index3& p : regions[r].band.position)
            for (int n = 0; n < 8; ++n)
                keys.push_back({{p[2] + regions[r].first[2] - (n >> 2),
                                 p[1] + regions[r].first[1] - (n >> 1 & 1),
                                 p[0] + regions[r].first[0] - (n & 1)},
                                static_cast<int>(r)});
    const auto tidy = [&] {
        std::sort(keys.begin(), keys.end());
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    };
    tidy();
    const std::size_t stored = keys.size();
    for (std::size_t i = 0; i < stored; ++i)
        if (i == 0 || keys[i].block != keys[i - 1].block)
            for (int n = 0; n < 8; ++n) {
                const Index3& b = keys[i].block;
                keys.push_back(
                    {b, owner_of(map, lattice,
                                 {b[2] + (n & 1), b[1] + (n >> 1 & 1), b[0] + (n >> 2)})});
            }
    tidy();
    Places out;
    out.full.assign(regions.size(), 0);
    std::vector<std::int64_t> inside(regions.size(), 0);
    for (std::size_t r = 0; r < regions.size(); ++r)
        for (const std::int32_t n : regions[r].band.block_of) inside[r] += n == Band::kInside;
    for (const Key& key : keys) {
        const Index3 block{key.block[2], key.block[1], key.block[0]};
        if (out.places.empty() || out.places.back().block != block)
            out.places.push_back({block, out.region.size(), out.region.size()});
        out.region.push_back(key.region);
        out.places.back().last = out.region.size();
        const RegionBand& r = regions[key.region];
        inside[key.region] -= r.band.find(local_block(r, block)) == Band::kInside;
    }
    for (std::size_t r = 0; r < regions.size(); ++r)
        out.full[r] = static_cast<double>(inside[r]) * Band::kSize * std::pow(lattice.spacing, 3);
    return out;
}

namespace {

// Values of one region at a place, with offset and locks.
void load(const RegionBand& region, const Index3& block, float offset, int high, float* out) {
    const Index3 b = local_block(region, block);
    gather(region.band, b, 0, high, out);
    const int side = kSide + high, count = side * side * side;
    const float width = region.band.width, unit = static_cast<float>(region.lock_unit);
    std::array<std::int8_t, kPatchSide * kPatchSide * kPatchSide> locks;
    gather(
        region.band, region.locks.data(), b, 0, high, [](std::int32_t) { return std::int8_t{0}; },
        locks.data());
    for (int i = 0; i < count; ++i)
        // Beyond the band nothing moves, or interfaces would appear at its edge.
        if (std::abs(out[i]) < width) out[i] = locked(out[i] + offset, locks[i], unit);
}

// Per sample the regions, one bit each, that have one of the two smallest
// values. The last bit stands for all regions from there on.
constexpr std::size_t kLastBit = 63;
using Leaders = std::array<std::uint64_t, kPatchSide * kPatchSide * kPatchSide>;

void find_leaders(const PlaceValues& values, Leaders& out) {
    out.fill(0);
    for (std::size_t n = 0; n < values.count; ++n) {
        const std::uint64_t bit = std::uint64_t{1} << std::min(n, kLastBit);
        const Patch& phi = values.phi[n];
        for (int i = 0; i < values.samples(); ++i)
            // Ties at the band's width are of regions that are far away.
            out[i] |= phi[i] <= values.second[i] && phi[i] < values.width ? bit : 0;
    }
}

// The corners of a cell that starts at sample `at` of a patch.
template <class Values>
auto corners_of(const Values& values, int at) {
    constexpr int y = kPatchSide, z = kPatchSide * kPatchSide;
    return std::array{values[at],         values[at + 1],        values[at + y],
                      values[at + y + 1], values[at + z],        values[at + z + 1],
                      values[at + z + y], values[at + z + y + 1]};
}

// Seams can only be where three regions take part: where two have the smallest
// values at all corners, no other is below them in between.
void find_seams_of_cell(const PlaceValues& values, int at, int cell, float margin,
                        std::vector<Seams::Corners>& near, std::vector<Seams::Corners>& pieces,
                        PlaceSeams& out) {
    near.clear();
    std::array<int, 64> number;
    for (std::size_t n = 0; n < values.count && near.size() < number.size(); ++n) {
        const Seams::Corners f = corners_of(values.phi[n], at);
        if (*std::min_element(f.begin(), f.end()) >= values.width) continue;
        number[near.size()] = static_cast<int>(n);
        near.push_back(f);
    }
    for (std::size_t n = 0; n < near.size(); ++n) {
        find_pieces(near, n, margin, pieces);
        if (pieces.empty()) continue;
        out.cells.push_back({number[n], cell, out.pieces.size()});
        out.pieces.insert(out.pieces.end(), pieces.begin(), pieces.end());
    }
}

}  // namespace

void load_place(const std::vector<RegionBand>& regions, const Places& places, const Place& place,
                std::span<const double> offset, int high, PlaceValues& out) {
    out.count = place.last - place.first;
    out.side = kSide + high;
    out.width = regions[0].band.width;
    if (out.phi.size() < out.count) out.phi.resize(out.count);
    const int samples = out.samples();
    std::fill_n(out.smallest.begin(), samples, out.width);
    std::fill_n(out.second.begin(), samples, out.width);
    for (std::size_t n = 0; n < out.count; ++n) {
        const int r = places.region[place.first + n];
        Patch& phi = out.phi[n];
        load(regions[r], place.block, static_cast<float>(offset[r]), high, phi.data());
        for (int i = 0; i < samples; ++i) {
            const float v = phi[i];
            out.second[i] = std::min(out.second[i], std::max(out.smallest[i], v));
            out.smallest[i] = std::min(out.smallest[i], v);
        }
    }
}

void find_seams(const PlaceValues& values, double spacing, PlaceSeams& out) {
    // Pieces are kept beside the surface too, or phi would jump just off it.
    constexpr double kMargin = 0.25;
    out.cells.clear();
    out.pieces.clear();
    if (values.count < 3) return;
    Leaders leaders;
    find_leaders(values, leaders);
    std::vector<Seams::Corners> near, pieces;
    for (int k = 0, cell = 0; k < kSide; ++k)
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i, ++cell) {
                const int at = (k * kPatchSide + j) * kPatchSide + i;
                std::uint64_t all = 0;
                for (const std::uint64_t bits : corners_of(leaders, at)) all |= bits;
                if (std::popcount(all) < 3 && !(all >> kLastBit)) continue;
                find_seams_of_cell(values, at, cell, static_cast<float>(kMargin * spacing), near,
                                   pieces, out);
            }
}

}  // namespace myotet::levelset
