// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/VoxelBand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Parallel.h"
#include "LevelSet/Redistance.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kLargestLock = 126;
constexpr double kRounding = 1e-6;

// What the voxels around a sample say about one owner.
struct Nearness {
    double distance = std::numeric_limits<double>::infinity();  // to the other kind, mm
    double boxes = std::numeric_limits<double>::infinity();     // in voxel sides, maximum norm
};

struct Prober {
    const RegionMap& map;
    RegionMap::Owner owner;
    Vec3 plane_spacing;
    Index3 window;  // voxels to look at on either side

    // Whether all voxels of the window have one owner: blocks of 27 equal
    // voxels two apart cover it.
    [[nodiscard]] bool uniform(const Index3& v) const {
        const RegionMap::Owner own = map.owner_at(v[0], v[1], v[2]);
        for (int k = 1 - window[2]; k < window[2]; k += 2)
            for (int j = 1 - window[1]; j < window[1]; j += 2)
                for (int i = 1 - window[0]; i < window[0]; i += 2) {
                    const int x = v[0] + i, y = v[1] + j, z = v[2] + k;
                    if (!map.holds(x, y, z)) return false;
                    const std::size_t at = map.offset(x, y, z);
                    if (map.owner[at] != own || !(map.flags[at] & RegionMap::kCore)) return false;
                }
        return true;
    }

    // d^2 = sum over axes of (max(0, |u - c| - 1/2) * plane spacing)^2, u the
    // sample and c a voxel's centre in index coordinates.
    [[nodiscard]] Nearness probe(const Vec3& u, const Index3& v, bool inside) const {
        double nearest = std::numeric_limits<double>::infinity(), boxes = nearest;
        const auto gap = [&](int a, int c) { return std::max(0.0, std::abs(u[a] - c) - 0.5); };
        for (int k = v[2] - window[2]; k <= v[2] + window[2]; ++k) {
            const double gz = gap(2, k), dz = gz * plane_spacing[2];
            for (int j = v[1] - window[1]; j <= v[1] + window[1]; ++j) {
                const double gy = gap(1, j), dy = gy * plane_spacing[1];
                for (int i = v[0] - window[0]; i <= v[0] + window[0]; ++i) {
                    if ((map.owner_at(i, j, k) == owner) == inside) continue;
                    const double gx = gap(0, i), dx = gx * plane_spacing[0];
                    nearest = std::min(nearest, dx * dx + dy * dy + dz * dz);
                    boxes = std::min(boxes, std::max({gx, gy, gz}));
                }
            }
        }
        return {std::sqrt(nearest), boxes};
    }
};

// The index box of a region; the background's holds the layer outside, where
// it goes on.
void voxel_box(const RegionMap& map, RegionMap::Owner owner, Index3& low, Index3& high) {
    if (owner > 0) {
        low = map.regions[owner - 1].min;
        high = map.regions[owner - 1].max;
    } else {
        low = {-1, -1, -1};
        high = map.size;
    }
}

