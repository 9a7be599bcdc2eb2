// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ContactPairs.h"

#include <algorithm>
#include <cmath>

#include "Core/Nearest.h"
#include "Core/Parallel.h"

namespace myotet::contraction {
namespace {

constexpr std::size_t kGrain = 64;
// Cells along the longest axis at most: a million take 8 MB.
constexpr int kMostCells = 100;
// Distances this close, in cells, are equal but for rounding.
constexpr double kEqual = 1e-9;

std::array<Vec3, 4> corners(const std::vector<Vec3>& x, const Tet& t) {
    return {x[t[0]], x[t[1]], x[t[2]], x[t[3]]};
}

Box box_of(const std::array<Vec3, 4>& corner) {
    Box box;
    for (const Vec3& c : corner) box.include(c);
    return box;
}

double distance_to(const Box& box, const Vec3& p) {
    return (p - p.cwiseMax(box.min).cwiseMin(box.max)).norm();
}

bool meet(const Box& a, const Box& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

// Tetrahedra by the cells that their boxes touch.
class Grid {
public:
    // Of those that meet the box.
    Grid(const std::vector<Vec3>& x, const std::vector<Tet>& tets, const Box& near) {
        Box all;
        double extent = 0;
        for (std::size_t t = 0; t < tets.size(); ++t) {
            const Box box = box_of(corners(x, tets[t]));
            if (!meet(box, near)) continue;
            tet_.push_back(static_cast<std::int32_t>(t));
            box_.push_back(box);
            all.include(box.min.cwiseMax(near.min));
            all.include(box.max.cwiseMin(near.max));
            extent += box.extent().maxCoeff();
        }
        if (tet_.empty()) return;
        origin_ = all.min;
        side_ = std::max(extent / static_cast<double>(tet_.size()),
                         all.extent().maxCoeff() / kMostCells);
        const Index3 last = cell_of(all.max);
        for (int a = 0; a < 3; ++a) size_[a] = last[a] + 1;
        fill();
    }

    [[nodiscard]] bool empty() const { return tet_.empty(); }
    [[nodiscard]] double side() const { return side_; }

    // Calls visit(tetrahedron, box) for those in cells that are `ring` cells away from p's.
    // False when no cell lies that far out or farther.
    template <class Visit>
    bool visit_ring(const Vec3& p, int ring, const Visit& visit) const {
        const Index3 c = cell_of(p);
        bool any = false;
        Index3 low, high;
        for (int a = 0; a < 3; ++a) {
            any = any || c[a] - ring >= 0 || c[a] + ring < size_[a];
            low[a] = std::max(0, c[a] - ring);
            high[a] = std::min(size_[a] - 1, c[a] + ring);
        }
        for (int k = low[2]; k <= high[2]; ++k)
            for (int j = low[1]; j <= high[1]; ++j) {
                const bool whole = std::abs(k - c[2]) == ring || std::abs(j - c[1]) == ring;
                for (int i = low[0]; i <= high[0]; ++i)
                    if (whole || std::abs(i - c[0]) == ring) visit_cell(i, j, k, visit);
            }
        return any;
    }

private:
    // May lie outside the grid.
    [[nodiscard]] Index3 cell_of(const Vec3& p) const {
        const Vec3 c = ((p - origin_) / side_).array().floor();
        return {static_cast<int>(c.x()), static_cast<int>(c.y()), static_cast<int>(c.z())};
    }
    [[nodiscard]] std::size_t number(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * size_[1] + j) * size_[0] + i;
    }
    template <class Do>
    void each_cell(const Box& box, const Do& act) const {
        const Index3 low = cell_of(box.min), high = cell_of(box.max);
        for (int k = std::max(0, low[2]); k <= std::min(size_[2] - 1, high[2]); ++k)
            for (int j = std::max(0, low[1]); j <= std::min(size_[1] - 1, high[1]); ++j)
                for (int i = std::max(0, low[0]); i <= std::min(size_[0] - 1, high[0]); ++i)
                    act(number(i, j, k));
    }
    void fill() {
        start_.assign(number(0, 0, size_[2]) + 1, 0);
        for (const Box& box : box_) each_cell(box, [&](std::size_t cell) { ++start_[cell + 1]; });
        for (std::size_t c = 0; c + 1 < start_.size(); ++c) start_[c + 1] += start_[c];
        entry_.resize(start_.back());
        std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
        for (std::size_t b = 0; b < box_.size(); ++b)
            each_cell(box_[b], [&](std::size_t cell) { entry_[next[cell]++] = b; });
    }
    template <class Visit>
    void visit_cell(int i, int j, int k, const Visit& visit) const {
        const std::size_t cell = number(i, j, k);
        for (std::size_t e = start_[cell]; e < start_[cell + 1]; ++e)
            visit(tet_[entry_[e]], box_[entry_[e]]);
    }

    Vec3 origin_ = Vec3::Zero();
    double side_ = 1;
    Index3 size_{0, 0, 0};
    std::vector<std::int32_t> tet_;
    std::vector<Box> box_;
    std::vector<std::size_t> start_, entry_;
};

// The best tetrahedron so far.
struct Best {
    double distance = 0, equal = 0;
    double least = 0;  // barycentric coordinate
    std::int32_t tet = -1;

