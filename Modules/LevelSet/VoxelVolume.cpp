// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/VoxelVolume.h"

#include <algorithm>
#include <cmath>

namespace myotet::levelset {
namespace {

constexpr int kCellsABlock = Band::kSide / kVolumeStep;

// Adds a voxel, a box in local coordinates, to the cells it reaches into.
void deposit(const RegionBand& region, const Vec3& centre, const Vec3& side, double density,
             CellVolumes& out) {
    const double cell = kVolumeStep * region.band.spacing;
    Index3 first, last;
    for (int a = 0; a < 3; ++a) {
        const double low = (centre[a] - 0.5 * side[a] - region.band.origin[a]) / cell;
        first[a] = static_cast<int>(std::floor(low));
        last[a] = static_cast<int>(std::ceil(low + side[a] / cell)) - 1;
    }
    const auto overlap = [&](int a, int c) {
        const double low = region.band.origin[a] + c * cell;
        return std::max(0.0, std::min(low + cell, centre[a] + 0.5 * side[a]) -
                                 std::max(low, centre[a] - 0.5 * side[a]));
    };
    for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j)
            for (int i = first[0]; i <= last[0]; ++i) {
                const std::int32_t number =
                    region.band.find({i / kCellsABlock, j / kCellsABlock, k / kCellsABlock});
                if (number < 0) continue;
                const int at =
                    ((k % kCellsABlock) * kCellsABlock + j % kCellsABlock) * kCellsABlock +
                    i % kCellsABlock;
                out[number][at] +=
                    static_cast<float>(density * overlap(0, i) * overlap(1, j) * overlap(2, k));
            }
}

}  // namespace

CellVolumes voxel_volumes(const VoxelScene& scene, RegionMap::Owner owner,
                          const RegionBand& region) {
    CellVolumes out(region.band.position.size(), std::array<float, 8>{});
    Index3 low{0, 0, 0}, high{scene.map.size[0] - 1, scene.map.size[1] - 1, scene.map.size[2] - 1};
    if (owner > 0) {
        low = scene.map.regions[owner - 1].min;
        high = scene.map.regions[owner - 1].max;
    }
    const Eigen::Affine3d to_local = scene.lattice.local_to_index.inverse();
    const Vec3& side = scene.lattice.plane_spacing;
    // One, but for sheared voxels, whose box is not theirs.
    const double density = std::abs(to_local.linear().determinant()) / side.prod();
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i) {
                const RegionMap::Owner own = scene.map.owner[scene.map.offset(i, j, k)];
                // The background, which goes on outside, is what the others leave.
                if (owner > 0 ? own != owner : own == 0) continue;
                deposit(region, to_local * Vec3(i, j, k), side, density, out);
            }
    if (owner == 0) {
        const auto whole = static_cast<float>(std::pow(kVolumeStep * scene.lattice.spacing, 3));
        for (auto& cells : out)
            for (float& v : cells) v = whole - v;
    }
    return out;
}

}  // namespace myotet::levelset
