// SPDX-License-Identifier: Apache-2.0
#include "Surface/Fans.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace myotet::surface {
namespace {

constexpr Triangle kRemoved{-1, -1, -1};
constexpr int kLeastValence = 4;
constexpr int kLeastRimValence = 3;

void remove_from(std::vector<std::int32_t>& list, std::int32_t item) {
    list.erase(std::find(list.begin(), list.end(), item));
}

int valence(const Fans& fans, std::int32_t point) {
    return static_cast<int>(fans.around[point].size()) + (fans.rim[point] ? 1 : 0);
}

int least_valence(const Fans& fans, std::int32_t point) {
    return fans.rim[point] ? kLeastRimValence : kLeastValence;
}

void put(Triangle& t, std::int32_t old, std::int32_t now) {
    std::replace(t.begin(), t.end(), old, now);
}

}  // namespace

Fans make_fans(const TriMesh& mesh) {
    Fans fans;
    const std::size_t n = mesh.points.size();
    fans.points = mesh.points;
    fans.triangles = mesh.triangles;
    fans.normals.assign(n, Vec3::Zero());
    fans.sizes.assign(n, 0);
    fans.caps.assign(n, std::numeric_limits<double>::infinity());
    fans.watched.assign(n, 0);
    fans.around.resize(n);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::int32_t v : mesh.triangles[t])
            fans.around[v].push_back(static_cast<std::int32_t>(t));
    find_rim(fans);
    return fans;
}

TriMesh to_mesh(const Fans& fans) {
    TriMesh mesh;
    std::vector<std::int32_t> number(fans.points.size(), -1);
    for (std::size_t v = 0; v < fans.points.size(); ++v) {
        if (fans.around[v].empty()) continue;
        number[v] = static_cast<std::int32_t>(mesh.points.size());
        mesh.points.push_back(fans.points[v]);
    }
    for (std::size_t t = 0; t < fans.triangles.size(); ++t) {
        if (!fans.alive(t)) continue;
        const Triangle& f = fans.triangles[t];
        mesh.triangles.push_back({number[f[0]], number[f[1]], number[f[2]]});
    }
    return mesh;
}

void find_rim(Fans& fans) {
    fans.rim.assign(fans.points.size(), 0);
    for (std::size_t t = 0; t < fans.triangles.size(); ++t) {
        if (!fans.alive(t)) continue;
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = fans.triangles[t][i], b = fans.triangles[t][(i + 1) % 3];
            if (!edge_star(fans, a, b).inner()) fans.rim[a] = fans.rim[b] = 1;
        }
    }
}

EdgeStar edge_star(const Fans& fans, std::int32_t a, std::int32_t b) {
    EdgeStar star;
    for (const std::int32_t t : fans.around[a]) {
        const Triangle& f = fans.triangles[t];
        if (after(f, a) == b) {
            star.triangle[0] = t;
            star.opposite[0] = before(f, a);
        } else if (before(f, a) == b) {
            star.triangle[1] = t;
            star.opposite[1] = after(f, a);
        }
    }
    return star;
}

std::vector<std::int32_t> neighbours(const Fans& fans, std::int32_t point) {
    std::vector<std::int32_t> found;
    found.reserve(8);
    for (const std::int32_t t : fans.around[point])
        found.push_back(after(fans.triangles[t], point));
    if (!fans.rim[point]) return found;
    for (const std::int32_t t : fans.around[point]) {
        const std::int32_t b = before(fans.triangles[t], point);
        if (std::ranges::find(found, b) == found.end()) found.push_back(b);
    }
    return found;
}

std::array<std::int32_t, 2> rim_neighbours(const Fans& fans, std::int32_t point) {
    std::array<std::int32_t, 2> ends{-1, -1};
    for (const std::int32_t t : fans.around[point]) {
        const std::int32_t a = after(fans.triangles[t], point),
                           b = before(fans.triangles[t], point);
        if (fans.rim[a] && !edge_star(fans, point, a).inner()) ends[0] = a;
        if (fans.rim[b] && !edge_star(fans, point, b).inner()) ends[1] = b;
    }
    return ends;
}

int excess_valence(const Fans& fans, std::int32_t point) {
    return valence(fans, point) - (fans.rim[point] ? 4 : 6);
}

double sharpest_cosine(const Vec3& a, const Vec3& b, const Vec3& c) {
    // The smallest angle lies opposite the shortest edge; law of cosines.
    std::array<double, 3> s{(b - c).squaredNorm(), (c - a).squaredNorm(), (a - b).squaredNorm()};
    if (s[1] < s[0]) std::swap(s[0], s[1]);
    if (s[2] < s[0]) std::swap(s[0], s[2]);
    const double product = s[1] * s[2];
    return product > 0 ? (s[1] + s[2] - s[0]) / (2 * std::sqrt(product)) : 1;
}

