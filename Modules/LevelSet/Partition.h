// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/VoxelBand.h"

#include "Core/Progress.h"

#include <span>
#include <vector>

namespace myotet::levelset {

/// Area of the wall between two regions, a < b.
struct SharedWall {
    int a = 0, b = 0;
    double area = 0;  ///< mm^2, of the voxels' faces
};

/// Every pair of owners with a common voxel face, sorted.
[[nodiscard]] std::vector<SharedWall> shared_walls(const RegionMap& map,
                                                   const Vec3& face_area);

/// What make_partition did.
struct PartitionSummary {
    int iterations = 0;
    double largest_error = 0;         ///< relative volume error left, over all regions
    std::vector<double> offset;       ///< per region, added to its phi, mm
};

/// Makes the regions (number 0 the background) a partition: where a <= b are
/// the two smallest values at a sample, (a + b) / 2 is subtracted from all, so
/// that touching regions share one wall and nothing is claimed twice or left
/// over (Losasso, Shinar, Selle, Fedkiw 2006). Before that a constant offset
/// is added to each region, found together for all, so that the partition
/// encloses `volume[r]` (mm^3; the background's is what remains). Locks hold.
PartitionSummary make_partition(std::vector<RegionBand>& regions, const RegionMap& map,
                                const SharedLattice& lattice, std::span<const SharedWall> walls,
                                std::span<const double> volume, const ProgressSink& progress);

}  // namespace myotet::levelset
