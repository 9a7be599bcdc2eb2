// SPDX-License-Identifier: Apache-2.0
#include "Play/Proxy.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "Core/Errors.h"

namespace myotet::play {
namespace {

// Of a triangle's area, the part that its centre stands for; its corners share the rest.
constexpr double kCentre = 0.25;

Vec3 cross_of(const std::vector<Vec3>& x, const Triangle& t) {
    return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
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
    std::vector<Box> boxes;
    std::vector<Vec3> centres;
    for (const Triangle& t : triangles_) {
        boxes.emplace_back();
        for (const std::int32_t n : t) boxes.back().include(rest[n]);
        centres.emplace_back(rest[t[0]] + rest[t[1]] + rest[t[2]]);  // three times, all alike
        Triangle own;
        for (int c = 0; c < 3; ++c) {
            own[c] = static_cast<std::int32_t>(
                std::lower_bound(nodes_.begin(), nodes_.end(), t[c]) - nodes_.begin());
            edges += (rest[t[c]] - rest[t[(c + 1) % 3]]).norm();
        }
        local_.push_back(own);
        areas_.push_back(0.5 * cross_of(rest, t).norm());
    }
    mean_edge_ = edges / (3 * static_cast<double>(triangles_.size()));
    add_samples();
    tree_ = BoxTree(boxes, centres);
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
    tree_.follow([&](std::int32_t i, Box& box) {
        for (const std::int32_t n : triangles_[tree_.order()[i]]) box.include(x[n]);
    });
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
    tree_.near(p, squared, [&](std::int32_t i) {
        const std::int32_t t = tree_.order()[i];
        const Triangle& n = triangles_[t];
        const OnTriangle on = nearest_on_triangle(p, x[n[0]], x[n[1]], x[n[2]]);
        const double here = (p - on.point).squaredNorm();
        if (!(here < squared || (here == squared && best.triangle < 0))) return;
        best.triangle = t;
        best.weight = on.weights;
        best.point = on.point;
        squared = here;
    });
    if (best.triangle < 0) return best;
    best.outward = normal_at(best);
    best.distance = std::sqrt(squared);
    if (best.outward.dot(p - best.point) < 0) best.distance = -best.distance;
    return best;
}

}  // namespace myotet::play
