// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/WindingTree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace myotet::levelset {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr std::int32_t kLeaf = 6;  // triangles
// Nodes this many radii away count by their expansion; its error falls with
// the cube of this.
constexpr double kFar = 3;
constexpr double kFullAngle = 4 * std::numbers::pi;

Vec3 middle(const Corners& t) { return (t[0] + t[1] + t[2]) / 3; }
Vec3 area_vector(const Corners& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]); }

/// Splits triangles in the middle along the longest side of their middles' box.
std::int32_t split(const std::vector<Vec3>& middles, std::vector<std::int32_t>& order,
                   std::int32_t first, std::int32_t count) {
    Box box;
    for (std::int32_t n = first; n < first + count; ++n) box.include(middles[order[n]]);
    int axis = 0;
    box.extent().maxCoeff(&axis);
    const auto begin = order.begin() + first, half = begin + count / 2;
    std::nth_element(begin, half, begin + count, [&](std::int32_t a, std::int32_t b) {
        const double x = middles[a][axis], y = middles[b][axis];
        return x != y ? x < y : a < b;
    });
    return count / 2;
}

/// What is to be known of the node's triangles from afar.
void summarise(const std::vector<Corners>& corners, WindingTree::Node& node) {
    double area = 0;
    Vec3 weighted = Vec3::Zero();
    const auto each = [&](auto&& visit) {
        for (std::int32_t n = node.first; n < node.first + node.count; ++n) visit(corners[n]);
    };
    each([&](const Corners& t) {
        for (const Vec3& p : t) node.box.include(p);
        const double a = area_vector(t).norm();
        area += a;
        weighted += a * middle(t);
    });
    node.centre = area > 0 ? Vec3(weighted / area) : node.box.centre();
    each([&](const Corners& t) {
        node.dipole += area_vector(t);
        node.moment += area_vector(t) * (middle(t) - node.centre).transpose();
        for (const Vec3& p : t) node.radius = std::max(node.radius, (p - node.centre).norm());
    });
}

/// Solid angle of a triangle over 4 pi (Van Oosterom, Strackee 1983).
double share_of_sphere(const Corners& t, const Vec3& point) {
    const Vec3 a = t[0] - point, b = t[1] - point, c = t[2] - point;
    const double det = a.dot(b.cross(c));
    if (det == 0) return 0;  // in its plane; on the triangle itself, between its two sides
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    return 2 * std::atan2(det, below) / kFullAngle;
}

/// With r from the point to the node's centre and G(r) = r / (4 pi |r|^3):
/// dipole . G(r) + moment : grad G(r) [Barill et al. 2018, sec. 3].
double far_share(const WindingTree::Node& node, const Vec3& r) {
    const double squared = r.squaredNorm(), cubed = squared * std::sqrt(squared);
    return (node.dipole.dot(r) + node.moment.trace() - 3 * r.dot(node.moment * r) / squared) /
           (kFullAngle * cubed);
}

}  // namespace

WindingTree build_winding_tree(const TriMesh& surface) {
    WindingTree tree;
    const auto count = static_cast<std::int32_t>(surface.triangles.size());
    if (count == 0) return tree;
    std::vector<Vec3> middles(count);
    std::vector<Corners> corners(count);
    for (std::int32_t n = 0; n < count; ++n) {
        for (int c = 0; c < 3; ++c) corners[n][c] = surface.points[surface.triangles[n][c]];
        middles[n] = middle(corners[n]);
    }
    tree.order.resize(count);
    std::iota(tree.order.begin(), tree.order.end(), 0);
    tree.nodes.push_back({.first = 0, .count = count});
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
        const std::int32_t first = tree.nodes[n].first, size = tree.nodes[n].count;
        if (size <= kLeaf) continue;
        const std::int32_t low = split(middles, tree.order, first, size);
        tree.nodes[n].child = static_cast<std::int32_t>(tree.nodes.size());
        tree.nodes.push_back({.first = first, .count = low});
        tree.nodes.push_back({.first = first + low, .count = size - low});
    }
    tree.corners.reserve(count);
    for (const std::int32_t t : tree.order) tree.corners.push_back(corners[t]);
    for (WindingTree::Node& node : tree.nodes) summarise(tree.corners, node);
    return tree;
}

double winding_number(const WindingTree& tree, const Vec3& point) {
    if (tree.nodes.empty()) return 0;
    double sum = 0;
    std::array<std::int32_t, 64> stack{};  // a tree of 2^31 triangles is 29 levels deep
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const WindingTree::Node& node = tree.nodes[stack[--depth]];
        const Vec3 r = node.centre - point;
        if (r.squaredNorm() > kFar * kFar * node.radius * node.radius) {
            sum += far_share(node, r);
        } else if (node.child >= 0) {
            stack[depth++] = node.child;
            stack[depth++] = node.child + 1;
        } else {
            for (std::int32_t n = node.first; n < node.first + node.count; ++n)
                sum += share_of_sphere(tree.corners[n], point);
        }
    }
    return sum;
}

double exact_winding_number(const WindingTree& tree, const Vec3& point) {
    double sum = 0;
    for (const Corners& t : tree.corners) sum += share_of_sphere(t, point);
    return sum;
}

}  // namespace myotet::levelset