bool may_flip(const Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star) {
    if (!star.inner()) return false;
    const auto [c, d] = star.opposite;
    if (c == d || (fans.rim[c] && fans.rim[d])) return false;
    if (valence(fans, a) <= least_valence(fans, a) || valence(fans, b) <= least_valence(fans, b))
        return false;
    if (edge_star(fans, c, d).exists()) return false;
    const std::vector<std::int32_t> ring = neighbours(fans, d);
    return std::ranges::none_of(neighbours(fans, c), [&](std::int32_t n) {
        return n != a && n != b && std::ranges::find(ring, n) != ring.end();
    });
}

void flip(Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star) {
    // (a, b, c) and (b, a, d) become (d, b, c) and (c, a, d).
    const auto [c, d] = star.opposite;
    fans.triangles[star.triangle[0]] = {d, b, c};
    fans.triangles[star.triangle[1]] = {c, a, d};
    remove_from(fans.around[a], star.triangle[0]);
    remove_from(fans.around[b], star.triangle[1]);
    fans.around[c].push_back(star.triangle[1]);
    fans.around[d].push_back(star.triangle[0]);
}

std::int32_t split(Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star,
                   const Vec3& at) {
    const auto m = static_cast<std::int32_t>(fans.points.size());
    fans.points.push_back(at);
    fans.normals.push_back(Vec3::Zero());
    fans.sizes.push_back(0.5 * (fans.sizes[a] + fans.sizes[b]));
    fans.caps.push_back(std::max(fans.caps[a], fans.caps[b]));
    fans.rim.push_back(star.inner() ? 0 : 1);
    fans.watched.push_back(fans.watched[a] || fans.watched[b]);
    fans.around.emplace_back();
    for (int side = 0; side < 2; ++side) {
        const std::int32_t t = star.triangle[side];
        if (t < 0) continue;
        const auto fresh = static_cast<std::int32_t>(fans.triangles.size());
        Triangle other = fans.triangles[t];
        put(other, a, m);
        put(fans.triangles[t], b, m);
        fans.triangles.push_back(other);
        std::ranges::replace(fans.around[b], t, fresh);
        fans.around[star.opposite[side]].push_back(fresh);
        fans.around[m].push_back(t);
        fans.around[m].push_back(fresh);
    }
    return m;
}

bool closes_ring(const Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star) {
    const std::vector<std::int32_t> ring = neighbours(fans, b);
    const auto opposite = [&](std::int32_t n) {
        return n == star.opposite[0] || n == star.opposite[1];
    };
    const auto beside = [](const std::vector<std::int32_t>& of, std::int32_t n) {
        return std::ranges::find(of, n) != of.end();
    };
    for (const std::int32_t n : neighbours(fans, a)) {
        if (n == b || opposite(n)) continue;
        for (const std::int32_t m : neighbours(fans, n))
            if (m != a && !opposite(m) && beside(ring, m)) return true;
    }
    return false;
}

bool may_collapse(const Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star) {
    // Two points of the rim are one only along it; a point of the rim never goes inside.
    if (fans.rim[a] && (!fans.rim[b] || star.inner())) return false;
    const std::vector<std::int32_t> ring = neighbours(fans, b);
    for (const std::int32_t n : neighbours(fans, a)) {
        if (n == b) continue;
        const bool opposite = n == star.opposite[0] || n == star.opposite[1];
        const bool common = std::ranges::find(ring, n) != ring.end();
        if (common != opposite) return false;
        // What was a's is b's: no inner edge between points of the rim may come of it.
        if (!fans.rim[a] && fans.rim[b] && fans.rim[n] && !opposite) return false;
        if (opposite && valence(fans, n) <= least_valence(fans, n)) return false;
        if (opposite && fans.rim[n] && fans.rim[b] && edge_star(fans, b, n).inner()) return false;
    }
    const int merged = valence(fans, a) + valence(fans, b) - (star.inner() ? 4 : 3);
    return merged >= least_valence(fans, b);
}

void collapse(Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star) {
    for (const std::int32_t t : star.triangle) {
        if (t < 0) continue;
        for (const std::int32_t v : fans.triangles[t]) remove_from(fans.around[v], t);
        fans.triangles[t] = kRemoved;
    }
    for (const std::int32_t t : fans.around[a]) {
        put(fans.triangles[t], a, b);
        fans.around[b].push_back(t);
    }
    fans.around[a].clear();
}

}  // namespace myotet::surface
