// SPDX-License-Identifier: Apache-2.0
#include "Membrane/SelfContact.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "Core/Nearest.h"

namespace myotet::membrane {

namespace {

constexpr double kFacing = -0.2;  // cosine of normals that face each other
constexpr double kKeptGap = 0.9;  // of the distance at rest

std::vector<Vec3> normals_of(const Active& active, std::span<const Vec3> x) {
    std::vector<Vec3> normal(x.size(), Vec3::Zero());
    for (const auto& [a, b, c] : active.drawn) {
        const Vec3 n = (x[b] - x[a]).cross(x[c] - x[a]);
        for (const std::int32_t v : {a, b, c}) normal[v] += n;
    }
    for (const std::int32_t v : active.nodes) normal[v].stableNormalize();
    return normal;
}

Vec3 normal_of(const Triangle& t, std::span<const Vec3> x) {
    return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).stableNormalized();
}

// A drawn triangle as a ball about its middle.
struct Part {
    Triangle corners;
    Vec3 middle, normal, rest_normal;
    double radius;
};

// By their middles' x.
std::vector<Part> parts_of(const Levels& levels, const Active& active, std::span<const Vec3> x) {
    std::vector<Part> parts;
    for (const Triangle& t : active.drawn) {
        const Vec3 middle = (x[t[0]] + x[t[1]] + x[t[2]]) / 3;
        double square = 0;
        for (const std::int32_t v : t) square = std::max(square, (x[v] - middle).squaredNorm());
        parts.push_back({t, middle, normal_of(t, x), normal_of(t, levels.rest), std::sqrt(square)});
    }
    std::ranges::stable_sort(parts, {}, [](const Part& part) { return part.middle.x(); });
    return parts;
}

// Whether a part faces a node of these normals, and is nearer to it than `reach`.
bool faces(const Part& part, const Vec3& at, const Vec3& normal, const Vec3& rest, double reach) {
    const double far = reach + part.radius;
    return (part.middle - at).squaredNorm() < far * far && normal.dot(part.normal) < kFacing &&
           rest.dot(part.rest_normal) < kFacing;
}

// By the distance at rest, and whether cavity or outside lies between.
double gap_of(const Part& part, std::int32_t node, const Levels& levels, const Wall& wall) {
    const auto& [a, b, c] = part.corners;
    const std::vector<Vec3>& rest = levels.rest;
    const Vec3 line = rest[node] - nearest_on_triangle(rest[node], rest[a], rest[b], rest[c]).point;
    const double kept = (line.dot(part.rest_normal) < 0 ? 2 : 0.5) * wall.thickness;
    return std::min(kept, kKeptGap * line.norm());
}

}  // namespace

FacingWalls find_facing(const Levels& levels, const Wall& wall, const Active& active,
                        std::span<const Vec3> x, double margin) {
    const double reach = 2 * wall.thickness + margin;
    const std::vector<Vec3> now = normals_of(active, x), rest = normals_of(active, levels.rest);
    const std::vector<Part> parts = parts_of(levels, active, x);
    double widest = 0;
    for (const Part& part : parts) widest = std::max(widest, part.radius);
    FacingWalls facing;
    for (const std::int32_t v : active.nodes) {
        if (!(active.inertia[v] > 0)) continue;
        Facing found{.node = v, .first = facing.parts.size()};
        const double low = x[v].x() - reach - widest, high = x[v].x() + reach + widest;
        for (auto part = std::ranges::lower_bound(parts, low, {},
                                                  [](const Part& p) { return p.middle.x(); });
             part != parts.end() && part->middle.x() <= high; ++part) {
            if (!faces(*part, x[v], now[v], rest[v], reach)) continue;
            const auto& [a, b, c] = part->corners;
            if (a == v || b == v || c == v) continue;
            if ((nearest_on_triangle(x[v], x[a], x[b], x[c]).point - x[v]).norm() < reach)
                facing.parts.push_back({part->corners, gap_of(*part, v, levels, wall)});
        }
        found.last = facing.parts.size();
        if (found.last > found.first) facing.nodes.push_back(found);
    }
    return facing;
}

double least_clearance(const Levels& levels) {
    constexpr double kMostPairs = 4e6, kBulge = 0.1;  // of an edge, between two levels
    const TriMesh given = levels.surface(0);
    if (static_cast<double>(given.points.size()) * static_cast<double>(given.triangles.size()) >
        kMostPairs)
        return 0;
    std::vector<Vec3> normal(given.points.size(), Vec3::Zero());
    double longest = 0;
    for (const auto& [a, b, c] : given.triangles) {
        const Vec3 n = (given.points[b] - given.points[a]).cross(given.points[c] - given.points[a]);
        for (const std::int32_t v : {a, b, c}) normal[v] += n;
        longest = std::max(longest, (given.points[b] - given.points[a]).norm());
    }
    double least = HUGE_VAL;
    for (const Triangle& t : given.triangles) {
        const auto& [a, b, c] = t;
        const Vec3 n = normal_of(t, given.points);
        const Vec3 middle = (given.points[a] + given.points[b] + given.points[c]) / 3;
        for (std::size_t v = 0; v < given.points.size(); ++v) {
            const Vec3& x = given.points[v];
            if (!((x - middle).norm() < least + longest) ||
                !(normal[v].dot(n) < kFacing * normal[v].norm()))
                continue;
            least = std::min(
                least,
                (nearest_on_triangle(x, given.points[a], given.points[b], given.points[c]).point -
                 x)
                    .norm());
        }
    }
    return std::max(0.0, least - 2 * kBulge * longest);
}

double add_self_contact(const FacingWalls& facing, const Wall& wall, const Active& active,
                        std::span<const Vec3> x, std::vector<Vec3>& force) {
    double held = 0;
    for (const Facing& f : facing.nodes) {
        const FacingPart* met = nullptr;
        OnTriangle where{};
        double depth = 0;
        for (std::size_t i = f.first; i < f.last; ++i) {
            const auto& [a, b, c] = facing.parts[i].corners;
            const OnTriangle near = nearest_on_triangle(x[f.node], x[a], x[b], x[c]);
            const double deep = facing.parts[i].gap - (x[f.node] - near.point).norm();
            if (!(deep > depth)) continue;
            met = &facing.parts[i];
            where = near;
            depth = deep;
        }
        if (!met || !(depth < met->gap)) continue;
        const double stiffness = wall.contact_stiffness * area_of_mass(wall) * active.mass[f.node];
        const Vec3 push = stiffness * depth * (x[f.node] - where.point).normalized();
        force[f.node] += push;
        for (int i = 0; i < 3; ++i) force[met->corners[i]] -= where.weights[i] * push;
        held += stiffness * depth * depth;
    }
    return held / 2;
}

}  // namespace myotet::membrane
