// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/PartitionError.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "Core/Parallel.h"
#include "LevelSet/Measure.h"

namespace myotet::levelset {
namespace {

constexpr int kCells = LevelSet::kBrickCells;

using Pairs = std::map<std::pair<int, int>, PairError>;

// Place of a brick among all, k first: sorts in memory order.
Index3 brick_key(const LevelSet& phi, const Vec3& anchor, std::size_t slot) {
    const double side = kCells * phi.spacing;
    const std::size_t place[3] = {slot % phi.bricks[0], slot / phi.bricks[0] % phi.bricks[1],
                                  slot / phi.bricks[0] / phi.bricks[1]};
    Index3 key;
    for (int a = 0; a < 3; ++a)
        key[2 - a] = static_cast<int>(std::lround((phi.origin[a] - anchor[a]) / side)) +
                     static_cast<int>(place[a]);
    return key;
}

std::vector<Index3> stored_bricks(std::span<const LevelSet* const> regions, const Vec3& anchor) {
    std::vector<Index3> keys;
    for (const LevelSet* phi : regions)
        for (std::size_t s = 0; s < phi->brick_of.size(); ++s)
            if (phi->brick_of[s] >= 0) keys.push_back(brick_key(*phi, anchor, s));
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

// The two regions with the smallest values at a point.
struct Nearest {
    int first = -1, second = -1;
    double value = std::numeric_limits<double>::infinity(), next = value;
};

Nearest nearest_at(std::span<const LevelSet* const> regions, const std::vector<int>& here,
                   const Vec3& point) {
    Nearest out;
    for (const int r : here) {
        const double v = regions[r]->value(point);
        if (v < out.value) {
            out.second = out.first;
            out.next = out.value;
            out.first = r;
            out.value = v;
        } else if (v < out.next) {
            out.second = r;
            out.next = v;
        }
    }
    return out;
}

// Whether a cell is deep enough inside one region: interpolants stay within
// their corners' values.
bool settled(std::span<const LevelSet* const> regions, const std::vector<int>& here,
             const Vec3& low, double spacing) {
    constexpr double kClear = 0.25;  // spacings; what a wedge without a corner may reach
    int owner = -1;
    for (int c = 0; c < 8; ++c) {
        const Nearest n =
            nearest_at(regions, here, low + spacing * Vec3(c & 1, c >> 1 & 1, c >> 2));
        if (n.first < 0 || !(n.value < -kClear * spacing) || !(n.next > kClear * spacing))
            return false;
        if (owner >= 0 && n.first != owner) return false;
        owner = n.first;
    }
    return true;
}

void measure_cell(std::span<const LevelSet* const> regions, const std::vector<int>& here,
                  const Vec3& low, int points, Pairs& pairs) {
    const double spacing = regions[0]->spacing, step = spacing / points;
    // Values are floats: what lies within their rounding of a wall is on it.
    const double rounding = 1e-5 * spacing;
    for (int k = 0; k < points; ++k)
        for (int j = 0; j < points; ++j)
            for (int i = 0; i < points; ++i) {
                const Vec3 p = low + step * (Vec3(i, j, k) + Vec3::Constant(0.5));
                const Nearest n = nearest_at(regions, here, p);
                const bool gap = n.value > rounding, overlap = n.next < -rounding;
                if (n.second < 0 || (!gap && !overlap)) continue;
                PairError& pair = pairs[std::minmax(n.first, n.second)];
                (gap ? pair.gap : pair.overlap) += std::pow(step, 3);
            }
}

void measure_brick(std::span<const LevelSet* const> regions, const Vec3& low, int points,
                   Pairs& pairs) {
    const double spacing = regions[0]->spacing, side = kCells * spacing;
    const Vec3 middle = low + Vec3::Constant(0.5 * side);
    // A region whose value here is beyond the brick's diagonal has no part of it.
    std::vector<int> here;
    for (std::size_t r = 0; r < regions.size(); ++r)
        if (regions[r]->value(middle) < 1.2 * side) here.push_back(static_cast<int>(r));
    for (int k = 0; k < kCells; ++k)
        for (int j = 0; j < kCells; ++j)
            for (int i = 0; i < kCells; ++i) {
                const Vec3 cell = low + spacing * Vec3(i, j, k);
                if (!settled(regions, here, cell, spacing))
                    measure_cell(regions, here, cell, points, pairs);
            }
}

}  // namespace

PartitionError measure_partition(std::span<const LevelSet* const> regions, int points) {
    PartitionError out;
    if (regions.empty()) return out;
    const Vec3 anchor = regions[0]->origin;
    const double side = kCells * regions[0]->spacing;
    const std::vector<Index3> bricks = stored_bricks(regions, anchor);
    std::vector<Pairs> found(bricks.size());
    parallel_for(0, bricks.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b)
            measure_brick(regions, anchor + side * Vec3(bricks[b][2], bricks[b][1], bricks[b][0]),
                          points, found[b]);
    });
    Pairs pairs;
    for (const Pairs& brick : found)
        for (const auto& [key, error] : brick) {
            pairs[key].overlap += error.overlap;
            pairs[key].gap += error.gap;
        }
    std::vector<double> volume;
    for (const LevelSet* phi : regions) volume.push_back(enclosed_volume(*phi));
    for (auto& [key, error] : pairs) {
        error.a = key.first;
        error.b = key.second;
        const double smaller = std::min(volume[error.a], volume[error.b]);
        error.share = (error.overlap + error.gap) / std::max(smaller, 1e-30);
        out.overlap += error.overlap;
        out.gap += error.gap;
        out.largest_share = std::max(out.largest_share, error.share);
        out.pairs.push_back(error);
    }
    return out;
}

}  // namespace myotet::levelset
