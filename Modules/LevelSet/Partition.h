// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/Progress.h"
#include "LevelSet/GiveBack.h"
#include "LevelSet/Seams.h"
#include "LevelSet/VoxelBand.h"

namespace myotet::levelset {

/// Area of the wall between two regions, a < b.
struct SharedWall {
    int a = 0, b = 0;
    double area = 0;  ///< mm^2, of the voxels' faces
};

/// Every pair of owners with a common voxel face, sorted.
[[nodiscard]] std::vector<SharedWall> shared_walls(const RegionMap& map, const Vec3& face_area);

/// What each region is to enclose after the partition, mm^3. The background,
/// number 0, gets what remains.
struct WantedVolumes {
    std::vector<double> total;       ///< per region
    std::vector<CellVolumes> cells;  ///< per region, in its stored blocks; empty: totals only
    double radius = 0;               ///< mm over which the cells' volumes are to be met
    bool hold_voxels = false;        ///< no voxel's centre may leave its region, which comes first
};

/// What make_partition did.
struct PartitionSummary {
    int iterations = 0;
    double largest_error = 0;    ///< relative error left in a total, over all regions
    std::vector<double> offset;  ///< per region, added to its phi in the end, mm
    std::vector<Seams> seams;    ///< per region
};

/// Makes the regions (number 0 the background) a partition: each one's value
/// becomes half of what lies between it and the smallest of the others, so
/// that touching regions share one wall and nothing is claimed twice or left
/// over (after Losasso, Shinar, Selle, Fedkiw 2006); seams make that hold
/// within cells too. Before that each region's
/// volume is restored, as the partition will measure it: place by place in a
/// few rounds, then in total by constant offsets found together for all.
/// Locks hold throughout, but where voxels' centres need otherwise. Throws
/// Interrupted.
PartitionSummary make_partition(std::vector<RegionBand>& regions, const RegionMap& map,
                                const SharedLattice& lattice, std::span<const SharedWall> walls,
                                const WantedVolumes& wanted, const ProgressSink& progress);

}  // namespace myotet::levelset