// Marks the blocks with samples within `reach` mm of a wall of the region.
void mark_blocks(const RegionMap& map, RegionMap::Owner owner, const SharedLattice& lattice,
                 double reach, RegionBand& region) {
    Index3 low, high;
    voxel_box(map, owner, low, high);
    const Eigen::Affine3d to_local = lattice.local_to_index.inverse();
    // Half the extent of a voxel in local coordinates, and the reach.
    const Vec3 half = 0.5 * to_local.linear().cwiseAbs().rowwise().sum() + Vec3::Constant(reach);
    const double block = kSide * lattice.spacing;
    const std::array<std::array<int, 3>, 6> sides{
        {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i) {
                if (map.owner_at(i, j, k) != owner) continue;
                if (map.holds(i, j, k) && map.flags[map.offset(i, j, k)] & RegionMap::kCore)
                    continue;
                const bool wall = std::any_of(sides.begin(), sides.end(), [&](const auto& s) {
                    return map.owner_at(i + s[0], j + s[1], k + s[2]) != owner;
                });
                if (!wall) continue;
                const Vec3 centre = to_local * Vec3(i, j, k);
                Index3 from, to;
                for (int a = 0; a < 3; ++a) {
                    from[a] = static_cast<int>(std::floor((centre[a] - half[a]) / block)) -
                              region.first[a];
                    to[a] = static_cast<int>(std::floor((centre[a] + half[a]) / block)) -
                            region.first[a];
                }
                for (int z = from[2]; z <= to[2]; ++z)
                    for (int y = from[1]; y <= to[1]; ++y)
                        for (int x = from[0]; x <= to[0]; ++x)
                            region.band.block_of[region.band.slot({x, y, z})] = 0;
            }
}

void number_blocks(Band& band) {
    for (std::size_t s = 0; s < band.block_of.size(); ++s) {
        if (band.block_of[s] < 0) continue;
        band.block_of[s] = static_cast<std::int32_t>(band.position.size());
        band.position.push_back({static_cast<int>(s % band.blocks[0]),
                                 static_cast<int>(s / band.blocks[0] % band.blocks[1]),
                                 static_cast<int>(s / band.blocks[0] / band.blocks[1])});
    }
}

// The table of blocks around the region's voxels: its walls, the band, two
// coarse cells and a block beyond.
void lay_table(const RegionMap& map, RegionMap::Owner owner, const SharedLattice& lattice,
               double reach, RegionBand& region) {
    Index3 low, high;
    voxel_box(map, owner, low, high);
    const Eigen::Affine3d to_local = lattice.local_to_index.inverse();
    Box box;
    for (int corner = 0; corner < 8; ++corner)
        box.include(to_local * Vec3(corner & 1 ? high[0] + 0.5 : low[0] - 0.5,
                                    corner & 2 ? high[1] + 0.5 : low[1] - 0.5,
                                    corner & 4 ? high[2] + 0.5 : low[2] - 0.5));
    const double block = kSide * lattice.spacing;
    const double margin = reach + 1.25 * block;
    for (int a = 0; a < 3; ++a) {
        region.first[a] = static_cast<int>(std::floor((box.min[a] - margin) / block));
        const int last = static_cast<int>(std::floor((box.max[a] + margin) / block));
        region.band.blocks[a] = last - region.first[a] + 1;
        region.band.origin[a] = region.first[a] * block;
    }
    region.band.block_of.assign(static_cast<std::size_t>(region.band.blocks[0]) *
                                    region.band.blocks[1] * region.band.blocks[2],
                                Band::kOutside);
}

std::int8_t lock_of(double boxes, bool inside, bool thin, const Allowance& allowance,
                    const SharedLattice& lattice, double unit) {
    const double allowed =
        thin ? std::min(allowance.thin_voxels, allowance.voxels) : allowance.voxels;
    if (!(boxes >= allowed - kRounding)) return 0;
    // (boxes - allowed) changes by at most 1 / the smallest voxel side a mm, so
    // that as a bound in mm it asks for no slope above one. At the allowance's
    // edge, where for half a voxel its middle lies, the sign alone is held.
    const double bound = (boxes - allowed) * lattice.plane_spacing.minCoeff();
    int lock = std::clamp(static_cast<int>(bound / unit), 2, kLargestLock);
    if (thin != (lock % 2 == 1)) --lock;  // odd: thin
    return static_cast<std::int8_t>(inside ? -lock : lock);
}

void fill_block(const Prober& prober, const VoxelScene& scene, std::size_t b, RegionBand& region) {
    Band& band = region.band;
    const SharedLattice& lattice = scene.lattice;
    const Index3 p = band.position[b];
    float* values = band.block(static_cast<std::int32_t>(b));
    std::int8_t* locks = region.locks.data() + b * Band::kSize;
    const auto claims = claims_of_block(
        scene.claims,
        lattice.slot({p[0] + region.first[0], p[1] + region.first[1], p[2] + region.first[2]}));
    auto claim = claims.begin();
    for (int at = 0; at < Band::kSize; ++at) {
        const Vec3 sample(p[0] * kSide + at % kSide, p[1] * kSide + at / kSide % kSide,
                          p[2] * kSide + at / (kSide * kSide));
        Vec3 u = lattice.local_to_index * (band.origin + lattice.spacing * sample);
        if (claim != claims.end() && static_cast<int>(claim->sample % Band::kSize) == at) {
            for (int a = 0; a < 3; ++a)
                if (claim->axes >> a & 1) u[a] = claim->voxel[a];
            ++claim;
        }
        const Index3 v{static_cast<int>(std::lround(u[0])), static_cast<int>(std::lround(u[1])),
                       static_cast<int>(std::lround(u[2]))};
        const bool inside = prober.map.owner_at(v[0], v[1], v[2]) == prober.owner;
        Nearness near;
        if (!prober.uniform(v)) near = prober.probe(u, v, inside);
        const float d = std::min(static_cast<float>(near.distance), band.width);
        values[at] = inside ? -d : d;
        const bool thin = prober.map.holds(v[0], v[1], v[2]) &&
                          prober.map.flags[prober.map.offset(v[0], v[1], v[2])] & RegionMap::kThin;
        locks[at] = lock_of(near.boxes, inside, thin, scene.allowance, lattice, region.lock_unit);
    }
}

// Drops blocks without a sample inside the band, which the generous marking
// left: everything after costs in proportion to blocks.
void drop_empty_blocks(RegionBand& region) {
    Band& band = region.band;
    std::size_t kept = 0;
    for (std::size_t b = 0; b < band.position.size(); ++b) {
        const float* from = band.block(static_cast<std::int32_t>(b));
        std::int32_t& number = band.block_of[band.slot(band.position[b])];
        if (std::none_of(from, from + Band::kSize,
                         [&](float v) { return std::abs(v) < band.width; })) {
            number = from[0] < 0 ? Band::kInside : Band::kOutside;
            continue;
        }
        number = static_cast<std::int32_t>(kept);
        if (kept != b) {
            std::copy(from, from + Band::kSize, band.block(number));
            std::copy_n(region.locks.begin() + b * Band::kSize, Band::kSize,
                        region.locks.begin() + kept * Band::kSize);
            band.position[kept] = band.position[b];
        }
        ++kept;
    }
    band.position.resize(kept);
    band.values.resize(kept * Band::kSize);
    region.locks.resize(kept * Band::kSize);
    band.position.shrink_to_fit();
    band.values.shrink_to_fit();
    region.locks.shrink_to_fit();
}

}  // namespace

