// SPDX-License-Identifier: Apache-2.0
#include "Surface/Measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "Surface/Crossings.h"

namespace myotet::surface {
namespace {

/// One side of a triangle, from the smaller to the larger point number.
struct Side {
    std::int32_t low = 0, high = 0;
    bool forward = true;  ///< whether the triangle runs it from low to high
    auto operator<=>(const Side&) const = default;
};

/// All triangles' sides; those of one edge stand together.
std::vector<Side> sorted_sides(const TriMesh& mesh) {
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    std::ranges::sort(sides);
    return sides;
}

template <class Use>
void each_edge(const std::vector<Side>& sides, const Use& use) {
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high)
            ++end;
        use(sides[i], static_cast<int>(end - i), sides[end - 1].forward != sides[i].forward);
        i = end;
    }
}

class Pieces {
public:
    explicit Pieces(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
    std::int32_t root(std::int32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::int32_t a, std::int32_t b) { parent_[root(a)] = root(b); }
    /// Of those that are marked.
    int count(const std::vector<char>& marked) {
        int n = 0;
        for (std::size_t i = 0; i < parent_.size(); ++i)
            n += marked[i] && parent_[i] == static_cast<std::int32_t>(i);
        return n;
    }

private:
    std::vector<std::int32_t> parent_;
};

double angle_deg(const Vec3& at, const Vec3& a, const Vec3& b) {
    return std::atan2((a - at).cross(b - at).norm(), (a - at).dot(b - at)) * 180 / std::numbers::pi;
}

void measure_triangles(const TriMesh& mesh, const Field& phi, Quality& q) {
    q.smallest_angle_deg = 180;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        const Vec3 n = double_area(a, b, c);
        q.area += 0.5 * n.norm();
        for (const double angle : angles_deg(a, b, c)) {
            q.smallest_angle_deg = std::min(q.smallest_angle_deg, angle);
            q.largest_angle_deg = std::max(q.largest_angle_deg, angle);
        }
        const auto against = [&](const Vec3& p) { return !(n.dot(phi(p).gradient) > 0); };
        q.triangles_turned_over +=
            against((a + b + c) / 3) && against(a) && against(b) && against(c);
    }
}

/// Whether the triangles around each point are one fan, told by joining the
/// corners of triangles at a point across the edges they share.
std::int64_t count_bad_points(const TriMesh& mesh) {
    Fans fans = make_fans(mesh);
    std::int64_t bad = 0;
    for (std::size_t v = 0; v < fans.points.size(); ++v) {
        const auto& around = fans.around[v];
        if (around.empty()) continue;
        Pieces pieces(around.size());
        for (std::size_t i = 0; i < around.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                int shared = 0;
                for (const std::int32_t n : fans.triangles[around[i]])
                    shared += std::ranges::count(fans.triangles[around[j]], n) > 0;
                if (shared > 1)
                    pieces.join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
            }
        bad += pieces.count(std::vector<char>(around.size(), 1)) > 1;
    }
    return bad;
}

struct Edges {
    std::int64_t count = 0;
    std::vector<double> lengths;
    std::vector<Side> boundary;
    std::vector<char> on_boundary;
};

Edges measure_edges(const TriMesh& mesh, Quality& q) {
    Edges edges;
    edges.on_boundary.assign(mesh.points.size(), 0);
    const std::vector<Side> sides = sorted_sides(mesh);
    each_edge(sides, [&](const Side& s, int triangles, bool both_ways) {
        ++edges.count;
        edges.lengths.push_back((mesh.points[s.low] - mesh.points[s.high]).norm());
        if (triangles == 1) {
            edges.boundary.push_back(s);
            edges.on_boundary[s.low] = edges.on_boundary[s.high] = 1;
        } else {
            q.bad_edges += triangles > 2 || !both_ways;
        }
    });
    each_edge(sides, [&](const Side& s, int triangles, bool) {
        q.inner_edges_joining_boundary_points +=
            triangles > 1 && edges.on_boundary[s.low] && edges.on_boundary[s.high];
    });
    std::ranges::sort(edges.lengths);
    if (!edges.lengths.empty()) {
        q.shortest_edge = edges.lengths.front();
        q.median_edge = edges.lengths[edges.lengths.size() / 2];
        q.longest_edge = edges.lengths.back();
    }
    return edges;
}

