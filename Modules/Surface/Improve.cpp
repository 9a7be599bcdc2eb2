// SPDX-License-Identifier: Apache-2.0
#include "Surface/Improve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Surface/Tangent.h"

namespace myotet::surface {
namespace {

constexpr double kTurnedOver = 3;  // worse than any cosine
constexpr double kGain = 1e-4;     // of a cosine: below it nothing has changed
constexpr int kDirections = 8;
constexpr double kFirstStep = 0.2, kLastStep = 0.01;  // of the wished edge
constexpr int kMovesOfPoint = 40;
// Topology is changed only for triangles that stay below this: cosine of 30 degrees.
constexpr double kSharp = 0.866;

double sharpest(const Fans& fans, const Triangle& t) {
    return sharpest_cosine(fans.points[t[0]], fans.points[t[1]], fans.points[t[2]]);
}

/// Largest cosine in the star of v if it is at `at`; more where something is
/// wrong, by how much is. Not looked at closely when it is above `limit` anyway.
double worst_around(const Fans& fans, const Guide& guide, std::int32_t v, const Corner& at,
                    double limit) {
    double worst = -1;
    for (const std::int32_t t : fans.around[v]) {
        const Triangle& f = fans.triangles[t];
        worst = std::max(
            worst, sharpest_cosine(at.point, fans.points[after(f, v)], fans.points[before(f, v)]));
    }
    return worst < limit ? worst + kTurnedOver * faults_around(fans, guide.phi, v, at) : worst;
}

double worst_around(const Fans& fans, const Guide& guide, std::int32_t v) {
    return worst_around(fans, guide, v, corner_of(fans, v),
                        std::numeric_limits<double>::infinity());
}

void set_corner(Fans& fans, std::int32_t v, const Corner& at) {
    fans.points[v] = at.point;
    fans.normals[v] = at.normal;
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
    const std::optional<Corner> there = landing(fans, guide, v, at);
    if (!there) return false;
    const double now = worst_around(fans, guide, v, *there, worst - kGain);
    if (!(now < worst - kGain)) return false;
    worst = now;
    set_corner(fans, v, *there);
    return true;
}

bool flip_if_better(Fans& fans, const Guide& guide, std::int32_t a, std::int32_t b) {
    const EdgeStar star = edge_star(fans, a, b);
    if (!star.inner()) return false;
    const auto [c, d] = star.opposite;
    const double now = std::max(sharpest(fans, {a, b, c}), sharpest(fans, {b, a, d}));
    const double then = std::max(sharpest(fans, {d, b, c}), sharpest(fans, {c, a, d}));
    if (!(then < now - kGain) || !may_flip(fans, a, b, star) ||
        !flip_faces_outward(fans, guide.phi, a, b, star))
        return false;
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

bool flip_edges(Fans& fans, const Guide& guide, double cosine) {
    return at_sharp_triangles(fans, cosine, [&](std::size_t t) {
        for (int i = 0; i < 3; ++i) {
            const Triangle f = fans.triangles[t];
            if (flip_if_better(fans, guide, f[i], f[(i + 1) % 3])) return true;
        }
        return false;
    });
}

/// Also those of triangles that do not face outward.
bool move_points(Fans& fans, const Guide& guide, double cosine) {
    bool moved = false;
    for (std::size_t t = 0; t < fans.triangles.size(); ++t)
        if (fans.alive(t) && (sharpest(fans, fans.triangles[t]) > cosine ||
                              !faces_outward(fans, guide.phi, fans.triangles[t])))
            for (const std::int32_t v : fans.triangles[t]) moved |= improve_point(fans, guide, v);
    return moved;
}

/// Largest cosine among the triangles that would be b's if a became b at `at`.
double worst_after_collapse(const Fans& fans, std::int32_t a, std::int32_t b, const Vec3& at) {
    double worst = -1;
    for (const std::int32_t from : {a, b})
        for (const std::int32_t t : fans.around[from]) {
            const std::int32_t c = after(fans.triangles[t], from),
                               d = before(fans.triangles[t], from);
            if (c == a || c == b || d == a || d == b) continue;
            worst = std::max(worst, sharpest_cosine(at, fans.points[c], fans.points[d]));
        }
    return worst;
}

/// Takes the edge (a, b) away when the triangles around it gain.
bool collapse_if_better(Fans& fans, const Guide& guide, std::int32_t a, std::int32_t b) {
    if (fans.rim[a] && !fans.rim[b]) std::swap(a, b);
    const EdgeStar star = edge_star(fans, a, b);
    if (!may_collapse(fans, a, b, star) || closes_ring(fans, a, b, star)) return false;
    const std::optional<Corner> at = meeting_point(fans, guide, a, b);
    if (!at || !collapse_faces_outward(fans, guide.phi, a, b, *at)) return false;
    const double now = std::max(worst_around(fans, guide, a), worst_around(fans, guide, b));
    if (!(worst_after_collapse(fans, a, b, at->point) < now - kGain)) return false;
    collapse(fans, a, b, star);
    set_corner(fans, b, *at);
    improve_point(fans, guide, b);
    return true;
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
        changed |= split_in_middle(fans, guide, a, b);
    }
    return changed;
}

void settle(Fans& fans, const Guide& guide, const AngleGoal& goal, double cosine) {
    for (int round = 0; round < goal.rounds; ++round) {
        const bool flipped = flip_edges(fans, guide, cosine);
        const bool moved = move_points(fans, guide, cosine);
        if (!flipped && !moved) break;
    }
}

}  // namespace

bool improve_point(Fans& fans, const Guide& guide, std::int32_t v) {
    double worst = worst_around(fans, guide, v);
    // Steps that help are repeated, then halved.
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

void improve_angles(Fans& fans, const Guide& guide, CrossingGuard& guard, const AngleGoal& goal) {
    const double cosine = std::cos(goal.smallest_deg * std::numbers::pi / 180);
    guard.run([&] { settle(fans, guide, goal, cosine); });
    constexpr int kTopologyRounds = 4;
    for (int round = 0; round < kTopologyRounds; ++round) {
        bool changed = false;
        guard.run([&] {
            changed = collapse_edges(fans, guide, kSharp);
            settle(fans, guide, goal, cosine);
        });
        if (round % 2 == 0)
            guard.run([&] {
                changed |= split_edges(fans, guide, kSharp);
                settle(fans, guide, goal, cosine);
            });
        if (!changed) break;
    }
}

}  // namespace myotet::surface
