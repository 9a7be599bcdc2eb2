// SPDX-License-Identifier: Apache-2.0
// Distances to the triangles of a tree, and what crosses them.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "Core/Nearest.h"
#include "Core/Parallel.h"
#include "LevelSet/WindingTree.h"

namespace myotet::levelset {
namespace {

using Corners = std::array<Vec3, 3>;

Vec3 nearest_on(const Corners& t, const Vec3& p) {
    return nearest_on_triangle(p, t[0], t[1], t[2]).point;
}

bool overlap(const Box& a, const Box& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

/// Möller, Trumbore 1997; touching at the rim counts, parallel does not.
bool crosses(const Corners& t, const Vec3& a, const Vec3& b) {
    const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0], along = b - a;
    const Vec3 h = along.cross(e2);
    const double det = e1.dot(h);
    if (!(std::abs(det) > 0)) return false;
    const Vec3 s = a - t[0];
    const double u = s.dot(h) / det;
    if (!(u >= 0 && u <= 1)) return false;
    const Vec3 q = s.cross(e1);
    const double v = along.dot(q) / det;
    if (!(v >= 0 && u + v <= 1)) return false;
    const double where = e2.dot(q) / det;
    return where >= 0 && where <= 1;
}

/// Calls visit(n) for the triangles of all leaves whose box meets `box`, until
/// it returns true; says whether it did.
template <class Visit>
bool each_near(const WindingTree& tree, const Box& box, Visit&& visit) {
    if (tree.nodes.empty()) return false;
    std::array<std::int32_t, 64> stack{};
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const WindingTree::Node& node = tree.nodes[stack[--depth]];
        if (!overlap(node.box, box)) continue;
        if (node.child >= 0) {
            stack[depth++] = node.child + 1;
            stack[depth++] = node.child;
            continue;
        }
        for (std::int32_t n = node.first; n < node.first + node.count; ++n)
            if (visit(n)) return true;
    }
    return false;
}

bool cross_each_other(const Corners& s, const Corners& t) {
    for (int c = 0; c < 3; ++c)
        if (crosses(t, s[c], s[(c + 1) % 3]) || crosses(s, t[c], t[(c + 1) % 3])) return true;
    return false;
}

bool share_corner(const Corners& s, const Corners& t) {
    for (const Vec3& p : s)
        for (const Vec3& q : t)
            if (p == q) return true;
    return false;
}

}  // namespace

double distance_to_triangles(const WindingTree& tree, const Vec3& point, double bound,
                             std::span<const std::uint8_t> mask) {
    double best = bound * bound;
    if (tree.nodes.empty() || !(squared_distance(tree.nodes[0].box, point) < best)) return bound;
    std::array<std::pair<double, std::int32_t>, 64> stack;
    int depth = 0;
    stack[depth++] = {0, 0};
    while (depth > 0) {
        const auto [away, at] = stack[--depth];
        if (!(away < best)) continue;
        const WindingTree::Node& node = tree.nodes[at];
        if (node.child < 0) {
            for (std::int32_t n = node.first; n < node.first + node.count; ++n)
                if (mask.empty() || mask[tree.order[n]] != 0)
                    best =
                        std::min(best, (nearest_on(tree.corners[n], point) - point).squaredNorm());
            continue;
        }
        std::pair<double, std::int32_t> near{squared_distance(tree.nodes[node.child].box, point),
                                             node.child};
        std::pair<double, std::int32_t> far{squared_distance(tree.nodes[node.child + 1].box, point),
                                            node.child + 1};
        if (far.first < near.first) std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
    }
    return best < bound * bound ? std::sqrt(best) : bound;
}

bool crosses_triangle(const WindingTree& tree, const Vec3& a, const Vec3& b,
                      std::span<const std::uint8_t> mask) {
    Box box;
    box.include(a);
    box.include(b);
    return each_near(tree, box, [&](std::int32_t n) {
        return (mask.empty() || mask[tree.order[n]] != 0) && crosses(tree.corners[n], a, b);
    });
}

std::int64_t count_crossing_pairs(const WindingTree& tree) {
    std::atomic<std::int64_t> pairs = 0;
    parallel_for(0, tree.corners.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            const Corners& t = tree.corners[n];
            Box box;
            for (const Vec3& p : t) box.include(p);
            (void)each_near(tree, box, [&](std::int32_t m) {
                const Corners& s = tree.corners[m];
                if (static_cast<std::size_t>(m) > n && !share_corner(s, t) &&
                    cross_each_other(s, t))
                    ++pairs;
                return false;
            });
        }
    });
    return pairs;
}

}  // namespace myotet::levelset
