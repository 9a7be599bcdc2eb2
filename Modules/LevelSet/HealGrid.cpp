// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/HealGrid.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "LevelSet/SurfaceBand.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
// Samples this near to a triangle are measured, in spacings: at least two
// layers on each side of every interface.
constexpr double kNear = 2;
// Distances are measured up to here, in spacings; beyond, the gap's surface is
// followed as if it were so far.
constexpr double kFarthest = 32;
// Next to a straight rim the winding number changes by h / (2 pi r) from sample
// to sample, r away from it: four times that is safe, and 0.35 at r = 2 h.
constexpr double kAround = 0.35;
// How far beside a triangle its two sides are looked at, in spacings.
constexpr double kBeside = 0.01;

constexpr std::array<Index3, 6> kSteps{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Triangles with the inside on one side: judged at their middle, and near their
/// corners where others cross them.
std::vector<std::uint8_t> find_bounding(const WindingTree& tree, double beside) {
    std::vector<std::uint8_t> bounding(tree.order.size(), 0);
    parallel_for(0, bounding.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            const auto& [a, b, c] = tree.corners[n];
            const Vec3 normal = (b - a).cross(c - a).stableNormalized() * beside;
            const Vec3 middle = (a + b + c) / 3;
            const auto parts = [&](const Vec3& p) {
                return (winding_number(tree, p + normal) >= HealGrid::kInside) !=
                       (winding_number(tree, p - normal) >= HealGrid::kInside);
            };
            bounding[tree.order[n]] = parts(middle) || parts(0.3 * middle + 0.7 * a) ||
                                      parts(0.3 * middle + 0.7 * b) ||
                                      parts(0.3 * middle + 0.7 * c);
        }
    });
    return bounding;
}

Index3 block_at(const Band& band, const Vec3& p) {
    Index3 b{};
    for (int a = 0; a < 3; ++a)
        b[a] = std::clamp(
            static_cast<int>(std::floor((p[a] - band.origin[a]) / (kSide * band.spacing))), 0,
            band.blocks[a] - 1);
    return b;
}

void add_block(HealGrid& grid, const Index3& b) {
    Band& band = grid.band;
    band.block_of[band.slot(b)] = static_cast<std::int32_t>(band.position.size());
    band.position.push_back(b);
    grid.winding.resize(band.position.size() * Band::kSize,
                        std::numeric_limits<float>::quiet_NaN());
    grid.away.resize(grid.winding.size(), HealGrid::kUnmeasured);
}

/// Blocks with samples near a triangle, in the order of the table.
void add_blocks_at_triangles(HealGrid& grid) {
    Band& band = grid.band;
    const double reach = kNear * band.spacing;
    std::vector<std::uint8_t> asked(band.block_of.size(), 0);
    for (const auto& corners : grid.tree.corners) {
        Box box;
        for (const Vec3& p : corners) box.include(p);
        const Index3 low = block_at(band, box.min - Vec3::Constant(reach));
        const Index3 high = block_at(band, box.max + Vec3::Constant(reach));
        for (int k = low[2]; k <= high[2]; ++k)
            for (int j = low[1]; j <= high[1]; ++j)
                for (int i = low[0]; i <= high[0]; ++i) asked[band.slot({i, j, k})] = 1;
    }
    const double half = 0.5 * (kSide - 1) * band.spacing;
    const double bound = std::sqrt(3.0) * half + reach;
    for (int k = 0; k < band.blocks[2]; ++k)
        for (int j = 0; j < band.blocks[1]; ++j)
            for (int i = 0; i < band.blocks[0]; ++i) {
                if (!asked[band.slot({i, j, k})]) continue;
                const Vec3 middle =
                    grid.place({i * kSide, j * kSide, k * kSide}) + Vec3::Constant(half);
                if (distance_to_triangles(grid.tree, middle, bound) < bound)
                    add_block(grid, {i, j, k});
            }
}

void measure(HealGrid& grid, std::int64_t at, double bound, bool beyond_too) {
    const Vec3 p = grid.place(grid.sample(at / Band::kSize, static_cast<int>(at % Band::kSize)));
    const double d = distance_to_triangles(grid.tree, p, bound);
    if (!(d < bound) && !beyond_too) return;
    grid.away[at] = static_cast<float>(d);
    grid.winding[at] = static_cast<float>(winding_number(grid.tree, p));
}

