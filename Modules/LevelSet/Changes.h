// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "LevelSet/Claims.h"
#include "LevelSet/FromLabels.h"
#include "LevelSet/RegionMap.h"

namespace myotet::levelset {

/// Areas of a surface by their distance from the voxels' walls.
struct MovedAreas {
    static constexpr int kBins = 256, kBinsPerVoxel = 64;

    double bin = 0;                       ///< width of a bin, mm
    std::array<double, kBins> area = {};  ///< of a bin; the last holds all that lies beyond
    double total = 0, moment = 0;         ///< area, and area times distance
    double largest = 0;                   ///< mm

    void add(double distance, double weight);
    void add(const MovedAreas& other);
    [[nodiscard]] double mean() const { return total > 0 ? moment / total : 0; }
    /// Distance that `share` of the area does not exceed, to a bin's width.
    [[nodiscard]] double quantile(double share) const;
};

/// What became of a region's walls and voxels.
struct RegionChanges {
    MovedAreas moved;
    std::int64_t voxels_lost = 0, voxels_gained = 0;
};

/// Compares a finished region with the voxels of `owner`: how far each piece of
/// its surface lies from their walls, and which voxels' centres are on the
/// other side. Every voxel of the region's box counts.
/// Cost: O(voxels of the box + surface).
[[nodiscard]] RegionChanges measure_changes(const RegionMap& map, RegionMap::Owner owner,
                                            const SharedLattice& lattice, const LevelSet& phi);

/// The report of each label, by value; regions and changes in the same order.
[[nodiscard]] std::vector<SmoothingReport> report_changes(std::span<const Region> regions,
                                                          std::span<const RegionChanges> changes);

}  // namespace myotet::levelset
