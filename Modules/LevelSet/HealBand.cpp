// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/HealBand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "LevelSet/HealGrid.h"

namespace myotet::levelset {
namespace {

constexpr std::array<Index3, 6> kSteps{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
// Halvings of a lattice edge that a gap's surface cuts: to 2 % of it.
constexpr int kHalvings = 6;
// Reach of the difference that finds a gap's normal, in spacings.
constexpr double kDifference = 0.25;
// No sample lies on the interface itself: it needs a side. Part of the spacing.
constexpr float kLeast = 1e-4F;

/// What was counted while distances were made.
struct Counts {
    std::int64_t cut = 0;                // lattice edges
    double guessed = 0;                  // area, in squares of the spacing
    std::int64_t far = 0, doubtful = 0;  // samples
};

Index3 moved(const Index3& s, const Index3& step) {
    return {s[0] + step[0], s[1] + step[1], s[2] + step[2]};
}

/// Distance from a to where the winding number crosses 1/2 on the way to b,
/// both ends being on different sides.
double way_to_crossing(const HealGrid& grid, const Vec3& a, const Vec3& b, bool inside_a) {
    double low = 0, high = 1;
    for (int n = 0; n < kHalvings; ++n) {
        const double middle = 0.5 * (low + high);
        const bool inside = winding_number(grid.tree, a + middle * (b - a)) >= HealGrid::kInside;
        (inside == inside_a ? low : high) = middle;
    }
    return 0.5 * (low + high) * (b - a).norm();
}

/// What a lattice edge along `axis` says of the area of a gap's surface that it
/// cuts. A plane of area A and unit normal n cuts A |n_a| / h^2 edges along axis
/// a; each counts h^2 |n_a|, which sums to A.
double area_share(const HealGrid& grid, const Vec3& crossing, int axis) {
    const double step = kDifference * grid.band.spacing;
    Vec3 normal = Vec3::Zero();
    for (int a = 0; a < 3; ++a)
        normal[a] = winding_number(grid.tree, crossing + step * Vec3::Unit(a)) -
                    winding_number(grid.tree, crossing - step * Vec3::Unit(a));
    return normal.norm() > 0 ? std::abs(normal[axis]) / normal.norm() : 0;
}

/// Distance to the guessed surface of a sample that cuts no edge: to first
/// order, where no triangle is near enough to disturb it.
double distance_beside_gap(const HealGrid& grid, const Index3& s, float winding) {
    double slope_squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t low = grid.slot(moved(s, kSteps[2 * axis]));
        const std::int64_t high = grid.slot(moved(s, kSteps[2 * axis + 1]));
        for (const std::int64_t at : {low, high})
            if (at < 0 || grid.away[at] == HealGrid::kUnmeasured ||
                !(grid.away[at] > grid.band.spacing))
                return grid.band.width;
        const double slope = 0.5 * (grid.winding[high] - grid.winding[low]) / grid.band.spacing;
        slope_squared += slope * slope;
    }
    return std::abs(winding - 0.5) / std::sqrt(slope_squared);
}

/// Distance of a sample to the interface, from the lattice edges that it cuts
/// next to it: to the nearest triangle of the interface, and to the plane
/// through the crossings in gaps, |x|^-2 = sum of squared inverse ways.
float distance_at(const HealGrid& grid, const Index3& s, float winding, Counts& counts) {
    const Vec3 here = grid.place(s);
    const bool inside = winding >= HealGrid::kInside;
    double inverse_squared = 0;
    bool cut = false;
    for (int axis = 0; axis < 3; ++axis) {
        double shortest = std::numeric_limits<double>::infinity();
        for (const int side : {0, 1}) {
            const Index3 other = moved(s, kSteps[2 * axis + side]);
            const float there = grid.winding_at(other);
            if (std::isnan(there) || (there >= HealGrid::kInside) == inside) continue;
            cut = true;
            const Vec3 end = grid.place(other);
            const bool gap = !crosses_triangle(grid.tree, here, end, grid.bounding);
            counts.cut += side;  // each edge once
            if (!gap) continue;
            const double way = way_to_crossing(grid, here, end, inside);
            shortest = std::min(shortest, way);
            if (side == 1) counts.guessed += area_share(grid, here + way * Vec3::Unit(axis), axis);
        }
        inverse_squared += 1 / (shortest * shortest);
    }
    const double to_triangles =
        distance_to_triangles(grid.tree, here, grid.band.width, grid.bounding);
    const double to_guess = cut ? 1 / std::sqrt(inverse_squared)  // infinite without gaps
                                : distance_beside_gap(grid, s, winding);
    return static_cast<float>(std::min({to_triangles, to_guess, double{grid.band.width}}));
}

/// Winding numbers become signed distances, block by block.
Counts make_distances(HealGrid& grid, ProgressSink& progress) {
    Band& band = grid.band;
    const auto h = static_cast<float>(band.spacing);
    band.values.resize(grid.winding.size());
    std::vector<Counts> counts(band.position.size());
    parallel_for(0, counts.size(), 16, [&](std::size_t first, std::size_t last) {
        progress.check();
        for (std::size_t b = first; b < last; ++b)
            for (int n = 0; n < Band::kSize; ++n) {
                const std::size_t at = b * Band::kSize + n;
                const float w = grid.winding[at];
                const bool measured = grid.away[at] < HealGrid::kUnmeasured;
                float d = band.width;
                if (measured) {
                    d = std::max(distance_at(grid, grid.sample(b, n), w, counts[b]), kLeast * h);
                    const bool far = grid.away[at] > h;
                    counts[b].far += far;
                    counts[b].doubtful += far && w > 0.1F && w < 0.9F;
                }
                band.values[at] = w >= HealGrid::kInside ? -d : d;
            }
    });
    Counts sum;
    for (const Counts& c : counts) {
        sum.cut += c.cut, sum.guessed += c.guessed;
        sum.far += c.far, sum.doubtful += c.doubtful;
    }
    return sum;
}

/// Of the triangles that bound the solid.
double bounding_area(const HealGrid& grid) {
    double area = 0;
    for (std::size_t n = 0; n < grid.tree.order.size(); ++n) {
        const auto& [a, b, c] = grid.tree.corners[n];
        if (grid.bounding[grid.tree.order[n]]) area += 0.5 * (b - a).cross(c - a).norm();
    }
    return area;
}

}  // namespace

Band healed_band(const TriMesh& oriented, double spacing, double half_width, HealSummary& summary,
                 ProgressSink& progress) {
    HealGrid grid = make_heal_grid(oriented, spacing, half_width, progress);
    const Counts counts = make_distances(grid, progress);
    summary.guessed_area = spacing * spacing * counts.guessed;
    const double area = bounding_area(grid) + summary.guessed_area;
    summary.guessed_share = area > 0 ? summary.guessed_area / area : 0;
    summary.doubtful_share =
        counts.far > 0 ? static_cast<double>(counts.doubtful) / static_cast<double>(counts.far) : 0;
    if (counts.cut == 0)
        throw InputError(
            "the surface encloses nothing: nowhere is its winding number above 1/2; it is flat, "
            "or its triangles face all ways, and cannot be healed");
    mark_unstored_blocks(grid.band);
    return std::move(grid.band);
}

}  // namespace myotet::levelset
