// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "LevelSet/Band.h"
#include "LevelSet/Claims.h"
#include "LevelSet/RegionMap.h"

namespace myotet::levelset {

/// How far smoothing may carry an interface away from the voxels' walls.
struct Allowance {
    double voxels = 0.5;        ///< of a voxel's side along each axis; infinite: no bound
    double thin_voxels = 0.15;  ///< the same inside sheets, tubes and specks
};

/// A region while it is worked on.
struct RegionBand {
    Index3 first{0, 0, 0};  ///< the band's first block among the shared lattice's
    Band band;
    /// Per sample: the side that a sample beyond the allowance must stay on, as
    /// a bound on phi: phi <= lock * unit where lock < 0, phi >= lock * unit
    /// where lock > 0; odd locks are due to thin parts.
    std::vector<std::int8_t> locks;
    double lock_unit = 0;    ///< mm
    bool held_back = false;  ///< a lock of a thin part stopped the flow
};

/// What all regions of a volume are measured with.
struct VoxelScene {
    const RegionMap& map;
    const SharedLattice& lattice;
    const std::vector<Claim>& claims;
    Allowance allowance;
    double width = 3;  ///< of the bands, in samples
};

/// Signed distances from the walls of the voxels of `owner`, exact next to the
/// walls, with the locks. The distance from a point to the nearest voxel of the
/// other kind is that to a box, so that no marching is needed.
[[nodiscard]] RegionBand voxel_band(const VoxelScene& scene, RegionMap::Owner owner);

/// The same for a region (not the background) of a scan in thick slices, with
/// the interface where slice_shape has it. Across the slices a lock of a thin
/// part holds only in its voxels' middles.
[[nodiscard]] RegionBand slice_band(const VoxelScene& scene, RegionMap::Owner owner);

/// The background of a scan in thick slices: what the regions leave. Where two
/// of them draw apart between slices whose voxels both have an owner, it stays out.
[[nodiscard]] RegionBand background_band(const VoxelScene& scene,
                                         const std::vector<RegionBand>& regions);

/// phi as its lock allows it.
[[nodiscard]] inline float locked(float phi, std::int8_t lock, float unit) {
    if (lock < 0) return std::min(phi, static_cast<float>(lock) * unit);
    if (lock > 0) return std::max(phi, static_cast<float>(lock) * unit);
    return phi;
}

}  // namespace myotet::levelset
