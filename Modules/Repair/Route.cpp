// SPDX-License-Identifier: Apache-2.0
#include "Repair/Route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "Core/Errors.h"
#include "LevelSet/Csg.h"

namespace myotet::repair {
namespace {

using levelset::Band;

constexpr int kSide = Band::kSide;
constexpr double kDetour = 10;  // mm around the direct way that a route may use
constexpr double kMostNodes = 3e7;
constexpr float kWallCost = 4, kPassableCost = 3;
constexpr float kNever = std::numeric_limits<float>::infinity();

enum Kind : unsigned char { kFree, kFrom, kTo, kPassable, kWall };

// The samples of a box of the lattice.
struct Nodes {
    Vec3 origin;
    double spacing = 0;
    Index3 size{0, 0, 0};
    std::vector<Kind> kind;
    std::vector<float> wall_distance;  // mm, as far as bands reach
    std::vector<std::int16_t> wall;    // which one, or -1

    [[nodiscard]] std::size_t at(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * size[1] + j) * size[0] + i;
    }
    [[nodiscard]] Index3 place(std::size_t n) const {
        return {static_cast<int>(n % size[0]), static_cast<int>(n / size[0] % size[1]),
                static_cast<int>(n / size[0] / size[1])};
    }
    [[nodiscard]] Vec3 point(std::size_t n) const {
        const Index3 p = place(n);
        return origin + spacing * Vec3(p[0], p[1], p[2]);
    }
};

Box grown(Box box, double by) {
    box.min -= Vec3::Constant(by);
    box.max += Vec3::Constant(by);
    return box;
}

Box common(const Box& a, const Box& b) { return {a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)}; }

// What of each lies within reach of the other, and what is between.
Box region_of(const RouteTask& task) {
    const Box from = levelset::inside_box(task.from), to = levelset::inside_box(task.to);
    const double reach = task.within + 2 * task.from.spacing;
    const Box near_from = common(from, grown(to, reach)), near_to = common(to, grown(from, reach));
    if (near_from.empty() || near_to.empty()) return {};
    Box box = near_from;
    box.include(near_to.min);
    box.include(near_to.max);
    return grown(box, kDetour);
}

Nodes lay_nodes(const Box& box, const Band& band) {
    Nodes nodes;
    nodes.spacing = band.spacing;
    for (int a = 0; a < 3; ++a) {
        const double low = std::floor((box.min[a] - band.origin[a]) / band.spacing);
        nodes.origin[a] = band.origin[a] + low * band.spacing;
        nodes.size[a] = static_cast<int>(std::ceil(box.extent()[a] / band.spacing)) + 2;
    }
    const double count = double(nodes.size[0]) * nodes.size[1] * nodes.size[2];
    if (!(count <= kMostNodes))
        throw ResourceError("the space to be searched for a bridge has " +
                            std::to_string(count / 1e6) +
                            " million samples; allow a shorter way with 'within'");
    nodes.kind.assign(static_cast<std::size_t>(count), kFree);
    nodes.wall_distance.assign(nodes.kind.size(), kNever);
    nodes.wall.assign(nodes.kind.size(), -1);
    return nodes;
}

// Calls body(node, value) for all nodes in the band's table but those outside
// of its band.
template <class Body>
void each_near(const Nodes& nodes, const Band& band, Body&& body) {
    Index3 first, last;  // nodes of the table
    Index3 shift;        // from a node to a sample of the band
    for (int a = 0; a < 3; ++a) {
        shift[a] = static_cast<int>(std::lround((nodes.origin[a] - band.origin[a]) / band.spacing));
        first[a] = std::max(0, -shift[a]);
        last[a] = std::min(nodes.size[a], band.blocks[a] * kSide - shift[a]);
    }
    for (int k = first[2]; k < last[2]; ++k)
        for (int j = first[1]; j < last[1]; ++j)
            for (int i = first[0]; i < last[0]; ++i) {
                const Index3 s{i + shift[0], j + shift[1], k + shift[2]};
                const std::int32_t number =
                    band.block_of[band.slot({s[0] / kSide, s[1] / kSide, s[2] / kSide})];
                if (number == Band::kOutside) continue;
                body(nodes.at(i, j, k),
                     number == Band::kInside
                         ? -band.width
                         : band.block(number)[(s[2] % kSide * kSide + s[1] % kSide) * kSide +
                                              s[0] % kSide]);
            }
}

