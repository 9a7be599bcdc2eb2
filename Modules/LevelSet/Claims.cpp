// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Claims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "LevelSet/Band.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;

// How far from a voxel's middle a sample may lie to stand for it, in sides.
constexpr double kNear = 0.2;

// Samples first..last along one axis; those of a voxel's inside when one of
// them is near its middle, otherwise the nearest one, moved there.
struct Range {
    int first = 0, last = 0;
    bool moved = false;
};

Range range_of(double centre, double side, double spacing) {
    const int nearest = static_cast<int>(std::lround(centre / spacing));
    if (std::abs(nearest * spacing - centre) > kNear * side) return {nearest, nearest, true};
    return {static_cast<int>(std::ceil((centre - 0.5 * side) / spacing)),
            static_cast<int>(std::floor((centre + 0.5 * side) / spacing)), false};
}

std::uint64_t key_of(const SharedLattice& lattice, int i, int j, int k) {
    const std::size_t slot = lattice.slot({i / kSide, j / kSide, k / kSide});
    return slot * Band::kSize +
           static_cast<std::size_t>(((k % kSide) * kSide + j % kSide) * kSide + i % kSide);
}

struct Wish {
    std::int64_t voxels;  // of the region: the smaller goes first
    std::size_t at;       // offset of the voxel
    Claim claim;
};

void add_wishes(const RegionMap& map, const SharedLattice& lattice, const Vec3& centre,
                const Wish& wish, std::vector<Wish>& wishes) {
    Range range[3];
    std::uint8_t axes = 0;
    for (int a = 0; a < 3; ++a) {
        range[a] = range_of(centre[a], lattice.plane_spacing[a], lattice.spacing);
        axes |= static_cast<std::uint8_t>(range[a].moved << a);
    }
    if (axes == 0) return;
    for (int k = range[2].first; k <= range[2].last; ++k)
        for (int j = range[1].first; j <= range[1].last; ++j)
            for (int i = range[0].first; i <= range[0].last; ++i) {
                const Vec3 u = lattice.local_to_index * (lattice.spacing * Vec3(i, j, k));
                const int owner = map.owner_at(static_cast<int>(std::lround(u[0])),
                                               static_cast<int>(std::lround(u[1])),
                                               static_cast<int>(std::lround(u[2])));
                // A sample of a smaller region is not for taking.
                if (owner > 0 && map.regions[owner - 1].voxels < wish.voxels) continue;
                wishes.push_back(wish);
                wishes.back().claim.sample = key_of(lattice, i, j, k);
                wishes.back().claim.axes = axes;
            }
}

// A speck all of whose wishes went to others takes the nearest sample that no
// claim holds and that no region of its size or smaller owns.
void rescue(const RegionMap& map, const SharedLattice& lattice, const Vec3& centre,
            const Wish& wish, std::vector<Claim>& claims) {
    constexpr int kReach = 2;
    const auto before = [](const Claim& c, std::uint64_t key) { return c.sample < key; };
    Index3 middle;
    for (int a = 0; a < 3; ++a)
        middle[a] = static_cast<int>(std::lround(centre[a] / lattice.spacing));
    double nearest = std::numeric_limits<double>::infinity();
    Claim best = wish.claim;
    for (int k = middle[2] - kReach; k <= middle[2] + kReach; ++k)
        for (int j = middle[1] - kReach; j <= middle[1] + kReach; ++j)
            for (int i = middle[0] - kReach; i <= middle[0] + kReach; ++i) {
                const Vec3 p = lattice.spacing * Vec3(i, j, k);
                const Vec3 u = lattice.local_to_index * p;
                const int owner = map.owner_at(static_cast<int>(std::lround(u[0])),
                                               static_cast<int>(std::lround(u[1])),
                                               static_cast<int>(std::lround(u[2])));
                if (owner > 0 && map.regions[owner - 1].voxels <= wish.voxels) continue;
                const std::uint64_t key = key_of(lattice, i, j, k);
                const auto it = std::lower_bound(claims.begin(), claims.end(), key, before);
                if (it != claims.end() && it->sample == key) continue;
                const double distance = (p - centre).squaredNorm();
                if (distance < nearest) {
                    nearest = distance;
                    best.sample = key;
                    best.axes = 7;
                }
            }
    if (nearest < std::numeric_limits<double>::infinity())
        claims.insert(std::lower_bound(claims.begin(), claims.end(), best.sample, before), best);
}

}  // namespace

std::vector<Claim> claim_samples(const RegionMap& map, const SharedLattice& lattice) {
    std::vector<Wish> wishes;
    const Eigen::Affine3d to_local = lattice.local_to_index.inverse();
    std::vector<std::int64_t> held(map.regions.size() + 1, 0);  // voxels sure of a sample
    std::vector<Wish> first(map.regions.size() + 1);
    for (int k = 0; k < map.size[2]; ++k)
        for (int j = 0; j < map.size[1]; ++j)
            for (int i = 0; i < map.size[0]; ++i) {
                const std::size_t at = map.offset(i, j, k);
                const RegionMap::Owner owner = map.owner[at];
                if (owner == 0) continue;
                const bool thin = map.flags[at] & RegionMap::kThin;
                const Wish wish{thin ? map.regions[owner - 1].voxels : 0, at, {0, {i, j, k}, 0}};
                const std::size_t count = wishes.size();
                if (thin) add_wishes(map, lattice, to_local * Vec3(i, j, k), wish, wishes);
                if (wishes.size() == count)
                    ++held[owner];
                else if (first[owner].voxels == 0)
                    first[owner] = wish;
            }
    std::sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) {
        return std::tie(a.claim.sample, a.voxels, a.at) < std::tie(b.claim.sample, b.voxels, b.at);
    });
    std::vector<Claim> claims;
    for (const Wish& w : wishes)
        if (claims.empty() || claims.back().sample != w.claim.sample) {
            claims.push_back(w.claim);
            ++held[map.owner[w.at]];
        }
    for (std::size_t r = 1; r < held.size(); ++r)
        if (held[r] == 0 && first[r].voxels > 0) {
            const Index3& v = first[r].claim.voxel;
            rescue(map, lattice, to_local * Vec3(v[0], v[1], v[2]), first[r], claims);
        }
    return claims;
}

std::span<const Claim> claims_of_block(const std::vector<Claim>& claims, std::size_t slot) {
    const auto before = [](const Claim& c, std::uint64_t key) { return c.sample < key; };
    const auto first = std::lower_bound(claims.begin(), claims.end(), slot * Band::kSize, before);
    const auto last = std::lower_bound(first, claims.end(), (slot + 1) * Band::kSize, before);
    return {first, last};
}

}  // namespace myotet::levelset
