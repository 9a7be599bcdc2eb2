// SPDX-License-Identifier: Apache-2.0
#include "Surface/Change.h"

#include <algorithm>

#include "Core/Parallel.h"

namespace myotet::surface {
namespace {

constexpr std::size_t kGrain = 256;
constexpr double kFold = -0.5;    // cosine of 120 degrees
constexpr double kShorter = 0.9;  // halves of an edge, of the edge

void set_corner(Fans& fans, std::int32_t v, const Corner& at) {
    fans.points[v] = at.point;
    fans.normals[v] = at.normal;
}

double length(const Vec3& a, const Vec3& b) { return (a - b).norm(); }

Placed placed(const Fans& fans, const Triangle& t) {
    return {t, {fans.points[t[0]], fans.points[t[1]], fans.points[t[2]]}};
}

int crossings_of(const Fans& fans, std::span<const Triangle> made,
                 std::span<const std::int32_t> old) {
    std::vector<Placed> there;
    for (const Triangle& t : made) there.push_back(placed(fans, t));
    return count_crossings(fans, there, old);
}

/// What is wrong with the triangles of an edge as they are.
int faults_of(const Fans& fans, const Field& phi, const EdgeStar& star) {
    int faults = 0;
    std::vector<Triangle> there;
    for (const std::int32_t t : star.triangle)
        if (t >= 0) {
            there.push_back(fans.triangles[t]);
            faults += weight(facing(fans, phi, there.back()));
        }
    return faults + kBroken * crossings_of(fans, there, star.triangle);
}

/// Cosine of the angle by which the triangles (a, b, c) and (b, a, d) turn.
double turn(const Fans& fans, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    const auto& x = fans.points;
    return double_area(x[a], x[b], x[c])
        .normalized()
        .dot(double_area(x[b], x[a], x[d]).normalized());
}

bool split_faces_outward(const Fans& fans, const Field& phi, std::int32_t a, std::int32_t b,
                         const EdgeStar& star, const Corner& m) {
    // The new point has the next number.
    Umbrella then(fans, phi, static_cast<std::int32_t>(fans.points.size()), m);
    if (star.opposite[0] >= 0) {
        then.add(star.opposite[0], a, star.triangle[0]);
        then.add(b, star.opposite[0], star.triangle[0]);
    }
    if (star.opposite[1] >= 0) {
        then.add(star.opposite[1], b, star.triangle[1]);
        then.add(a, star.opposite[1], star.triangle[1]);
    }
    const int faults = then.faults();
    return faults == 0 || faults <= faults_of(fans, phi, star);
}

}  // namespace

bool place(Fans& fans, const Guide& guide, std::int32_t v, const Vec3& at) {
    const std::optional<Corner> there = landing(fans, guide, v, at);
    if (!there || !may_move(fans, guide.phi, v, *there)) return false;
    set_corner(fans, v, *there);
    return true;
}

void move_all(Fans& fans, const Field& phi, const std::vector<std::optional<Corner>>& wanted) {
    for (std::size_t i = 0; i < fans.points.size(); ++i) {
        const auto v = static_cast<std::int32_t>(i);
        if (wanted[i] && may_move(fans, phi, v, *wanted[i])) set_corner(fans, v, *wanted[i]);
    }
}

void place_all(Fans& fans, const Guide& guide) {
    std::vector<std::optional<Corner>> wanted(fans.points.size());
    parallel_for(0, fans.points.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (fans.around[i].empty()) continue;
            fans.normals[i] = guide.phi(fans.points[i]).gradient.normalized();
            wanted[i] = landing(fans, guide, static_cast<std::int32_t>(i), fans.points[i]);
        }
    });
    move_all(fans, guide.phi, wanted);
}

bool split_in_middle(Fans& fans, const Guide& guide, std::int32_t a, std::int32_t b) {
    const EdgeStar star = edge_star(fans, a, b);
    const Vec3 &pa = fans.points[a], &pb = fans.points[b];
    const double reach = 0.5 * (fans.sizes[a] + fans.sizes[b]);
    const std::optional<Corner> m = landing(guide, 0.5 * (pa + pb), reach, !star.inner());
    if (!m || !split_faces_outward(fans, guide.phi, a, b, star, *m)) return false;
    if (std::max(length(pa, m->point), length(m->point, pb)) >= kShorter * length(pa, pb))
        return false;
    set_corner(fans, split(fans, a, b, star, m->point), *m);
    return true;
}

bool flip_faces_outward(const Fans& fans, const Field& phi, std::int32_t a, std::int32_t b,
                        const EdgeStar& star) {
    const auto [c, d] = star.opposite;
    const double then = turn(fans, c, d, a, b);
    if (then < kFold && then < turn(fans, a, b, c, d)) return false;
    const std::array<Triangle, 2> made{Triangle{d, b, c}, Triangle{c, a, d}};
    const int faults = weight(facing(fans, phi, made[0])) + weight(facing(fans, phi, made[1])) +
                       kBroken * crossings_of(fans, made, star.triangle);
    return faults == 0 || faults <= faults_of(fans, phi, star);
}

bool collapse_faces_outward(const Fans& fans, const Field& phi, std::int32_t a, std::int32_t b,
                            const Corner& at) {
    const EdgeStar star = edge_star(fans, a, b);
    Umbrella then(fans, phi, b, at);
    for (const std::int32_t from : {a, b})
        for (const std::int32_t t : fans.around[from]) {
            const Triangle& f = fans.triangles[t];
            if (t == star.triangle[0] || t == star.triangle[1])
                then.remove(t);
            else
                then.add(after(f, from), before(f, from), t);
        }
    const int faults = then.faults();
    return faults == 0 || faults <= std::max(faults_around(fans, phi, a, corner_of(fans, a)),
                                             faults_around(fans, phi, b, corner_of(fans, b)));
}

std::optional<Corner> meeting_point(const Fans& fans, const Guide& guide, std::int32_t a,
                                    std::int32_t b) {
    if (fans.rim[a] != fans.rim[b]) return corner_of(fans, b);
    return landing(fans, guide, b, 0.5 * (fans.points[a] + fans.points[b]));
}

}  // namespace myotet::surface
