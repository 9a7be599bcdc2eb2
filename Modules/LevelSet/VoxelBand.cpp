// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/VoxelBand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Parallel.h"
#include "LevelSet/Redistance.h"
#include "LevelSet/SliceShape.h"

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
    Index3 window;       // voxels to look at on either side
    int thick_axis;      // across which shape is interpolated, or -1
    double thin_across;  // what a voxel's side across slices counts in thin parts

    // Such specks are held across the slices as everywhere.
    [[nodiscard]] bool one_slice_high(RegionMap::Owner own) const {
        return own > 0 &&
               map.regions[own - 1].min[thick_axis] == map.regions[own - 1].max[thick_axis];
    }

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
    [[nodiscard]] Nearness probe(const Vec3& u, const Index3& v, bool inside, bool thin) const {
        double nearest = std::numeric_limits<double>::infinity(), boxes = nearest;
        const auto gap = [&](int a, int c) { return std::max(0.0, std::abs(u[a] - c) - 0.5); };
        Vec3 counts = Vec3::Ones();
        if (thin && thick_axis >= 0 && !one_slice_high(map.owner_at(v[0], v[1], v[2])))
            counts[thick_axis] = thin_across;
        for (int k = v[2] - window[2]; k <= v[2] + window[2]; ++k) {
            const double gz = gap(2, k), dz = gz * plane_spacing[2];
            for (int j = v[1] - window[1]; j <= v[1] + window[1]; ++j) {
                const double gy = gap(1, j), dy = gy * plane_spacing[1];
                for (int i = v[0] - window[0]; i <= v[0] + window[0]; ++i) {
                    if ((map.owner_at(i, j, k) == owner) == inside) continue;
                    const double gx = gap(0, i), dx = gx * plane_spacing[0];
                    nearest = std::min(nearest, dx * dx + dy * dy + dz * dz);
                    boxes =
                        std::min(boxes, std::max({gx * counts[0], gy * counts[1], gz * counts[2]}));
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
                 const Vec3& reach, RegionBand& region) {
    Index3 low, high;
    voxel_box(map, owner, low, high);
    const Eigen::Affine3d to_local = lattice.local_to_index.inverse();
    // Half the extent of a voxel in local coordinates, and the reach.
    const Vec3 half = 0.5 * to_local.linear().cwiseAbs().rowwise().sum() + reach;
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
               const Vec3& reach, RegionBand& region) {
    Index3 low, high;
    voxel_box(map, owner, low, high);
    const Eigen::Affine3d to_local = lattice.local_to_index.inverse();
    Box box;
    for (int corner = 0; corner < 8; ++corner)
        box.include(to_local * Vec3(corner & 1 ? high[0] + 0.5 : low[0] - 0.5,
                                    corner & 2 ? high[1] + 0.5 : low[1] - 0.5,
                                    corner & 4 ? high[2] + 0.5 : low[2] - 0.5));
    const double block = kSide * lattice.spacing;
    const Vec3 margin = reach + Vec3::Constant(1.25 * block);
    for (int a = 0; a < 3; ++a) {
        region.first[a] = static_cast<int>(std::floor((box.min[a] - margin[a]) / block));
        const int last = static_cast<int>(std::floor((box.max[a] + margin[a]) / block));
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

// `shape`, where there is one, says where the interface lies instead of the walls.
void fill_block(const Prober& prober, const VoxelScene& scene, const SliceShape* shape,
                std::size_t b, RegionBand& region) {
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
        const bool thin = prober.map.holds(v[0], v[1], v[2]) &&
                          prober.map.flags[prober.map.offset(v[0], v[1], v[2])] & RegionMap::kThin;
        const bool sure = prober.uniform(v);
        Nearness near;
        if (!sure) near = prober.probe(u, v, inside, thin);
        const float d = std::min(static_cast<float>(near.distance), band.width);
        values[at] = inside ? -d : d;
        locks[at] = lock_of(near.boxes, inside, thin, scene.allowance, lattice, region.lock_unit);
        if (!shape || sure) continue;
        const auto shaped = static_cast<float>(shape->value(u));
        values[at] = locked(std::clamp(shaped, -band.width, band.width), locks[at],
                            static_cast<float>(region.lock_unit));
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

// Blocks around the walls and as far as shapes may stray from them, with
// samples from the walls or the shape, and locks.
RegionBand lay_region(const VoxelScene& scene, RegionMap::Owner owner, int thick_axis,
                      const SliceShape* shape) {
    const RegionMap& map = scene.map;
    const SharedLattice& lattice = scene.lattice;
    RegionBand region;
    Band& band = region.band;
    band.spacing = lattice.spacing;
    band.width = static_cast<float>(scene.width * lattice.spacing);
    // Locks reach one sample deep; what lies deeper is not reached by a flow.
    region.lock_unit = lattice.spacing / kLargestLock;
    band.beyond = owner == 0 ? Band::kInside : Band::kOutside;
    Vec3 reach = Vec3::Constant(band.width);
    if (thick_axis >= 0)
        reach += 0.5 * lattice.local_to_index.inverse().linear().col(thick_axis).cwiseAbs();
    lay_table(map, owner, lattice, reach, region);
    mark_blocks(map, owner, lattice, reach, region);
    number_blocks(band);
    band.values.resize(band.position.size() * Band::kSize);
    region.locks.resize(band.values.size());
    Prober prober{map, owner, lattice.plane_spacing, {}, thick_axis, 1};
    // Across thick slices a thin part is held in the middles of its voxels only.
    if (scene.allowance.voxels > 0)
        prober.thin_across =
            std::min(1.0, scene.allowance.thin_voxels / std::min(0.5, scene.allowance.voxels));
    for (int a = 0; a < 3; ++a)
        prober.window[a] =
            static_cast<int>(std::ceil(lattice.spacing / lattice.plane_spacing[a] - 1e-6));
    parallel_for(0, band.position.size(), 32, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) fill_block(prober, scene, shape, b, region);
    });
    return region;
}

void finish_region(RegionBand& region) {
    mark_unstored_blocks(region.band);
    redistance(region.band, Seeds::keep_cells, 0);
    drop_empty_blocks(region);
}

// The two smallest values among the regions at each sample of a shared block.
struct Smallest {
    std::array<float, Band::kSize> first, second;
};

void smallest_of(const std::vector<RegionBand>& regions, const Index3& block, Smallest& out) {
    out.first.fill(regions[1].band.width);
    out.second.fill(regions[1].band.width);
    for (std::size_t r = 1; r < regions.size(); ++r) {
        const RegionBand& region = regions[r];
        const std::int32_t number = region.band.find(
            {block[0] - region.first[0], block[1] - region.first[1], block[2] - region.first[2]});
        if (number == Band::kOutside) continue;
        for (int at = 0; at < Band::kSize; ++at) {
            const float v =
                number < 0 ? region.band.empty_value(number) : region.band.block(number)[at];
            out.second[at] = std::min(out.second[at], std::max(out.first[at], v));
            out.first[at] = std::min(out.first[at], v);
        }
    }
}

// Whether the voxels of both slices around u have an owner.
bool owned_in_both_slices(const RegionMap& map, int axis, Vec3 u) {
    const double below = std::floor(u[axis]);
    for (const double slice : {below, below + 1}) {
        u[axis] = slice;
        if (map.owner_at(static_cast<int>(std::lround(u[0])), static_cast<int>(std::lround(u[1])),
                         static_cast<int>(std::lround(u[2]))) == 0)
            return false;
    }
    return true;
}

void fill_background(const VoxelScene& scene, const std::vector<RegionBand>& regions, std::size_t b,
                     RegionBand& background) {
    Band& band = background.band;
    const Index3 p = band.position[b];
    const Index3 block{p[0] + background.first[0], p[1] + background.first[1],
                       p[2] + background.first[2]};
    Smallest smallest;
    smallest_of(regions, block, smallest);
    float* values = band.block(static_cast<std::int32_t>(b));
    const std::int8_t* locks = background.locks.data() + b * Band::kSize;
    for (int at = 0; at < Band::kSize; ++at) {
        float v = -smallest.first[at];
        if (v < 0 && smallest.second[at] < band.width) {
            const Vec3 sample(block[0] * kSide + at % kSide, block[1] * kSide + at / kSide % kSide,
                              block[2] * kSide + at / (kSide * kSide));
            const Vec3 u = scene.lattice.local_to_index * (scene.lattice.spacing * sample);
            if (owned_in_both_slices(scene.map, scene.lattice.thick_axis, u))
                v = smallest.second[at];
        }
        values[at] = locked(v, locks[at], static_cast<float>(background.lock_unit));
    }
}

}  // namespace

RegionBand voxel_band(const VoxelScene& scene, RegionMap::Owner owner) {
    RegionBand region = lay_region(scene, owner, -1, nullptr);
    finish_region(region);
    return region;
}

RegionBand slice_band(const VoxelScene& scene, RegionMap::Owner owner) {
    const int axis = scene.lattice.thick_axis;
    RegionBand region;
    {
        const SliceShape shape = slice_shape(scene.map, owner, axis, scene.lattice.plane_spacing);
        region = lay_region(scene, owner, axis, &shape);
    }
    finish_region(region);
    return region;
}

RegionBand background_band(const VoxelScene& scene, const std::vector<RegionBand>& regions) {
    RegionBand background = lay_region(scene, 0, scene.lattice.thick_axis, nullptr);
    parallel_for(0, background.band.position.size(), 32, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) fill_background(scene, regions, b, background);
    });
    finish_region(background);
    return background;
}

}  // namespace myotet::levelset