void mark_walls(const RouteTask& task, Nodes& nodes) {
    for (std::size_t w = 0; w < task.walls.size(); ++w)
        each_near(nodes, *task.walls[w], [&](std::size_t n, float v) {
            nodes.wall_distance[n] = std::min(nodes.wall_distance[n], v);
            if (v >= 0 || nodes.kind[n] == kWall) return;
            nodes.kind[n] = kWall;
            nodes.wall[n] = static_cast<std::int16_t>(w);
        });
}

void mark(const Band& band, Kind kind, Nodes& nodes) {
    each_near(nodes, band, [&](std::size_t n, float v) {
        if (v < 0 && nodes.kind[n] == kFree) nodes.kind[n] = kind;
    });
}

// Of the nodes of one kind only those near the wished point stay ends.
void keep_near(const std::optional<Vec3>& wished, Kind kind, Nodes& nodes) {
    if (!wished) return;
    constexpr double kAround = 3;  // mm
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < nodes.kind.size(); ++n)
        if (nodes.kind[n] == kind) nearest = std::min(nearest, (nodes.point(n) - *wished).norm());
    for (std::size_t n = 0; n < nodes.kind.size(); ++n)
        if (nodes.kind[n] == kind && (nodes.point(n) - *wished).norm() > nearest + kAround)
            nodes.kind[n] = kWall;
}

struct Search {
    const Nodes& nodes;
    double clearance;
    bool through_walls;
    std::vector<float> cost;
    std::vector<signed char> came;  // direction number, -1 at the goal

    [[nodiscard]] float factor(std::size_t n) const {
        if (nodes.kind[n] == kWall) return nodes.wall[n] < 0 || !through_walls ? kNever : 50.0f;
        float f = nodes.kind[n] == kPassable ? kPassableCost : 1.0f;
        const float d = std::max(nodes.wall_distance[n], 0.0f);
        if (d < clearance) {
            const float near = 1 - d / static_cast<float>(clearance);
            f += kWallCost * near * near;
        }
        return f;
    }

    // Spreads from the goal. Ends at the node of the beginning that lies most in
    // the middle of those that are about as near, so that a bridge leaves a flat
    // end from its centre.
    std::optional<std::size_t> run(const ProgressSink& progress) {
        using Entry = std::pair<float, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        cost.assign(nodes.kind.size(), kNever);
        came.assign(nodes.kind.size(), -1);
        for (std::size_t n = 0; n < nodes.kind.size(); ++n)
            if (nodes.kind[n] == kTo) {
                cost[n] = 0;
                queue.emplace(0.0f, static_cast<std::uint32_t>(n));
            }
        constexpr float kAboutAsNear = 1.5f;  // samples
        std::vector<std::size_t> ends;
        for (std::size_t popped = 0; !queue.empty(); ++popped) {
            if (popped % 65536 == 0) progress.check();
            const auto [so_far, n] = queue.top();
            queue.pop();
            if (so_far > cost[n]) continue;
            if (!ends.empty() && so_far > cost[ends.front()] + kAboutAsNear) break;
            if (nodes.kind[n] == kFrom)
                ends.push_back(n);
            else
                spread(n, [&](std::size_t there) {
                    queue.emplace(cost[there], static_cast<std::uint32_t>(there));
                });
        }
        if (ends.empty()) return {};
        return most_central(ends);
    }