bool may_be_next_to_interface(const HealGrid& grid, std::int64_t at) {
    const double near = kNear * grid.band.spacing;
    return std::abs(grid.winding[at] - 0.5) <
           kAround * std::min(1.0, near / std::max(double{grid.away[at]}, near));
}

[[noreturn]] void refuse_leak() {
    throw InputError(
        "the surface is so open that the guess at what it encloses leaves its own box; close its "
        "larger holes first");
}

/// Unmeasured samples next to `front`, each once; adds their blocks.
std::vector<std::int64_t> samples_around(HealGrid& grid, const std::vector<std::int64_t>& front) {
    std::vector<std::int64_t> next;
    for (const std::int64_t at : front) {
        const Index3 s = grid.sample(at / Band::kSize, static_cast<int>(at % Band::kSize));
        for (const Index3& step : kSteps) {
            const Index3 to{s[0] + step[0], s[1] + step[1], s[2] + step[2]};
            const Index3 b{to[0] / kSide, to[1] / kSide, to[2] / kSide};
            for (int a = 0; a < 3; ++a)
                if (b[a] < 1 || b[a] > grid.band.blocks[a] - 2) refuse_leak();
            if (grid.band.find(b) < 0) add_block(grid, b);
            const std::int64_t there = grid.slot(to);
            if (grid.away[there] == HealGrid::kUnmeasured) next.push_back(there);
        }
    }
    std::ranges::sort(next);
    next.erase(std::unique(next.begin(), next.end()), next.end());
    return next;
}

/// From the triangles' surroundings on, wherever the interface may go.
void follow_interface(HealGrid& grid, ProgressSink& progress) {
    std::vector<std::int64_t> front;
    for (std::size_t at = 0; at < grid.away.size(); ++at)
        if (grid.away[at] != HealGrid::kUnmeasured &&
            may_be_next_to_interface(grid, static_cast<std::int64_t>(at)))
            front.push_back(static_cast<std::int64_t>(at));
    while (!front.empty()) {
        progress.check();
        front = samples_around(grid, front);
        parallel_for(0, front.size(), 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n)
                measure(grid, front[n], kFarthest * grid.band.spacing, true);
        });
        std::erase_if(front, [&](std::int64_t at) { return !may_be_next_to_interface(grid, at); });
    }
}

/// Gives every stored sample a side: the one of its neighbours, between which
/// and itself no interface runs.
void fill_sides(HealGrid& grid) {
    std::vector<std::int64_t> queue;
    const auto spread = [&] {
        for (std::size_t n = 0; n < queue.size(); ++n) {
            const Index3 s =
                grid.sample(queue[n] / Band::kSize, static_cast<int>(queue[n] % Band::kSize));
            for (const Index3& step : kSteps) {
                const std::int64_t to = grid.slot({s[0] + step[0], s[1] + step[1], s[2] + step[2]});
                if (to < 0 || !std::isnan(grid.winding[to])) continue;
                grid.winding[to] = grid.winding[queue[n]] >= HealGrid::kInside ? 1.0F : 0.0F;
                queue.push_back(to);
            }
        }
        queue.clear();
    };
    for (std::size_t at = 0; at < grid.winding.size(); ++at)
        if (!std::isnan(grid.winding[at])) queue.push_back(static_cast<std::int64_t>(at));
    spread();
    for (std::size_t at = 0; at < grid.winding.size(); ++at) {
        if (!std::isnan(grid.winding[at])) continue;
        const Index3 s = grid.sample(at / Band::kSize, static_cast<int>(at % Band::kSize));
        grid.winding[at] = static_cast<float>(winding_number(grid.tree, grid.place(s)));
        queue.push_back(static_cast<std::int64_t>(at));
        spread();
    }
}

}  // namespace

HealGrid make_heal_grid(const TriMesh& surface, double spacing, double half_width,
                        ProgressSink& progress) {
    HealGrid grid;
    grid.tree = build_winding_tree(surface);
    grid.bounding = find_bounding(grid.tree, kBeside * spacing);
    grid.band = empty_band(surface, spacing, half_width);
    add_blocks_at_triangles(grid);
    parallel_for(0, grid.band.position.size(), 4, [&](std::size_t first, std::size_t last) {
        progress.check();
        for (std::size_t at = first * Band::kSize; at < last * Band::kSize; ++at)
            measure(grid, static_cast<std::int64_t>(at), kNear * spacing, false);
    });
    follow_interface(grid, progress);
    fill_sides(grid);
    return grid;
}

}  // namespace myotet::levelset
