// SPDX-License-Identifier: Apache-2.0
#include "Surface/Remesh.h"

#include <algorithm>
#include <cmath>

#include "Core/Parallel.h"

namespace myotet::surface {
namespace {

constexpr std::size_t kGrain = 256;
constexpr double kTooLong = 4.0 / 3.0, kTooShort = 4.0 / 5.0;
constexpr double kGrowth = 0.25;  // of the wished length over a distance
constexpr int kGrowthSweeps = 4;
constexpr int kSmoothSteps = 2;      // a round
constexpr double kKeepShape = 0.93;  // cosine of 21.5 degrees: flips for valence stay above

double wished(const Fans& fans, std::int32_t a, std::int32_t b) {
    return 0.5 * (fans.sizes[a] + fans.sizes[b]);
}

double length(const Fans& fans, std::int32_t a, std::int32_t b) {
    return (fans.points[a] - fans.points[b]).norm();
}

void split_long_edges(Fans& fans, const Guide& guide) {
    // Triangles made on the way wait for the next round: about two points on
    // either side of a thin sheet a single pass could go on for ever.
    const std::size_t count = fans.triangles.size();
    for (std::size_t t = 0; t < count; ++t)
        for (int i = 0; i < 3 && fans.alive(t); ++i) {
            const std::int32_t a = fans.triangles[t][i], b = fans.triangles[t][(i + 1) % 3];
            if (!(length(fans, a, b) > kTooLong * wished(fans, a, b))) continue;
            split_in_middle(fans, guide, a, b);
        }
}

/// Whether no edge that a leaves to b at `at` would be too long.
bool collapse_keeps_lengths(const Fans& fans, std::int32_t a, std::int32_t b, const Vec3& at) {
    for (const std::int32_t from : {a, b})
        for (const std::int32_t n : neighbours(fans, from))
            if (n != a && n != b && (fans.points[n] - at).norm() > kTooLong * wished(fans, n, b))
                return false;
    return true;
}

bool collapse_edge(Fans& fans, const Guide& guide, std::int32_t a, std::int32_t b) {
    if (fans.rim[a] && !fans.rim[b]) std::swap(a, b);
    const EdgeStar star = edge_star(fans, a, b);
    if (!may_collapse(fans, a, b, star)) return false;
    if (closes_ring(fans, a, b, star)) {
        fans.caps[a] = std::min(fans.caps[a], length(fans, a, b));
        fans.caps[b] = std::min(fans.caps[b], length(fans, a, b));
        return false;
    }
    const std::optional<Corner> at = meeting_point(fans, guide, a, b);
    if (!at || !collapse_keeps_lengths(fans, a, b, at->point) ||
        !collapse_faces_outward(fans, guide.phi, a, b, *at))
        return false;
    collapse(fans, a, b, star);
    fans.points[b] = at->point;
    fans.normals[b] = at->normal;
    return true;
}

void collapse_short_edges(Fans& fans, const Guide& guide) {
    for (std::size_t t = 0; t < fans.triangles.size(); ++t)
        for (int i = 0; i < 3 && fans.alive(t); ++i) {
            const std::int32_t a = fans.triangles[t][i], b = fans.triangles[t][(i + 1) % 3];
            if (length(fans, a, b) < kTooShort * wished(fans, a, b))
                collapse_edge(fans, guide, a, b);
        }
}

double sharpest(const Fans& fans, std::int32_t a, std::int32_t b, std::int32_t c) {
    return sharpest_cosine(fans.points[a], fans.points[b], fans.points[c]);
}

bool evens_valences(const Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star) {
    const auto [c, d] = star.opposite;
    const int ea = excess_valence(fans, a), eb = excess_valence(fans, b),
              ec = excess_valence(fans, c), ed = excess_valence(fans, d);
    const auto square = [](int e) { return e * e; };
    if (square(ea - 1) + square(eb - 1) + square(ec + 1) + square(ed + 1) >=
        square(ea) + square(eb) + square(ec) + square(ed))
        return false;
    const double now = std::max(sharpest(fans, a, b, c), sharpest(fans, b, a, d));
    const double then = std::max(sharpest(fans, d, b, c), sharpest(fans, c, a, d));
    return then < std::max(now, kKeepShape);
}

/// Where point v is drawn to: the middle of its triangles, each weighed by its
/// area in units of the wished one; on the rim, half way to the middle of its
/// neighbours, as all points step at once and would swing past one another.
Vec3 middle_of_star(const Fans& fans, std::int32_t v) {
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    const auto add = [&](double weight, const Vec3& at) {
        sum += weight * at;
        weights += weight;
    };
    if (fans.rim[v]) {
        for (const std::int32_t n : rim_neighbours(fans, v))
            if (n >= 0) add(1 / wished(fans, v, n), 0.5 * (fans.points[v] + fans.points[n]));
    } else {
        for (const std::int32_t t : fans.around[v]) {
            const Triangle& f = fans.triangles[t];
            const Vec3 &a = fans.points[f[0]], &b = fans.points[f[1]], &c = fans.points[f[2]];
            const double size = fans.sizes[f[0]] + fans.sizes[f[1]] + fans.sizes[f[2]];
            add(double_area(a, b, c).norm() / (size * size), (a + b + c) / 3);
        }
    }
    return weights > 0 ? Vec3(sum / weights) : fans.points[v];
}

/// What the surface at a point wants.
double size_at(const Guide& guide, const Vec3& point, const Sizing& sizing) {
    const double k = largest_curvature(guide.phi, point, sizing.smallest_length);
    if (!(k > 0)) return sizing.edge_length;
    const double bent = std::min(sizing.curvature_factor / k, sizing.edge_length);
    if (bent <= sizing.smallest_length) return sizing.smallest_length;
    // L^2 k / 8 <= thickness / 4
    const double enough = 0.5 * bent * bent * k;
    double room = thickness(guide.phi, point, enough);
    if (guide.beside.phi) room = std::clamp(guide.beside.phi(point).value, 0.0, room);
    const double thin = std::sqrt(room / enough);
    return std::max(bent * thin, sizing.smallest_length);
}

}  // namespace

void find_sizes(Fans& fans, const Guide& guide, const Sizing& sizing) {
    parallel_for(0, fans.points.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v) {
            if (fans.around[v].empty()) continue;
            fans.sizes[v] = std::min(size_at(guide, fans.points[v], sizing), fans.caps[v]);
        }
    });
    for (int sweep = 0; sweep < kGrowthSweeps; ++sweep)
        for (std::size_t v = 0; v < fans.points.size(); ++v)
            for (const std::int32_t n : neighbours(fans, static_cast<std::int32_t>(v)))
                fans.sizes[v] = std::min(
                    fans.sizes[v],
                    fans.sizes[n] + kGrowth * length(fans, static_cast<std::int32_t>(v), n));
}

