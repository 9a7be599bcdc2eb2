// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Changes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace myotet::levelset {
namespace {

constexpr int kCells = LevelSet::kBrickCells, kSamples = LevelSet::kBrickSamples;

Index3 nearest_voxel(const Vec3& u) {
    return {static_cast<int>(std::lround(u[0])), static_cast<int>(std::lround(u[1])),
            static_cast<int>(std::lround(u[2]))};
}

struct Scan {
    const RegionMap& map;
    RegionMap::Owner owner;
    const SharedLattice& lattice;

    // Squared distance from u (index coordinates) to the nearest voxel of the
    // other kind among those up to `reach` voxels away, mm^2.
    [[nodiscard]] double nearest(const Vec3& u, const Index3& v, bool inside, int reach) const {
        double best = std::numeric_limits<double>::infinity();
        const auto gap2 = [&](int a, int c) {
            const double gap = std::max(0.0, std::abs(u[a] - c) - 0.5) * lattice.plane_spacing[a];
            return gap * gap;
        };
        for (int k = v[2] - reach; k <= v[2] + reach; ++k)
            for (int j = v[1] - reach; j <= v[1] + reach; ++j) {
                const double across = gap2(1, j) + gap2(2, k);
                if (!(across < best)) continue;
                for (int i = v[0] - reach; i <= v[0] + reach; ++i)
                    if ((map.owner_at(i, j, k) == owner) != inside)
                        best = std::min(best, across + gap2(0, i));
            }
        return best;
    }

    // Distance from a point (local, mm) to the walls of the owner's voxels.
    [[nodiscard]] double to_walls(const Vec3& point) const {
        constexpr int kFarthest = 16;  // voxels; farther counts as this far
        const Vec3 u = lattice.local_to_index * point;
        const Index3 v = nearest_voxel(u);
        const bool inside = map.owner_at(v[0], v[1], v[2]) == owner;
        const double side = lattice.plane_spacing.minCoeff();
        // What lies outside a window is at least its reach away.
        for (int reach = 1;; reach *= 2) {
            const double found = std::sqrt(nearest(u, v, inside, reach));
            if (found <= reach * side || reach >= kFarthest)
                return std::min(found, kFarthest * side);
        }
    }
};

// The area of a surface is the sum, over the edges of the lattice that it cuts,
// of spacing^2 |n_a|, n_a the normal's part along the edge's axis: lines along
// axis a through all samples meet it spacing^-2 times the integral of |n_a|.
void measure_brick(const Scan& scan, const LevelSet& phi, std::size_t number, const Vec3& corner,
                   MovedAreas& moved) {
    constexpr int steps[3] = {1, kSamples, kSamples * kSamples};
    const float* values = phi.values.data() + number * LevelSet::kBrickSize;
    for (int k = 0; k < kCells; ++k)
        for (int j = 0; j < kCells; ++j)
            for (int i = 0; i < kCells; ++i) {
                const float* p = values + k * steps[2] + j * steps[1] + i;
                for (int a = 0; a < 3; ++a) {
                    if ((p[0] < 0) == (p[steps[a]] < 0)) continue;
                    const double t = p[0] / (double(p[0]) - p[steps[a]]);
                    const Vec3 point = corner + phi.spacing * (Vec3(i, j, k) + t * Vec3::Unit(a));
                    const Vec3 gradient = phi.sample(point).gradient;
                    const double along = std::abs(gradient[a]) / std::max(gradient.norm(), 1e-9);
                    moved.add(scan.to_walls(point), along);
                }
            }
}

// The index box of the voxels that may have their centre in a brick.
Box index_box(const SharedLattice& lattice, const Vec3& corner, double side) {
    Box box;
    for (int c = 0; c < 8; ++c)
        box.include(lattice.local_to_index * (corner + side * Vec3(c & 1, c >> 1 & 1, c >> 2)));
    return box;
}

// -1 or 1 when phi has this sign in the whole brick, else 0.
int sign_of_brick(const LevelSet& phi, const Index3& brick, std::int32_t number) {
    if (number < 0) {
        const std::size_t at =
            ((2 * static_cast<std::size_t>(brick[2]) + 1) * phi.coarse_size[1] + 2 * brick[1] + 1) *
                phi.coarse_size[0] +
            2 * brick[0] + 1;
        return phi.coarse_values[at] < 0 ? -1 : 1;
    }
    const float* first =
        phi.values.data() + static_cast<std::size_t>(number) * LevelSet::kBrickSize;
    const bool inside = first[0] < 0;
    const bool same = std::all_of(first, first + LevelSet::kBrickSize,
                                  [&](float v) { return (v < 0) == inside; });
    return !same ? 0 : inside ? -1 : 1;
}

void count_voxels(const Scan& scan, const LevelSet& phi, const Index3& brick, int sign,
                  RegionChanges& out) {
    const double side = kCells * phi.spacing;
    const Vec3 corner = phi.origin + side * Vec3(brick[0], brick[1], brick[2]);
    const Box box = index_box(scan.lattice, corner, side);
    const Eigen::Affine3d to_local = scan.lattice.local_to_index.inverse();
    Index3 low, high;
    for (int a = 0; a < 3; ++a) {
        low[a] = std::max(0, static_cast<int>(std::floor(box.min[a])));
        high[a] = std::min(scan.map.size[a] - 1, static_cast<int>(std::ceil(box.max[a])));
    }
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i) {
                const bool was = scan.map.owner[scan.map.offset(i, j, k)] == scan.owner;
                if (sign != 0 && was == (sign < 0)) continue;
                const Vec3 centre = to_local * Vec3(i, j, k), place = centre - corner;
                // A centre on a common face belongs to the upper brick.
                if (place.minCoeff() < 0 || place.maxCoeff() >= side) continue;
                const bool is = phi.value(centre) < 0;
                out.voxels_lost += was && !is;
                out.voxels_gained += is && !was;
            }
}

}  // namespace

