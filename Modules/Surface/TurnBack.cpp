// SPDX-License-Identifier: Apache-2.0
#include "Surface/TurnBack.h"

#include <algorithm>
#include <functional>
#include <set>
#include <tuple>

#include "Surface/Change.h"
#include "Surface/Improve.h"

namespace myotet::surface {
namespace {

constexpr int kRounds = 8;
constexpr int kRings = 2;         // about a triangle: what is judged after a change
constexpr double kSharp = 0.966;  // cosine of 15 degrees: worse angles are no way out

/// Points within so many edges of a triangle.
std::set<std::int32_t> points_about(const Fans& fans, const Triangle& t, int rings) {
    std::set<std::int32_t> points(t.begin(), t.end());
    for (int ring = 0; ring < rings; ++ring) {
        const std::set<std::int32_t> inner = points;
        for (const std::int32_t v : inner)
            for (const std::int32_t n : neighbours(fans, v)) points.insert(n);
    }
    return points;
}

/// What is wrong about some points; less is better.
struct Wrong {
    int turned = 0, crossing = 0, sideways = 0;
    double sharpest = -1;
    auto operator<=>(const Wrong&) const = default;
};

Wrong wrong_about(const Fans& fans, const Field& phi, const std::set<std::int32_t>& points) {
    std::set<std::int32_t> triangles;
    for (const std::int32_t v : points)
        triangles.insert(fans.around[v].begin(), fans.around[v].end());
    Wrong wrong;
    std::vector<Triangle> there;
    for (const std::int32_t number : triangles) {
        const Triangle& t = fans.triangles[number];
        there.push_back(t);
        const Facing way = facing(fans, phi, t);
        wrong.turned += way == Facing::turned_over;
        wrong.sideways += way != Facing::outward;
        wrong.sharpest =
            std::max(wrong.sharpest,
                     sharpest_cosine(fans.points[t[0]], fans.points[t[1]], fans.points[t[2]]));
    }
    wrong.crossing = static_cast<int>(crossings(fans.points, there).size());
    return wrong;
}

using Change = std::function<bool(Fans&)>;

/// Edges of the triangles about a triangle, each once.
std::set<std::array<std::int32_t, 2>> edges_about(const Fans& fans, const Triangle& t) {
    std::set<std::array<std::int32_t, 2>> edges;
    for (const std::int32_t v : t)
        for (const std::int32_t f : fans.around[v])
            for (int i = 0; i < 3; ++i) {
                const std::int32_t a = fans.triangles[f][i], b = fans.triangles[f][(i + 1) % 3];
                edges.insert({std::min(a, b), std::max(a, b)});
            }
    return edges;
}

bool collapse_onto(Fans& fans, const Guide& guide, std::int32_t a, std::int32_t b, double part) {
    const EdgeStar star = edge_star(fans, a, b);
    if (fans.rim[a] || !may_collapse(fans, a, b, star) || closes_ring(fans, a, b, star))
        return false;
    const std::optional<Corner> at =
        fans.rim[b]
            ? corner_of(fans, b)
            : landing(fans, guide, b, fans.points[b] + part * (fans.points[a] - fans.points[b]));
    if (!at) return false;
    collapse(fans, a, b, star);
    fans.points[b] = at->point;
    fans.normals[b] = at->normal;
    return true;
}

bool flip_edge(Fans& fans, std::int32_t a, std::int32_t b) {
    const EdgeStar star = edge_star(fans, a, b);
    if (!star.inner() || !may_flip(fans, a, b, star)) return false;
    flip(fans, a, b, star);
    return true;
}

bool split_edge(Fans& fans, const Guide& guide, std::int32_t a, std::int32_t b) {
    const EdgeStar star = edge_star(fans, a, b);
    if (!star.inner()) return false;
    const std::optional<Corner> m = landing(guide, 0.5 * (fans.points[a] + fans.points[b]),
                                            0.5 * (fans.sizes[a] + fans.sizes[b]), false);
    if (!m) return false;
    const std::int32_t v = split(fans, a, b, star, m->point);
    fans.normals[v] = m->normal;
    return true;
}

std::vector<Change> changes_about(const Fans& fans, const Guide& guide, const Triangle& t) {
    std::vector<Change> changes{[](Fans&) { return true; }};  // moves alone
    for (const auto& [a, b] : edges_about(fans, t)) {
        changes.emplace_back([a = a, b = b](Fans& f) { return flip_edge(f, a, b); });
        for (const double part : {0.0, 0.5, 1.0})
            changes.emplace_back([a = a, b = b, part, &guide](Fans& f) {
                return collapse_onto(f, guide, a, b, part);
            });
        changes.emplace_back(
            [a = a, b = b, &guide](Fans& f) { return split_edge(f, guide, a, b); });
    }
    return changes;
}

/// The best change about a triangle; whether there was one that helps.
bool mend(Fans& fans, const Guide& guide, const Triangle t) {
    std::set<std::int32_t> about = points_about(fans, t, kRings);
    const std::set<std::int32_t> touched = points_about(fans, t, 1);
    const Wrong before = wrong_about(fans, guide.phi, about);
    about.insert(static_cast<std::int32_t>(fans.points.size()));  // that a split would add
    Wrong best = before;
    std::optional<Fans> chosen;
    for (const Change& change : changes_about(fans, guide, t)) {
        Fans trial = fans;
        if (!change(trial)) continue;
        std::set<std::int32_t> now = about;
        std::erase_if(now, [&](std::int32_t v) {
            return static_cast<std::size_t>(v) >= trial.points.size() || trial.around[v].empty();
        });
        for (int pass = 0; pass < 2; ++pass)
            for (const std::int32_t v : now)
                if (touched.contains(v) || static_cast<std::size_t>(v) >= fans.points.size())
                    improve_point(trial, guide, v);
        const Wrong after = wrong_about(trial, guide.phi, now);
        const bool helps =
            std::tie(after.turned, after.sideways) < std::tie(before.turned, before.sideways);
        if (!helps || after.turned > before.turned || after.crossing > before.crossing ||
            (after.sharpest > kSharp && after.sharpest > before.sharpest) || !(after < best))
            continue;
        best = after;
        chosen = std::move(trial);
    }
    if (!chosen) return false;
    fans = std::move(*chosen);
    return true;
}

}  // namespace

bool turned_over(const Fans& fans, const Field& phi, const Triangle& t) {
    return facing(fans, phi, t) == Facing::turned_over;
}

void turn_back(Fans& fans, const Guide& guide, CrossingGuard& guard) {
    for (int round = 0; round < kRounds; ++round) {
        bool changed = false;
        guard.run([&] {
            changed = false;
            for (std::size_t t = 0; t < fans.triangles.size(); ++t)
                if (fans.alive(t) && turned_over(fans, guide.phi, fans.triangles[t]))
                    changed |= mend(fans, guide, fans.triangles[t]);
        });
        if (!changed) return;
    }
}

}  // namespace myotet::surface