void even_valences(Fans& fans, const Guide& guide) {
    for (std::size_t t = 0; t < fans.triangles.size(); ++t)
        for (int i = 0; i < 3 && fans.alive(t); ++i) {
            const std::int32_t a = fans.triangles[t][i], b = fans.triangles[t][(i + 1) % 3];
            const EdgeStar star = edge_star(fans, a, b);
            if (star.inner() && evens_valences(fans, a, b, star) && may_flip(fans, a, b, star) &&
                flip_faces_outward(fans, guide.phi, a, b, star))
                flip(fans, a, b, star);
        }
}

void smooth(Fans& fans, const Guide& guide) {
    // All steps are found from the same positions, then taken one by one: the
    // same on any number of threads.
    std::vector<std::optional<Corner>> wanted(fans.points.size());
    parallel_for(0, fans.points.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (fans.around[i].empty()) continue;
            const auto v = static_cast<std::int32_t>(i);
            const Vec3 step = middle_of_star(fans, v) - fans.points[v];
            const Vec3& n = fans.normals[v];
            wanted[i] = landing(fans, guide, v, fans.points[v] + (step - n.dot(step) * n));
        }
    });
    move_all(fans, guide.phi, wanted);
}

void remesh(Fans& fans, const Guide& guide, CrossingGuard& guard, const Sizing& sizing,
            int rounds) {
    for (int round = 0; round < rounds; ++round) {
        find_sizes(fans, guide, sizing);
        guard.run([&] {
            split_long_edges(fans, guide);
            collapse_short_edges(fans, guide);
            even_valences(fans, guide);
            for (int step = 0; step < kSmoothSteps; ++step) smooth(fans, guide);
        });
    }
}

}  // namespace myotet::surface
