// SPDX-License-Identifier: Apache-2.0
#include "Play/Proxy.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "Core/Errors.h"

namespace myotet::play {
namespace {

constexpr std::int32_t kLeaf = 4;  // triangles in one, at most
// Of a triangle's area, the part that its centre stands for; its corners share the rest.
constexpr double kCentre = 0.25;

double squared_distance(const Box& box, const Vec3& p) {
    return (p - p.cwiseMax(box.min).cwiseMin(box.max)).squaredNorm();
}

Vec3 cross_of(const std::vector<Vec3>& x, const Triangle& t) {
    return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
}

// Weights of the point of a triangle that is nearest to p, by the region of the plane that p
// lies over; exactly 0 where it is on an edge or at a corner [Ericson 2005, sec. 5.1.5].
std::array<double, 3> nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a;
    const double ab_a = ab.dot(p - a), ac_a = ac.dot(p - a);
    if (ab_a <= 0 && ac_a <= 0) return {1, 0, 0};
    const double ab_b = ab.dot(p - b), ac_b = ac.dot(p - b);
    if (ab_b >= 0 && ac_b <= ab_b) return {0, 1, 0};
    const double ab_c = ab.dot(p - c), ac_c = ac.dot(p - c);
    if (ac_c >= 0 && ab_c <= ac_c) return {0, 0, 1};
    const double of_c = ab_a * ac_b - ab_b * ac_a;
    if (of_c <= 0 && ab_a >= 0 && ab_b <= 0) {
        const double s = ab_a / (ab_a - ab_b);
        return {1 - s, s, 0};
    }
    const double of_b = ab_c * ac_a - ab_a * ac_c;
    if (of_b <= 0 && ac_a >= 0 && ac_c <= 0) {
        const double s = ac_a / (ac_a - ac_c);
        return {1 - s, 0, s};
    }
    const double of_a = ab_b * ac_c - ab_c * ac_b;
    const double to_c = ac_b - ab_b, to_b = ab_c - ac_c;
    if (of_a <= 0 && to_c >= 0 && to_b >= 0) {
        const double s = to_c / (to_c + to_b);
        return {0, 1 - s, s};
    }
    const double sum = of_a + of_b + of_c;
    return {1 - (of_b + of_c) / sum, of_b / sum, of_c / sum};
}

// For each triangle those behind its edges. The surface of tetrahedra may touch itself along an
// edge; then any of the triangles that run the other way serves.
std::vector<Triangle> neighbours_of(const std::vector<Triangle>& triangles) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> by_edge;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int c = 0; c < 3; ++c)
            by_edge[{triangles[t][(c + 1) % 3], triangles[t][(c + 2) % 3]}] =
                static_cast<std::int32_t>(t);
    std::vector<Triangle> neighbours(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int c = 0; c < 3; ++c) {
            const auto found = by_edge.find({triangles[t][(c + 2) % 3], triangles[t][(c + 1) % 3]});
            neighbours[t][c] =
                found == by_edge.end() ? static_cast<std::int32_t>(t) : found->second;
        }
    return neighbours;
}

}  // namespace

Proxy::Proxy(const std::vector<Vec3>& rest, const std::vector<Tet>& tets)
    : triangles_(boundary_faces(tets)), neighbours_(neighbours_of(triangles_)) {
    if (triangles_.empty()) throw MeshError("a body without tetrahedra has no surface");
    for (const Triangle& t : triangles_) nodes_.insert(nodes_.end(), t.begin(), t.end());
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    double edges = 0;
    for (const Triangle& t : triangles_) {
        Triangle own;
        for (int c = 0; c < 3; ++c) {
            own[c] = static_cast<std::int32_t>(
                std::lower_bound(nodes_.begin(), nodes_.end(), t[c]) - nodes_.begin());
            edges += (rest[t[c]] - rest[t[(c + 1) % 3]]).norm();
        }
        local_.push_back(own);
        areas_.push_back(0.5 * cross_of(rest, t).norm());
        order_.push_back(static_cast<std::int32_t>(order_.size()));
    }
    mean_edge_ = edges / (3 * static_cast<double>(triangles_.size()));
    add_samples();
    (void)build(rest, 0, static_cast<std::int32_t>(order_.size()));
    normals_.resize(triangles_.size());
    corner_normals_.resize(nodes_.size());
    follow(rest);
}