RegionBand voxel_band(const VoxelScene& scene, RegionMap::Owner owner) {
    const RegionMap& map = scene.map;
    const SharedLattice& lattice = scene.lattice;
    RegionBand region;
    Band& band = region.band;
    band.spacing = lattice.spacing;
    band.width = static_cast<float>(scene.width * lattice.spacing);
    // Locks reach one sample deep; what lies deeper is not reached by a flow.
    region.lock_unit = lattice.spacing / kLargestLock;
    band.beyond = owner == 0 ? Band::kInside : Band::kOutside;
    lay_table(map, owner, lattice, band.width, region);
    mark_blocks(map, owner, lattice, band.width, region);
    number_blocks(band);
    band.values.resize(band.position.size() * Band::kSize);
    region.locks.resize(band.values.size());
    Prober prober{map, owner, lattice.plane_spacing, {}};
    for (int a = 0; a < 3; ++a)
        prober.window[a] =
            static_cast<int>(std::ceil(lattice.spacing / lattice.plane_spacing[a] - 1e-6));
    parallel_for(0, band.position.size(), 32, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) fill_block(prober, scene, b, region);
    });
    mark_unstored_blocks(band);
    redistance(band, Seeds::keep_cells, 0);
    drop_empty_blocks(region);
    return region;
}

}  // namespace myotet::levelset
