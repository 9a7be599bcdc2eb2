// SPDX-License-Identifier: Apache-2.0
#include "Cage/Walls.h"

#include <algorithm>
#include <limits>

namespace myotet::cage {
namespace {

Corners3 corners(const Body& body, std::int32_t face) {
    const Triangle& f = body.faces[face];
    return {body.points[f[0]], body.points[f[1]], body.points[f[2]]};
}

Corners3 moved_corners(const Body& body, std::int32_t face, std::int32_t node, const Vec3& x) {
    Corners3 c = corners(body, face);
    for (int i = 0; i < 3; ++i)
        if (body.faces[face][i] == node) c[i] = x;
    return c;
}

Box box_of(const Corners3& t) {
    return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
}

bool apart(const Box& a, const Box& b) {
    return (a.min.array() > b.max.array()).any() || (b.min.array() > a.max.array()).any();
}

}  // namespace

Walls::Walls(const SurfaceTree& surface, std::vector<Part> parts, Body& body)
    : surface_(surface), parts_(std::move(parts)), body_(body) {
    start_anew();
}

void Walls::start_anew() {
    nearest_.assign(body_.points.size(), {});
    known_.assign(body_.points.size(), 0);
    blocker_.assign(body_.faces.size(), -1);
    boxes_.resize(body_.faces.size());
    for (std::size_t f = 0; f < body_.faces.size(); ++f)
        boxes_[f] = box_of(corners(body_, static_cast<std::int32_t>(f)));
}

bool Walls::allows(std::int32_t node, std::int32_t into, const std::vector<Corners4>& tets,
                   const std::vector<Corners3>& faces) const {
    if (!clear(faces)) return false;
    std::vector<std::uint8_t> around(body_.faces.size(), 0);
    for (const std::int32_t n : {node, into})
        for (const std::int32_t f : body_.fan[n]) around[f] = 1;
    for (const Corners3& f : faces)
        for (std::size_t g = 0; g < around.size(); ++g)
            if (!around[g] && !apart(box_of(f), boxes_[g]) &&
                faces_meet(f, corners(body_, static_cast<std::int32_t>(g))))
                return false;
    return std::ranges::all_of(parts_, [&](const Part& part) {
        const auto before = [&](std::int32_t n) {
            return std::ranges::any_of(body_.star[n], [&](std::int32_t t) {
                const Tet& c = body_.tets[t];
                return holds({body_.points[c[0]], body_.points[c[1]], body_.points[c[2]],
                              body_.points[c[3]]},
                             part.point);
            });
        };
        return !(before(node) || before(into)) ||
               std::ranges::any_of(tets, [&](const Corners4& t) { return holds(t, part.point); });
    });
}

const Nearest& Walls::nearest(std::int32_t node) {
    if (!known_[node]) {
        nearest_[node] = *surface_.nearest(
            body_.points[node], std::numeric_limits<double>::infinity(), nearest_[node].triangle);
        known_[node] = 1;
    }
    return nearest_[node];
}

Nearest Walls::nearest_to(const Vec3& p) const {
    return *surface_.nearest(p, std::numeric_limits<double>::infinity());
}

bool Walls::clear(const std::vector<Corners3>& faces) const {
    return std::ranges::all_of(faces, [&](const Corners3& f) { return surface_.meets(f) < 0; });
}

bool Walls::within(std::int32_t node, const Vec3& x, double bound) {
    return surface_.within(x, bound, nearest(node).triangle);
}

bool Walls::loses_part(std::int32_t node, const Vec3& x) const {
    Box swept;
    swept.include(x);
    for (const std::int32_t f : body_.fan[node]) {
        swept.include(boxes_[f].min);
        swept.include(boxes_[f].max);
    }
    const auto in_star = [&](const Vec3& at, const Vec3& p) {
        return std::ranges::any_of(body_.star[node], [&](std::int32_t t) {
            Corners4 c;
            for (int i = 0; i < 4; ++i)
                c[i] = body_.tets[t][i] == node ? at : body_.points[body_.tets[t][i]];
            return holds(c, p);
        });
    };
    return std::ranges::any_of(parts_, [&](const Part& part) {
        const bool fits = (part.box.min.array() >= swept.min.array()).all() &&
                          (part.box.max.array() <= swept.max.array()).all();
        return fits && in_star(body_.points[node], part.point) && !in_star(x, part.point);
    });
}

bool Walls::crosses_itself(std::int32_t node, const Vec3& x, std::int32_t& face) const {
    for (const std::int32_t f : body_.fan[node]) {
        const Corners3 moved = moved_corners(body_, f, node, x);
        const Box box = box_of(moved);
        for (std::size_t g = 0; g < body_.faces.size(); ++g) {
            const auto other = static_cast<std::int32_t>(g);
            if (apart(box, boxes_[g]) ||
                std::ranges::find(body_.faces[g], node) != body_.faces[g].end() ||
                !faces_meet(moved, corners(body_, other)))
                continue;
            face = f;
            return true;
        }
    }
    return false;
}

bool Walls::allows(std::int32_t node, const Vec3& x, Vec3& wall) {
    std::int32_t face = -1;
    for (const std::int32_t f : body_.fan[node]) {
        const Corners3 moved = moved_corners(body_, f, node, x);
        const std::int32_t met = surface_.meets(moved, blocker_[f]);
        if (met < 0) continue;
        blocker_[f] = met;
        face = f;
        break;
    }
    if (face < 0 && !body_.fan[node].empty() && !crosses_itself(node, x, face))
        return !loses_part(node, x);
    if (face < 0) return true;
    const Corners3 c = corners(body_, face);
    wall = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    return false;
}

void Walls::move(std::int32_t node, const Vec3& x) {
    body_.points[node] = x;
    known_[node] = 0;
    for (const std::int32_t f : body_.fan[node]) boxes_[f] = box_of(corners(body_, f));
}

}  // namespace myotet::cage