    template <class Reached>
    void spread(std::size_t n, Reached&& reached) {
        const Index3 p = nodes.place(n);
        for (int d = 0; d < 27; ++d) {
            const Index3 q{p[0] + d % 3 - 1, p[1] + d / 3 % 3 - 1, p[2] + d / 9 - 1};
            if (d == 13 || q[0] < 0 || q[1] < 0 || q[2] < 0 || q[0] >= nodes.size[0] ||
                q[1] >= nodes.size[1] || q[2] >= nodes.size[2])
                continue;
            const std::size_t there = nodes.at(q[0], q[1], q[2]);
            const int axes = (d % 3 != 1) + (d / 3 % 3 != 1) + (d / 9 != 1);
            const float next = cost[n] + std::sqrt(float(axes)) * factor(there);
            if (!(next < cost[there])) continue;
            cost[there] = next;
            came[there] = static_cast<signed char>(d);
            reached(there);
        }
    }

    [[nodiscard]] std::size_t most_central(const std::vector<std::size_t>& ends) const {
        Vec3 middle = Vec3::Zero();
        for (const std::size_t n : ends) middle += nodes.point(n) / double(ends.size());
        return *std::min_element(ends.begin(), ends.end(), [&](std::size_t a, std::size_t b) {
            return (nodes.point(a) - middle).squaredNorm() <
                   (nodes.point(b) - middle).squaredNorm();
        });
    }

    // From the beginning to the goal.
    [[nodiscard]] std::vector<std::size_t> trace(std::size_t from) const {
        std::vector<std::size_t> path{from};
        while (came[path.back()] >= 0) {
            const int d = came[path.back()];
            const Index3 p = nodes.place(path.back());
            path.push_back(
                nodes.at(p[0] - (d % 3 - 1), p[1] - (d / 3 % 3 - 1), p[2] - (d / 9 - 1)));
        }
        return path;
    }
};

}  // namespace

Route find_route(const RouteTask& task, const ProgressSink& progress) {
    const Box box = region_of(task);
    Route route;
    if (box.empty()) return route;
    Nodes nodes = lay_nodes(box, task.from);
    mark_walls(task, nodes);
    // What lies in a wall too stays closed: from there the walls would cut.
    mark(task.to, kTo, nodes);
    mark(task.from, kFrom, nodes);
    for (const Band* passable : task.passables) mark(*passable, kPassable, nodes);
    keep_near(task.begin, kFrom, nodes);
    keep_near(task.end, kTo, nodes);

    Search search{nodes, task.clearance, false, {}, {}};
    if (const auto begin = search.run(progress)) {
        for (const std::size_t n : search.trace(*begin)) route.points.push_back(nodes.point(n));
        for (std::size_t i = 1; i < route.points.size(); ++i)
            route.length += (route.points[i] - route.points[i - 1]).norm();
        return route;
    }
    search.through_walls = true;
    if (const auto begin = search.run(progress))
        for (const std::size_t n : search.trace(*begin)) {
            const int wall = nodes.wall[n];
            if (wall >= 0 && std::find(route.blocked_by.begin(), route.blocked_by.end(), wall) ==
                                 route.blocked_by.end())
                route.blocked_by.push_back(wall);
        }
    return route;
}

double gap_between(const Band& a, const Band& b) {
    const levelset::LevelSet phi = levelset::assemble(levelset::settle(a));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < b.position.size(); ++n) {
        const float* values = b.block(static_cast<std::int32_t>(n));
        const Index3& p = b.position[n];
        for (int at = 0; at < Band::kSize; ++at) {
            if (!(values[at] < 0)) continue;
            const Vec3 sample(p[0] * kSide + at % kSide, p[1] * kSide + at / kSide % kSide,
                              p[2] * kSide + at / (kSide * kSide));
            nearest =
                std::min(nearest, phi.value(b.origin + b.spacing * sample) - std::abs(values[at]));
        }
    }
    return std::max(nearest, 0.0);
}

}  // namespace myotet::repair