void measure_boundary(const TriMesh& mesh, const Guide& guide, const Edges& edges, Quality& q) {
    Pieces loops(mesh.points.size());
    std::vector<double> lengths(mesh.points.size(), 0);
    for (const Side& s : edges.boundary) {
        const double length = (mesh.points[s.low] - mesh.points[s.high]).norm();
        q.boundary_length += length;
        loops.join(s.low, s.high);
        lengths[s.low] += 0.5 * length;
        lengths[s.high] += 0.5 * length;
    }
    q.boundary_loops = loops.count(edges.on_boundary);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if (!edges.on_boundary[v]) continue;
        ++q.boundary_points;
        double off = std::abs(guide.phi(mesh.points[v]).value);
        if (guide.trim) off = std::max(off, std::abs(guide.trim(mesh.points[v]).value));
        q.boundary_off_in_edges = std::max(q.boundary_off_in_edges, off / lengths[v]);
    }
}

void measure_distance(const TriMesh& mesh, const Field& phi, Quality& q) {
    double sum = 0;
    std::int64_t count = 0;
    const auto at = [&](const Vec3& p) {
        const double off = std::abs(phi(p).value);
        sum += off;
        ++count;
        q.max_distance = std::max(q.max_distance, off);
        return off;
    };
    for (const Vec3& p : mesh.points) q.points_off = std::max(q.points_off, at(p));
    for (const Triangle& t : mesh.triangles) {
        at((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3);
        for (int i = 0; i < 3; ++i)
            if (t[i] < t[(i + 1) % 3]) at(0.5 * (mesh.points[t[i]] + mesh.points[t[(i + 1) % 3]]));
    }
    q.mean_distance = count > 0 ? sum / static_cast<double>(count) : 0;
}

void say(std::vector<std::string>& sentences, const char* form, double value, double limit) {
    char text[160];
    std::snprintf(text, sizeof text, form, value, limit);
    sentences.emplace_back(text);
}

}  // namespace

Quality measure(const TriMesh& mesh, const Guide& guide) {
    Quality q;
    q.points = mesh.points.size();
    q.triangles = mesh.triangles.size();
    if (mesh.triangles.empty()) return q;
    measure_triangles(mesh, guide.phi, q);
    const Edges edges = measure_edges(mesh, q);
    q.bad_points = count_bad_points(mesh);
    q.euler_characteristic =
        static_cast<std::int64_t>(q.points) - edges.count + static_cast<std::int64_t>(q.triangles);
    q.pieces = count_pieces(mesh);
    q.crossing_triangles = static_cast<std::int64_t>(crossings(mesh.points, mesh.triangles).size());
    measure_boundary(mesh, guide, edges, q);
    measure_distance(mesh, guide.phi, q);
    return q;
}

std::array<double, 3> angles_deg(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {angle_deg(a, b, c), angle_deg(b, c, a), angle_deg(c, a, b)};
}

int count_pieces(const TriMesh& mesh) {
    Pieces pieces(mesh.points.size());
    std::vector<char> used(mesh.points.size(), 0);
    for (const Triangle& t : mesh.triangles) {
        pieces.join(t[0], t[1]);
        pieces.join(t[0], t[2]);
        for (const std::int32_t v : t) used[v] = 1;
    }
    // A root may be any point of its piece, and is used as all of them are.
    return pieces.count(used);
}

double median_edge(const TriMesh& mesh) {
    std::vector<double> lengths;
    each_edge(sorted_sides(mesh), [&](const Side& s, int, bool) {
        lengths.push_back((mesh.points[s.low] - mesh.points[s.high]).norm());
    });
    if (lengths.empty()) return 0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    return *middle;
}

std::vector<std::string> broken_promises(const Quality& q) {
    std::vector<std::string> sentences;
    const auto promise = [&](std::int64_t count, const char* what) {
        if (count > 0) sentences.push_back(std::to_string(count) + " " + what);
    };
    promise(q.bad_edges, "edges are not manifold");
    promise(q.bad_points, "points are not manifold");
    promise(q.triangles_turned_over, "triangles are turned over");
    promise(q.crossing_triangles, "pairs of triangles cross");
    return sentences;
}

std::vector<std::string> shortfalls(const Quality& q) {
    std::vector<std::string> sentences;
    if (!(q.smallest_angle_deg >= kSmallestAngle))
        say(sentences, "the smallest angle is %.1f degrees, below %.0f", q.smallest_angle_deg,
            kSmallestAngle);
    if (!(q.largest_angle_deg <= kLargestAngle))
        say(sentences, "the largest angle is %.1f degrees, above %.0f", q.largest_angle_deg,
            kLargestAngle);
    if (!(q.points_off <= kPointsOff * q.median_edge))
        say(sentences, "a point is %.3f mm off the surface, above %.3f", q.points_off,
            kPointsOff * q.median_edge);
    if (!(q.boundary_off_in_edges <= kBoundaryOff))
        say(sentences, "a point of the boundary is %.3f of an edge off its surfaces, above %.2f",
            q.boundary_off_in_edges, kBoundaryOff);
    return sentences;
}

}  // namespace myotet::surface
