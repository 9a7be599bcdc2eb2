// SPDX-License-Identifier: Apache-2.0
#include "Cage/TetTree.h"

#include <Eigen/LU>
#include <algorithm>
#include <string>

#include "Core/Errors.h"

namespace myotet::cage {
namespace {

constexpr std::int32_t kLeaf = 4;  // tetrahedra in one, at most
// A point counts as inside when no weight is below minus this: rounding, on shared faces.
constexpr double kRounding = 1e-12;

double squared_distance(const Box& box, const Vec3& p) {
    return (p - p.cwiseMax(box.min).cwiseMin(box.max)).squaredNorm();
}

// By the region of the plane that p lies over: a corner's, an edge's or the triangle's own
// [Ericson 2005, sec. 5.1.5].
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a;
    const double ab_a = ab.dot(p - a), ac_a = ac.dot(p - a);
    if (ab_a <= 0 && ac_a <= 0) return a;
    const double ab_b = ab.dot(p - b), ac_b = ac.dot(p - b);
    if (ab_b >= 0 && ac_b <= ab_b) return b;
    const double ab_c = ab.dot(p - c), ac_c = ac.dot(p - c);
    if (ac_c >= 0 && ab_c <= ac_c) return c;
    const double of_c = ab_a * ac_b - ab_b * ac_a;
    if (of_c <= 0 && ab_a >= 0 && ab_b <= 0) return a + ab_a / (ab_a - ab_b) * ab;
    const double of_b = ab_c * ac_a - ab_a * ac_c;
    if (of_b <= 0 && ac_a >= 0 && ac_c <= 0) return a + ac_a / (ac_a - ac_c) * ac;
    const double of_a = ab_b * ac_c - ab_c * ac_b;
    const double to_c = ac_b - ab_b, to_b = ab_c - ac_c;
    if (of_a <= 0 && to_c >= 0 && to_b >= 0) return b + to_c / (to_c + to_b) * (c - b);
    const double sum = of_a + of_b + of_c;
    return a + of_b / sum * ab + of_c / sum * ac;
}

double least(const Weights& weights) { return *std::min_element(weights.begin(), weights.end()); }

// Of a point that is beyond some faces: the nearest point lies on one of those.
double squared_distance(const std::array<Vec3, 4>& corner, const Weights& weights, const Vec3& p) {
    double nearest = least(weights) < 0 ? std::numeric_limits<double>::infinity() : 0;
    for (int f = 0; f < 4; ++f) {
        if (weights[f] >= 0) continue;
        const Triangle n = face_of({0, 1, 2, 3}, f);
        nearest = std::min(
            nearest,
            (p - nearest_on_triangle(p, corner[n[0]], corner[n[1]], corner[n[2]])).squaredNorm());
    }
    return nearest;
}

}  // namespace

TetTree::TetTree(std::span<const Vec3> points, std::span<const Tet> tets) {
    if (tets.empty()) throw MeshError("the mesh has no tetrahedra, but points are to lie in them");
    std::vector<Box> boxes(tets.size());
    for (std::size_t t = 0; t < tets.size(); ++t) {
        Edges edges;
        for (int c = 0; c < 4; ++c) {
            const std::int32_t n = tets[t][c];
            if (n < 0 || n >= static_cast<std::int32_t>(points.size()))
                throw MeshError("tetrahedron " + std::to_string(t) + " names point " +
                                std::to_string(n) + ", but there are " +
                                std::to_string(points.size()));
            edges.corner[c] = points[n];
            boxes[t].include(points[n]);
        }
        const auto& x = edges.corner;
        if (!(signed_volume(x[0], x[1], x[2], x[3]) > 0))
            throw MeshError("tetrahedron " + std::to_string(t) +
                            " is flat or inverted, but points lie in positive ones; mend the mesh");
        Mat3 by_columns;
        for (int c = 0; c < 3; ++c) by_columns.col(c) = x[c + 1] - x[0];
        edges.inverse = by_columns.inverse();
        tets_.push_back(edges);
        order_.push_back(static_cast<std::int32_t>(t));
    }
    (void)build(boxes, 0, static_cast<std::int32_t>(order_.size()));
}

std::int32_t TetTree::build(std::span<const Box> boxes, std::int32_t first, std::int32_t last) {
    const auto here = static_cast<std::int32_t>(cells_.size());
    Cell cell{.first = first, .last = last};
    Box centres;
    for (std::int32_t i = first; i < last; ++i) {
        const Box& box = boxes[order_[i]];
        cell.box.include(box.min);
        cell.box.include(box.max);
        centres.include(box.centre());
    }
    cells_.push_back(cell);
    if (last - first <= kLeaf) return here;
    int axis = 0;
    centres.extent().maxCoeff(&axis);
    const std::int32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::int32_t a, std::int32_t b) {
                         const double at_a = boxes[a].centre()[axis],
                                      at_b = boxes[b].centre()[axis];
                         return at_a < at_b || (at_a == at_b && a < b);
                     });
    (void)build(boxes, first, middle);
    const std::int32_t right = build(boxes, middle, last);
    cells_[here].right = right;
    return here;
}

Weights TetTree::weights(std::int32_t tet, const Vec3& p) const {
    const Vec3 w = tets_[tet].inverse * (p - tets_[tet].corner[0]);
    return {1 - w.x() - w.y() - w.z(), w.x(), w.y(), w.z()};
}

Holder TetTree::find(const Vec3& p) const {
    Holder best;
    double best_least = -kRounding;
    std::array<std::int32_t, 64> stack{0};  // as deep as 2^60 tetrahedra
    for (int top = 1; top > 0;) {
        const std::int32_t c = stack[--top];
        const Cell& cell = cells_[c];
        if ((p.array() < cell.box.min.array()).any() || (p.array() > cell.box.max.array()).any())
            continue;
        if (cell.right >= 0) {
            stack[top++] = cell.right;
            stack[top++] = c + 1;
            continue;
        }
        for (std::int32_t i = cell.first; i < cell.last; ++i) {
            const Weights w = weights(order_[i], p);
            const double here = least(w);
            const bool better = here > best_least || (here == best_least && order_[i] < best.tet);
            if (!(here >= -kRounding) || (best.tet >= 0 && !better)) continue;
            best = {order_[i], w, 0};
            best_least = here;
        }
    }
    return best.tet >= 0 ? best : nearest(p);
}

Holder TetTree::nearest(const Vec3& p) const {
    Holder best;
    double squared = std::numeric_limits<double>::infinity(), best_least = 0;
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
            const Weights w = weights(order_[i], p);
            const double away = squared_distance(tets_[order_[i]].corner, w, p), here = least(w);
            const bool better = away < squared ||
                                (away == squared && (here > best_least ||
                                                     (here == best_least && order_[i] < best.tet)));
            if (best.tet >= 0 && !better) continue;
            best = {order_[i], w, 0};
            squared = away;
            best_least = here;
        }
    }
    best.distance = std::sqrt(squared);
    return best;
}

}  // namespace myotet::cage
