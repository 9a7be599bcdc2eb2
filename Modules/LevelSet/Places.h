// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "LevelSet/Seams.h"
#include "LevelSet/VoxelBand.h"

namespace myotet::levelset {

/// A shared block and the regions whose values count there.
struct Place {
    Index3 block;             ///< among the shared lattice's
    std::size_t first, last;  ///< in Places::region
};

/// Every block of the shared lattice where more than one region may have a say.
struct Places {
    std::vector<Place> places;
    std::vector<int> region;   ///< ascending within a place
    std::vector<double> full;  ///< per region: volume of blocks wholly inside, mm^3
};

/// A region counts in the blocks it stores, and in the lower neighbours of
/// these, whose cells reach one sample into them.
[[nodiscard]] Places find_places(const std::vector<RegionBand>& regions, const RegionMap& map,
                                 const SharedLattice& lattice);

/// Block `block` of the shared lattice among the region's own.
[[nodiscard]] inline Index3 local_block(const RegionBand& r, const Index3& block) {
    return {block[0] - r.first[0], block[1] - r.first[1], block[2] - r.first[2]};
}

/// Samples of a block, with one layer of its upper neighbours or without.
inline constexpr int kPatchSide = Band::kSide + 1;
using Patch = std::array<float, kPatchSide * kPatchSide * kPatchSide>;

/// All regions of a place, i fastest; a thread's own.
struct PlaceValues {
    int side = 0;  ///< samples along an axis: 8 or 9
    float width = 0;
    std::size_t count = 0;
    std::vector<Patch> phi;  ///< per region of the place
    Patch smallest, second;  ///< of all phi at a sample

    [[nodiscard]] int samples() const { return side * side * side; }
};

/// Loads a place: each region's samples with its offset, as its locks allow.
/// `high` layers of the upper neighbours are added.
void load_place(const std::vector<RegionBand>& regions, const Places& places, const Place& place,
                std::span<const double> offset, int high, PlaceValues& out);

/// What the partition makes of a sample's value: half of what lies between it
/// and the smallest value of the other regions.
[[nodiscard]] inline float partitioned(float phi, float smallest, float second) {
    return 0.5f * (phi - (phi == smallest ? second : smallest));
}

/// The seams of a place's cells, all regions together; see Seams.
struct PlaceSeams {
    struct Cell {
        int region;  ///< number within the place
        int cell;    ///< in the block, i fastest
        std::size_t first;
    };
    std::vector<Cell> cells;
    std::vector<Seams::Corners> pieces;

    [[nodiscard]] std::span<const Seams::Corners> of(std::size_t n) const {
        const std::size_t end = n + 1 < cells.size() ? cells[n + 1].first : pieces.size();
        return std::span(pieces).subspan(cells[n].first, end - cells[n].first);
    }
};

/// Finds them, region by region within a cell, from values with a layer of the
/// upper neighbours. Replaces `out`.
void find_seams(const PlaceValues& values, double spacing, PlaceSeams& out);

}  // namespace myotet::levelset