void Proxy::add_samples() {
    for (const std::int32_t n : nodes_) samples_.push_back({{n, n, n}, 1, 0});
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (const std::int32_t c : local_[t]) samples_[c].area += (1 - kCentre) / 3 * areas_[t];
        samples_.push_back({triangles_[t], 3, kCentre * areas_[t]});
    }
}

std::int32_t Proxy::build(const std::vector<Vec3>& x, std::int32_t first, std::int32_t last) {
    const auto here = static_cast<std::int32_t>(cells_.size());
    cells_.push_back({.box = {}, .first = first, .last = last});
    if (last - first <= kLeaf) return here;
    const auto centre = [&](std::int32_t t) -> Vec3 {
        const Triangle& n = triangles_[t];
        return x[n[0]] + x[n[1]] + x[n[2]];
    };
    Box centres;
    for (std::int32_t i = first; i < last; ++i) centres.include(centre(order_[i]));
    int axis = 0;
    centres.extent().maxCoeff(&axis);
    const std::int32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::int32_t a, std::int32_t b) {
                         const double at_a = centre(a)[axis], at_b = centre(b)[axis];
                         return at_a < at_b || (at_a == at_b && a < b);
                     });
    (void)build(x, first, middle);
    const std::int32_t right = build(x, middle, last);
    cells_[here].right = right;
    return here;
}

void Proxy::follow(const std::vector<Vec3>& x) {
    std::fill(corner_normals_.begin(), corner_normals_.end(), Vec3::Zero());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const Triangle& n = triangles_[t];
        normals_[t] = cross_of(x, n).normalized();
        for (int c = 0; c < 3; ++c) {
            const Vec3 a = x[n[(c + 1) % 3]] - x[n[c]], b = x[n[(c + 2) % 3]] - x[n[c]];
            const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
            corner_normals_[local_[t][c]] += angle * normals_[t];
        }
    }
    for (std::size_t c = cells_.size(); c-- > 0;) {
        Cell& cell = cells_[c];
        cell.box = {};
        if (cell.right >= 0) {
            for (const Box& half : {cells_[c + 1].box, cells_[cell.right].box}) {
                cell.box.include(half.min);
                cell.box.include(half.max);
            }
            continue;
        }
        for (std::int32_t i = cell.first; i < cell.last; ++i)
            for (const std::int32_t n : triangles_[order_[i]]) cell.box.include(x[n]);
    }
}

Vec3 Proxy::normal_at(const Closest& at) const {
    int zeros = 0, zero = 0, other = 0;
    for (int c = 0; c < 3; ++c) {
        if (at.weight[c] == 0) {
            ++zeros;
            zero = c;
        } else {
            other = c;
        }
    }
    if (zeros == 0) return normals_[at.triangle];
    if (zeros == 1)
        return (normals_[at.triangle] + normals_[neighbours_[at.triangle][zero]]).normalized();
    return corner_normals_[local_[at.triangle][other]].normalized();
}

Closest Proxy::closest(const std::vector<Vec3>& x, const Vec3& p, double reach) const {
    Closest best;
    double squared = reach * reach;
    std::array<std::int32_t, 64> stack{0};
    for (int top = 1; top > 0;) {
        const std::int32_t c = stack[--top];
        const Cell& cell = cells_[c];
        if (squared_distance(cell.box, p) > squared) continue;
        if (cell.right >= 0) {
            const bool right_first = squared_distance(cells_[cell.right].box, p) <
                                     squared_distance(cells_[c + 1].box, p);
            stack[top++] = right_first ? c + 1 : cell.right;
            stack[top++] = right_first ? cell.right : c + 1;
            continue;
        }
        for (std::int32_t i = cell.first; i < cell.last; ++i) {
            const Triangle& n = triangles_[order_[i]];
            const auto w = nearest_weights(p, x[n[0]], x[n[1]], x[n[2]]);
            const Vec3 at = w[0] * x[n[0]] + w[1] * x[n[1]] + w[2] * x[n[2]];
            const double here = (p - at).squaredNorm();
            if (!(here < squared || (here == squared && best.triangle < 0))) continue;
            best.triangle = order_[i];
            best.weight = w;
            best.point = at;
            squared = here;
        }
    }
    if (best.triangle < 0) return best;
    best.outward = normal_at(best);
    best.distance = std::sqrt(squared);
    if (best.outward.dot(p - best.point) < 0) best.distance = -best.distance;
    return best;
}

}  // namespace myotet::play
