// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "Quality/Quality.h"

namespace myotet::quality {
namespace {

/// One side of a triangle, from the smaller to the larger point number.
struct Side {
    std::int32_t low = 0, high = 0;
    bool forward = true;  ///< whether the triangle runs it from low to high
    auto operator<=>(const Side&) const = default;
};

/// Sets that grow together, one a point at first.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    void join(std::int32_t a, std::int32_t b) { parent_[root(a)] = root(b); }
    /// Sets that hold a marked element, the marks being the same all over a set.
    [[nodiscard]] std::int64_t count(const std::vector<char>& marked) const {
        std::int64_t count = 0;
        for (std::size_t i = 0; i < parent_.size(); ++i)
            count += marked[i] && parent_[i] == static_cast<std::int32_t>(i);
        return count;
    }

private:
    std::int32_t root(std::int32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    std::vector<std::int32_t> parent_;
};

double angle_deg(const Vec3& at, const Vec3& a, const Vec3& b) {
    return std::atan2((a - at).cross(b - at).norm(), (a - at).dot(b - at)) * 180 / std::numbers::pi;
}

void measure_triangles(const TriMesh& surface, SurfaceShape& shape) {
    shape.min_angle_deg = 180;
    for (const Triangle& t : surface.triangles) {
        const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
        shape.area += 0.5 * (b - a).cross(c - a).norm();
        for (const double angle : {angle_deg(a, b, c), angle_deg(b, c, a), angle_deg(c, a, b)}) {
            shape.min_angle_deg = std::min(shape.min_angle_deg, angle);
            shape.max_angle_deg = std::max(shape.max_angle_deg, angle);
        }
    }
}

/// All triangles' sides; those of one edge stand together.
std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    std::ranges::sort(sides);
    return sides;
}

EdgeLengths summary(std::vector<double>& lengths) {
    if (lengths.empty()) return {};
    std::ranges::sort(lengths);
    return {lengths.front(), lengths[lengths.size() / 2], lengths.back()};
}

/// Fills in what the edges tell; returns how many there are.
std::int64_t measure_edges(const TriMesh& surface, SurfaceShape& shape) {
    const std::vector<Side> sides = sorted_sides(surface.triangles);
    std::vector<double> lengths;
    std::vector<char> on_boundary(surface.points.size(), 0);
    Sets loops(surface.points.size());
    for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
        last = std::find_if(first, sides.end(), [&](const Side& s) {
            return s.low != first->low || s.high != first->high;
        });
        lengths.push_back((surface.points[first->low] - surface.points[first->high]).norm());
        if (last - first == 1) {
            ++shape.boundary_edges;
            on_boundary[first->low] = on_boundary[first->high] = 1;
            loops.join(first->low, first->high);
        } else {
            shape.non_manifold_edges += last - first > 2 || first->forward == first[1].forward;
        }
    }
    shape.boundary_loops = loops.count(on_boundary);
    const auto count = static_cast<std::int64_t>(lengths.size());
    shape.edges = summary(lengths);
    return count;
}

/// The triangles' corners at each point: those of point v are
/// at[start[v]] to at[start[v + 1]], as triangle * 3 + corner.
struct Corners {
    std::vector<std::size_t> start, at;
};
Corners corners_of(const TriMesh& surface) {
    Corners corners;
    corners.start.assign(surface.points.size() + 1, 0);
    for (const Triangle& t : surface.triangles)
        for (const std::int32_t v : t) ++corners.start[v + 1];
    std::partial_sum(corners.start.begin(), corners.start.end(), corners.start.begin());
    corners.at.resize(3 * surface.triangles.size());
    std::vector<std::size_t> next(corners.start.begin(), corners.start.end() - 1);
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) corners.at[next[surface.triangles[f][i]]++] = 3 * f + i;
    return corners;
}

/// Triangles at a point form one fan when those that share an edge there are
/// all connected: joined here through the other end of each edge.
std::int64_t count_bad_points(const TriMesh& surface) {
    const Corners corners = corners_of(surface);
    std::int64_t bad = 0;
    std::vector<std::pair<std::int32_t, std::int32_t>> ends;  // other end, triangle at the point
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
        const std::size_t count = corners.start[v + 1] - corners.start[v];
        if (count < 2) continue;
        ends.clear();
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t corner = corners.at[corners.start[v] + k];
            const Triangle& t = surface.triangles[corner / 3];
            for (const std::size_t step : {1, 2})
                ends.emplace_back(t[(corner + step - corner / 3 * 3) % 3],
                                  static_cast<std::int32_t>(k));
        }
        std::ranges::sort(ends);
        Sets fans(count);
        for (std::size_t i = 1; i < ends.size(); ++i)
            if (ends[i].first == ends[i - 1].first) fans.join(ends[i].second, ends[i - 1].second);
        bad += fans.count(std::vector<char>(count, 1)) > 1;
    }
    return bad;
}

}  // namespace

SurfaceShape measure_surface(const TriMesh& surface) {
    SurfaceShape shape;
    if (surface.triangles.empty()) return shape;
    measure_triangles(surface, shape);
    shape.volume = volume(surface);
    const std::int64_t edges = measure_edges(surface, shape);
    shape.non_manifold_vertices = count_bad_points(surface);
    std::vector<char> used(surface.points.size(), 0);
    Sets parts(surface.points.size());
    for (const Triangle& t : surface.triangles) {
        for (const std::int32_t v : t) used[v] = 1;
        parts.join(t[0], t[1]);
        parts.join(t[0], t[2]);
    }
    shape.components = static_cast<int>(parts.count(used));
    shape.euler_characteristic =
        std::ranges::count(used, 1) - edges + static_cast<std::int64_t>(surface.triangles.size());
    return shape;
}

}  // namespace myotet::quality