    void offer(std::int32_t t, const std::array<Vec3, 4>& corner, const Vec3& p) {
        if (!(signed_volume(corner[0], corner[1], corner[2], corner[3]) > 0)) return;
        const auto lambda = barycentric(corner, p);
        const double smallest = *std::min_element(lambda.begin(), lambda.end());
        double away = 0;
        if (smallest < 0) {
            away = std::numeric_limits<double>::infinity();
            for (int f = 0; f < 4; ++f) {
                if (lambda[f] >= 0) continue;  // p is not beyond this face
                const Triangle n = face_of({0, 1, 2, 3}, f);
                const Vec3 on =
                    nearest_on_triangle(p, corner[n[0]], corner[n[1]], corner[n[2]]).point;
                away = std::min(away, (p - on).norm());
            }
        }
        const bool nearer = away < distance - equal;
        const bool equal_but_better = away <= distance + equal && tet >= 0 &&
                                      (smallest > least || (smallest == least && t < tet));
        if (!nearer && !equal_but_better && !(tet < 0 && away <= distance)) return;
        distance = std::min(away, distance);
        least = smallest;
        tet = t;
    }
};

}  // namespace

std::array<double, 4> barycentric(const std::array<Vec3, 4>& corner, const Vec3& p) {
    const Vec3 a = corner[1] - corner[0], b = corner[2] - corner[0], c = corner[3] - corner[0],
               q = p - corner[0];
    const double six = a.cross(b).dot(c);
    const double l1 = q.cross(b).dot(c) / six, l2 = a.cross(q).dot(c) / six,
                 l3 = a.cross(b).dot(q) / six;
    return {1 - l1 - l2 - l3, l1, l2, l3};
}

std::vector<std::int32_t> nearest_tets(const std::vector<Vec3>& x,
                                       std::span<const std::int32_t> nodes,
                                       const std::vector<Tet>& tets, double reach) {
    std::vector<std::int32_t> found(nodes.size(), -1);
    Box near;
    for (const std::int32_t n : nodes) near.include(x[n]);
    near.min.array() -= reach;
    near.max.array() += reach;
    const Grid grid(x, tets, near);
    if (grid.empty()) return found;
    parallel_for(0, nodes.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Vec3& p = x[nodes[i]];
            Best best{.distance = reach, .equal = kEqual * grid.side()};
            // What is r rings away is at least r - 1 cells away.
            for (int ring = 0; (ring - 1) * grid.side() <= best.distance; ++ring)
                if (!grid.visit_ring(p, ring, [&](std::int32_t t, const Box& box) {
                        if (distance_to(box, p) <= best.distance + best.equal)
                            best.offer(t, corners(x, tets[t]), p);
                    }))
                    break;
            found[i] = best.tet;
        }
    });
    return found;
}

}  // namespace myotet::contraction
