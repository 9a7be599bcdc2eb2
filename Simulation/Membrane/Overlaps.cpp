// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Overlaps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace myotet::membrane {

namespace {

constexpr double kRounding = 1e-9;  // of a triangle's size

struct Corners {
    Vec3 a, b, c, normal;
    Box box;
    double size = 0;
};

bool in_plane_of(const Corners& t, const Vec3& p) {
    return std::abs(t.normal.dot(p - t.a)) <= kRounding * t.size;
}

// Whether no edge of t separates the two within the plane.
bool overlaps_beside_edges_of(const Corners& t, const Corners& other) {
    const std::array<Vec3, 3> corners{t.a, t.b, t.c};
    for (int i = 0; i < 3; ++i) {
        const Vec3 out = (corners[(i + 1) % 3] - corners[i]).cross(t.normal).normalized();
        const double nearest =
            std::min({out.dot(other.a - corners[i]), out.dot(other.b - corners[i]),
                      out.dot(other.c - corners[i])});
        if (nearest >= -kRounding * t.size) return false;
    }
    return true;
}

bool overlap(const Corners& s, const Corners& t) {
    if ((s.box.min.array() > t.box.max.array()).any() ||
        (t.box.min.array() > s.box.max.array()).any())
        return false;
    for (const Vec3& p : {t.a, t.b, t.c})
        if (!in_plane_of(s, p)) return false;
    return overlaps_beside_edges_of(s, t) && overlaps_beside_edges_of(t, s);
}

}  // namespace

std::optional<std::array<std::int32_t, 2>> overlap_in_plane(const TriMesh& surface) {
    std::vector<Corners> triangles;
    for (const auto& [i, j, k] : surface.triangles) {
        Corners t{surface.points[i], surface.points[j], surface.points[k], {}, {}, 0};
        for (const Vec3& p : {t.a, t.b, t.c}) t.box.include(p);
        t.normal = (t.b - t.a).cross(t.c - t.a).normalized();
        t.size = t.box.diagonal();
        triangles.push_back(t);
    }
    std::vector<std::int32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](auto f) { return triangles[f].box.min.x(); });
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const Corners &s = triangles[order[i]], &t = triangles[order[j]];
            if (t.box.min.x() > s.box.max.x()) break;
            if (overlap(s, t))
                return std::array{std::min(order[i], order[j]), std::max(order[i], order[j])};
        }
    return std::nullopt;
}

}  // namespace myotet::membrane
