// SPDX-License-Identifier: Apache-2.0
#include "Cage/TetTree.h"

#include <Eigen/LU>
#include <algorithm>
#include <string>

#include "Core/Errors.h"

namespace myotet::cage {
namespace {

// A point counts as inside when no weight is below minus this: rounding, on shared faces.
constexpr double kRounding = 1e-12;

double least(const Weights& weights) { return *std::min_element(weights.begin(), weights.end()); }

// Of a point that is beyond some faces: the nearest point lies on one of those.
double squared_distance(const std::array<Vec3, 4>& corner, const Weights& weights, const Vec3& p) {
    double nearest = least(weights) < 0 ? std::numeric_limits<double>::infinity() : 0;
    for (int f = 0; f < 4; ++f) {
        if (weights[f] >= 0) continue;
        const Triangle n = face_of({0, 1, 2, 3}, f);
        nearest = std::min(
            nearest, (p - nearest_on_triangle(p, corner[n[0]], corner[n[1]], corner[n[2]]).point)
                         .squaredNorm());
    }
    return nearest;
}

}  // namespace

TetTree::TetTree(std::span<const Vec3> points, std::span<const Tet> tets) {
    if (tets.empty()) throw MeshError("the mesh has no tetrahedra, but points are to lie in them");
    std::vector<Box> boxes(tets.size());
    std::vector<Vec3> centres;
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
        centres.push_back(boxes[t].centre());
    }
    tree_ = BoxTree(boxes, centres);
}

Weights TetTree::weights(std::int32_t tet, const Vec3& p) const {
    const Vec3 w = tets_[tet].inverse * (p - tets_[tet].corner[0]);
    return {1 - w.x() - w.y() - w.z(), w.x(), w.y(), w.z()};
}

Holder TetTree::find(const Vec3& p) const {
    Holder best;
    double best_least = -kRounding;
    tree_.walk(
        [&](const Box& box) {
            return (p.array() < box.min.array()).any() || (p.array() > box.max.array()).any();
        },
        [&](std::int32_t i) {
            const std::int32_t t = tree_.order()[i];
            const Weights w = weights(t, p);
            const double here = least(w);
            const bool better = here > best_least || (here == best_least && t < best.tet);
            if (here >= -kRounding && (best.tet < 0 || better)) {
                best = {t, w, 0};
                best_least = here;
            }
            return false;
        });
    return best.tet >= 0 ? best : nearest(p);
}

Holder TetTree::nearest(const Vec3& p) const {
    Holder best;
    double squared = std::numeric_limits<double>::infinity(), best_least = 0;
    tree_.near(p, squared, [&](std::int32_t i) {
        const std::int32_t t = tree_.order()[i];
        const Weights w = weights(t, p);
        const double away = squared_distance(tets_[t].corner, w, p), here = least(w);
        const bool better =
            away < squared ||
            (away == squared && (here > best_least || (here == best_least && t < best.tet)));
        if (best.tet >= 0 && !better) return;
        best = {t, w, 0};
        squared = away;
        best_least = here;
    });
    best.distance = std::sqrt(squared);
    return best;
}

}  // namespace myotet::cage