void MovedAreas::add(double distance, double weight) {
    const double at = bin > 0 ? distance / bin : 0;
    area[static_cast<std::size_t>(std::min(at, kBins - 1.0))] += weight;
    total += weight;
    moment += weight * distance;
    largest = std::max(largest, distance);
}

void MovedAreas::add(const MovedAreas& other) {
    bin = other.bin;
    for (int b = 0; b < kBins; ++b) area[b] += other.area[b];
    total += other.total;
    moment += other.moment;
    largest = std::max(largest, other.largest);
}

double MovedAreas::quantile(double share) const {
    double sum = 0;
    for (int b = 0; b < kBins - 1; ++b) {
        sum += area[b];
        if (sum >= share * total) return std::min((b + 1) * bin, largest);
    }
    return largest;
}

RegionChanges measure_changes(const RegionMap& map, RegionMap::Owner owner,
                              const SharedLattice& lattice, const LevelSet& phi) {
    const Scan scan{map, owner, lattice};
    RegionChanges out;
    out.moved.bin = lattice.plane_spacing.maxCoeff() / MovedAreas::kBinsPerVoxel;
    const double side = kCells * phi.spacing;
    std::size_t slot = 0;
    for (int k = 0; k < phi.bricks[2]; ++k)
        for (int j = 0; j < phi.bricks[1]; ++j)
            for (int i = 0; i < phi.bricks[0]; ++i, ++slot) {
                const std::int32_t number = phi.brick_of[slot];
                const int sign = sign_of_brick(phi, {i, j, k}, number);
                count_voxels(scan, phi, {i, j, k}, sign, out);
                if (sign == 0)
                    measure_brick(scan, phi, static_cast<std::size_t>(number),
                                  phi.origin + side * Vec3(i, j, k), out.moved);
            }
    return out;
}

std::vector<SmoothingReport> report_changes(std::span<const Region> regions,
                                            std::span<const RegionChanges> changes) {
    std::vector<SmoothingReport> reports;
    for (std::size_t first = 0; first < regions.size();) {
        SmoothingReport report;
        report.label = regions[first].label;
        MovedAreas moved;
        for (; first < regions.size() && regions[first].label == report.label; ++first) {
            report.volume_before += regions[first].volume_labels;
            report.volume_after += regions[first].volume_level_set;
            report.voxels_lost += changes[first].voxels_lost;
            report.voxels_gained += changes[first].voxels_gained;
            moved.add(changes[first].moved);
        }
        report.moved_mean = moved.mean();
        report.moved_95 = moved.quantile(0.95);
        report.moved_max = moved.largest;
        reports.push_back(report);
    }
    return reports;
}

}  // namespace myotet::levelset
