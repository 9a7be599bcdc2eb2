// SPDX-License-Identifier: Apache-2.0
#include "Surface/Improve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Surface/Tangent.h"

namespace myotet::surface {
namespace {

constexpr double kTurnedOver = 2;  // worse than any cosine
constexpr double kGain = 1e-4;     // of a cosine: below it nothing has changed
constexpr int kDirections = 8;
constexpr double kFirstStep = 0.2, kLastStep = 0.01;  // of the wished edge
constexpr int kMovesOfPoint = 40;
// Topology is changed only for triangles that stay below this: cosine of 30 degrees.
constexpr double kSharp = 0.866;

double sharpest(const Fans& fans, const Triangle& t) {
    return sharpest_cosine(fans.points[t[0]], fans.points[t[1]], fans.points[t[2]]);
}

/// Largest cosine in the star of v as it is.
double worst_around(const Fans& fans, std::int32_t v) {
    double worst = -1;
    for (const std::int32_t t : fans.around[v]) {
        const Triangle& f = fans.triangles[t];
        worst = std::max(worst, faces_outward(fans, f) ? sharpest(fans, f) : kTurnedOver);
    }
    return worst;
}

struct Position {
    Vec3 point, normal;
};

Position position_of(const Fans& fans, std::int32_t v) { return {fans.points[v], fans.normals[v]}; }

void set_position(Fans& fans, std::int32_t v, const Position& p) {
    fans.points[v] = p.point;
    fans.normals[v] = p.normal;
}

/// Directions that v may move in: about the normal, or along the rim.
std::vector<Vec3> directions_at(const Fans& fans, std::int32_t v) {
    if (fans.rim[v]) {
        const auto [next, last] = rim_neighbours(fans, v);
        if (next < 0 || last < 0) return {};
        const Vec3 along = (fans.points[next] - fans.points[last]).normalized();
        return {along, -along};
    }
    const auto [u, w] = tangents(fans.normals[v]);
    std::vector<Vec3> directions;
    for (int i = 0; i < kDirections; ++i) {
        const double angle = 2 * std::numbers::pi * i / kDirections;
        directions.emplace_back(std::cos(angle) * u + std::sin(angle) * w);
    }
    return directions;
}

/// Tries one place; keeps it when it is better than `worst`.
bool try_place(Fans& fans, const Guide& guide, std::int32_t v, const Vec3& at, double& worst) {
    const Position before = position_of(fans, v);
    place(fans, guide, v, at);
    const double now = worst_around(fans, v);
    if (now < worst - kGain) {
        worst = now;
        return true;
    }
    set_position(fans, v, before);
    return false;
}

/// Pattern search: steps that help are repeated, then halved.
bool move_point(Fans& fans, const Guide& guide, std::int32_t v) {
    double worst = worst_around(fans, v);
    double step = kFirstStep * fans.sizes[v];
    bool moved = false;
    for (int move = 0; move < kMovesOfPoint && step > kLastStep * fans.sizes[v]; ++move) {
        bool better = false;
        for (const Vec3& direction : directions_at(fans, v))
            if (try_place(fans, guide, v, fans.points[v] + step * direction, worst)) {
                better = true;
                break;
            }
        moved |= better;
        if (!better) step /= 2;
    }
    return moved;
}

bool flip_if_better(Fans& fans, std::int32_t a, std::int32_t b) {
    const EdgeStar star = edge_star(fans, a, b);
    if (!star.inner()) return false;
    const auto [c, d] = star.opposite;
    const double now = std::max(sharpest(fans, {a, b, c}), sharpest(fans, {b, a, d}));
    const double then = std::max(sharpest(fans, {d, b, c}), sharpest(fans, {c, a, d}));
    if (!(then < now - kGain) || !may_flip(fans, a, b, star)) return false;
    flip(fans, a, b, star);
    return true;
}

template <class Act>
bool at_sharp_triangles(Fans& fans, double cosine, const Act& act) {
    bool changed = false;
    for (std::size_t t = 0; t < fans.triangles.size(); ++t)
        if (fans.alive(t) && sharpest(fans, fans.triangles[t]) > cosine) changed |= act(t);
    return changed;
}

bool flip_edges(Fans& fans, double cosine) {
    return at_sharp_triangles(fans, cosine, [&](std::size_t t) {
        for (int i = 0; i < 3; ++i) {
            const Triangle f = fans.triangles[t];
            if (flip_if_better(fans, f[i], f[(i + 1) % 3])) return true;
        }
        return false;
    });
}

bool move_points(Fans& fans, const Guide& guide, double cosine) {
    return at_sharp_triangles(fans, cosine, [&](std::size_t t) {
        bool moved = false;
        for (const std::int32_t v : Triangle(fans.triangles[t]))
            moved |= move_point(fans, guide, v);
        return moved;
    });
}

/// Largest cosine among the triangles that would be b's if a became b at `at`.
double worst_after_collapse(Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star) {
    double worst = -1;
    const Position b_now = position_of(fans, b);
    for (const std::int32_t from : {a, b})
        for (const std::int32_t t : fans.around[from]) {
            if (t == star.triangle[0] || t == star.triangle[1]) continue;
            Triangle f = fans.triangles[t];
            if (!faces_outward(fans, f, from, b_now.point, b_now.normal)) return kTurnedOver;
            std::ranges::replace(f, from, b);
            worst = std::max(worst, sharpest(fans, f));
        }
    return worst;
}

/// Takes the edge (a, b) away when the triangles around it gain.
bool collapse_if_better(Fans& fans, const Guide& guide, std::int32_t a, std::int32_t b) {
    if (fans.rim[a] && !fans.rim[b]) std::swap(a, b);
    const EdgeStar star = edge_star(fans, a, b);
    if (!may_collapse(fans, a, b, star)) return false;
    const double now = std::max(worst_around(fans, a), worst_around(fans, b));
    const Position before = position_of(fans, b);
    if (fans.rim[a] == fans.rim[b]) place(fans, guide, b, 0.5 * (fans.points[a] + fans.points[b]));
    if (worst_after_collapse(fans, a, b, star) < now - kGain) {
        collapse(fans, a, b, star);
        move_point(fans, guide, b);
        return true;
    }
    set_position(fans, b, before);
    return false;
}

bool collapse_edges(Fans& fans, const Guide& guide, double cosine) {
    return at_sharp_triangles(fans, cosine, [&](std::size_t t) {
        for (int i = 0; i < 3; ++i) {
            const Triangle f = fans.triangles[t];
            if (collapse_if_better(fans, guide, f[i], f[(i + 1) % 3])) return true;
        }
        return false;
    });
}

/// Splits the longest edge of a sharp triangle: with the flips and moves that
/// follow, the way out of a point with too few edges.
bool split_edges(Fans& fans, const Guide& guide, double cosine) {
    const std::size_t count = fans.triangles.size();
    bool changed = false;
    for (std::size_t t = 0; t < count; ++t) {
        if (!fans.alive(t) || sharpest(fans, fans.triangles[t]) <= cosine) continue;
        const Triangle f = fans.triangles[t];
        int longest = 0;
        const auto squared = [&](int i) {
            return (fans.points[f[i]] - fans.points[f[(i + 1) % 3]]).squaredNorm();
        };
        for (int i = 1; i < 3; ++i)
            if (squared(i) > squared(longest)) longest = i;
        const std::int32_t a = f[longest], b = f[(longest + 1) % 3];
        const Vec3 middle = 0.5 * (fans.points[a] + fans.points[b]);
        place(fans, guide, split(fans, a, b, edge_star(fans, a, b), middle), middle);
        changed = true;
    }
    return changed;
}

void settle(Fans& fans, const Guide& guide, const AngleGoal& goal, double cosine) {
    for (int round = 0; round < goal.rounds; ++round) {
        const bool flipped = flip_edges(fans, cosine);
        const bool moved = move_points(fans, guide, cosine);
        if (!flipped && !moved) break;
    }
}

}  // namespace

void improve_angles(Fans& fans, const Guide& guide, const AngleGoal& goal) {
    const double cosine = std::cos(goal.smallest_deg * std::numbers::pi / 180);
    settle(fans, guide, goal, cosine);
    constexpr int kTopologyRounds = 4;
    for (int round = 0; round < kTopologyRounds; ++round) {
        bool changed = collapse_edges(fans, guide, kSharp);
        settle(fans, guide, goal, cosine);
        if (round % 2 == 0) changed |= split_edges(fans, guide, kSharp);
        if (!changed) break;
        settle(fans, guide, goal, cosine);
    }
}

}  // namespace myotet::surface
