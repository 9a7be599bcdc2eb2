// SPDX-License-Identifier: Apache-2.0
#include "Cage/SurfaceTree.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"

namespace myotet::cage {
namespace {

// Far above what rounding does to a plane's distance, far below what culling gains by.
constexpr double kSlack = 1e-9;

/// A half-space that a convex body lies in: normal . x <= offset, the normal of length 1.
struct Side {
    Vec3 normal, size;  // size: of the normal's components
    double offset = 0;
    Side() = default;
    Side(const Vec3& n, const Vec3& at)
        : normal(n),
          size(n.cwiseAbs()),
          offset(n.dot(at) + kSlack * (1 + n.cwiseAbs().dot(at.cwiseAbs()))) {}
    /// Whether a box lies beyond, for sure.
    [[nodiscard]] bool excludes(const Box& box) const {
        const Vec3 centre = 0.5 * (box.min + box.max), half = 0.5 * (box.max - box.min);
        return normal.dot(centre) - size.dot(half) > offset + kSlack * size.dot(centre.cwiseAbs());
    }
};

bool apart(const Box& a, const Box& b) {
    return a.min[0] > b.max[0] || b.min[0] > a.max[0] || a.min[1] > b.max[1] ||
           b.min[1] > a.max[1] || a.min[2] > b.max[2] || b.min[2] > a.max[2];
}

template <int N>
struct Convex {
    Box box;
    std::array<Side, N> sides;
    [[nodiscard]] bool misses(const Box& other) const {
        if (apart(box, other)) return true;
        for (const Side& s : sides)
            if (s.excludes(other)) return true;
        return false;
    }
};

// The plane from both sides, and the planes through the edges across it.
Convex<5> convex(const Corners3& t) {
    Convex<5> c;
    for (const Vec3& p : t) c.box.include(p);
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    c.sides[0] = {n, t[0]};
    c.sides[1] = {-n, t[0]};
    for (int i = 0; i < 3; ++i) {
        const Vec3& a = t[i];
        c.sides[2 + i] = {(t[(i + 1) % 3] - a).cross(n).normalized(), a};
    }
    return c;
}

Convex<4> convex(const Corners4& t) {
    Convex<4> c;
    for (const Vec3& p : t) c.box.include(p);
    for (int f = 0; f < 4; ++f) {
        const Triangle n = face_of({0, 1, 2, 3}, f);
        const Vec3& a = t[n[0]];
        c.sides[f] = {(t[n[1]] - a).cross(t[n[2]] - a).normalized(), a};
    }
    return c;
}

Box box_of(const Corners3& t) {
    return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
}

Vec3 nearest_on(const Corners3& t, const Vec3& p) {
    return nearest_on_triangle(p, t[0], t[1], t[2]).point;
}

}  // namespace

SurfaceTree::SurfaceTree(const TriMesh& surface) {
    const std::size_t count = surface.triangles.size();
    if (count == 0) throw MeshError("the surface has no triangles, but a cage is to enclose it");
    std::vector<Corners3> all(count);
    std::vector<Box> boxes(count);
    std::vector<Vec3> centres(count);
    for (std::size_t t = 0; t < count; ++t) {
        for (int i = 0; i < 3; ++i) all[t][i] = surface.points[surface.triangles[t][i]];
        boxes[t] = box_of(all[t]);
        centres[t] = boxes[t].centre();
    }
    tree_ = BoxTree(boxes, centres);
    corners_.resize(count);
    slot_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        corners_[i] = all[tree_.order()[i]];
        slot_[tree_.order()[i]] = static_cast<std::int32_t>(i);
    }
}

std::int32_t SurfaceTree::meets(const Corners3& triangle, std::int32_t hint) const {
    if (hint >= 0 && triangles_meet(triangle, corners(hint))) return hint;
    const Convex<5> query = convex(triangle);
    std::int32_t found = -1;
    tree_.walk(
        [&](const Box& box) { return query.misses(box); },
        [&](std::int32_t i) {
            if (apart(query.box, box_of(corners_[i])) || !triangles_meet(triangle, corners_[i]))
                return false;
            found = tree_.order()[i];
            return true;
        });
    return found;
}

bool SurfaceTree::meets(const Corners4& tet) const {
    const Convex<4> query = convex(tet);
    bool found = false;
    tree_.walk([&](const Box& box) { return query.misses(box); },
               [&](std::int32_t i) { return found = cage::meets(tet, corners_[i]); });
    return found;
}

void SurfaceTree::boxes_touching(const Corners3& triangle, std::vector<std::int32_t>& found) const {
    found.clear();
    const Box reach = box_of(triangle);
    tree_.walk([&](const Box& box) { return apart(reach, box); },
               [&](std::int32_t i) {
                   if (!apart(reach, box_of(corners_[i]))) found.push_back(tree_.order()[i]);
                   return false;
               });
}

std::optional<Nearest> SurfaceTree::nearest(const Vec3& p, double bound, std::int32_t hint) const {
    Nearest best;
    double squared = bound * bound;
    const auto look = [&](std::int32_t i) {
        const Vec3 q = nearest_on(corners_[i], p);
        const double here = (q - p).squaredNorm();
        if (here > squared || (here == squared && best.triangle >= 0)) return;
        squared = here;
        best = {tree_.order()[i], q, std::sqrt(here)};
    };
    if (hint >= 0) look(slot_[hint]);
    tree_.near(p, squared, look);
    if (best.triangle < 0) return std::nullopt;
    return best;
}

bool SurfaceTree::within(const Vec3& p, double bound, std::int32_t hint) const {
    const double squared = bound * bound;
    const auto near = [&](std::int32_t i) {
        return (nearest_on(corners_[i], p) - p).squaredNorm() <= squared;
    };
    if (hint >= 0 && near(slot_[hint])) return true;
    bool found = false;
    tree_.walk([&](const Box& box) { return squared_distance(box, p) > squared; },
               [&](std::int32_t i) { return found = near(i); });
    return found;
}

int SurfaceTree::winding(const Vec3& p) const {
    // Towards a place far outside; another one when the segment touches an edge or a corner.
    const Vec3 size = box().extent() + Vec3::Constant(1);
    for (int attempt = 0; attempt < 100; ++attempt) {
        const double turn = 0.7548776662466927 * attempt, lean = 0.5698402909980532 * attempt;
        const Vec3 far = box().max + size.cwiseProduct(
                                         Vec3(1, turn - std::floor(turn), lean - std::floor(lean)));
        Box reach;
        reach.include(p);
        reach.include(far);
        const Vec3 along = (far - p).normalized();
        const Vec3 across = along.unitOrthogonal(), third = along.cross(across);
        const std::array<Side, 4> tube{Side(across, p), Side(-across, p), Side(third, p),
                                       Side(-third, p)};
        int count = 0;
        bool doubtful = false;
        tree_.walk(
            [&](const Box& box) {
                if (apart(reach, box)) return true;
                for (const Side& s : tube)
                    if (s.excludes(box)) return true;
                return false;
            },
            [&](std::int32_t i) {
                if (flat(corners_[i])) return false;
                count += passes(p, far, corners_[i], doubtful);
                return doubtful;
            });
        if (!doubtful) return -count;
    }
    throw MeshError(
        "no straight way out of the surface avoids its edges; its coordinates may be "
        "too large to tell apart");
}

}  // namespace myotet::cage
