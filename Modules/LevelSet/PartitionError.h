// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// What two regions claim both, and what lies between them that nobody claims.
struct PairError {
    int a = 0, b = 0;             ///< numbers of the regions, a < b
    double overlap = 0, gap = 0;  ///< mm^3
    double share = 0;             ///< of the smaller region's volume
};

/// How far level sets are from a partition of space.
struct PartitionError {
    std::vector<PairError> pairs;  ///< those with an error, sorted
    double overlap = 0, gap = 0;   ///< mm^3, of all pairs
    double largest_share = 0;      ///< of a pair's smaller region
};

/// Measures overlap and gap by `points` x `points` x `points` points in every
/// cell near a wall, from the values that LevelSet::value gives. The regions
/// must come from one call of from_labels and include the background, or what
/// lies outside all of them counts as gap; a point claimed twice or never counts for the two
/// regions with the smallest values. For tests and benchmarks.
/// Cost: O(wall area / spacing^2 * points^3).
[[nodiscard]] PartitionError measure_partition(std::span<const LevelSet* const> regions,
                                               int points = 4);

}  // namespace myotet::levelset
