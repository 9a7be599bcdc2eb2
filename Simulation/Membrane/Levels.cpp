// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Levels.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "Core/Errors.h"
#include "Membrane/Overlaps.h"
#include "Surface/Crossings.h"

namespace myotet::membrane {

namespace {

// Whether b lies in the plane of a but for rounding: there "through" has no meaning.
bool in_one_plane(const TriMesh& surface, const Triangle& a, const Triangle& b) {
    constexpr double kRounding = 1e-9;
    const Vec3& p = surface.points[a[0]];
    const Vec3 u = surface.points[a[1]] - p, n = u.cross(surface.points[a[2]] - p).normalized();
    return std::all_of(b.begin(), b.end(), [&](auto v) {
        return std::abs(n.dot(surface.points[v] - p)) < kRounding * u.norm();
    });
}

void check_places(const TriMesh& surface) {
    for (std::size_t v = 0; v < surface.points.size(); ++v)
        if (!surface.points[v].allFinite())
            throw InputError("point " + std::to_string(v) +
                             " of the surface has a place that is not finite; mend it");
    for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
        const auto& [a, b, c] = surface.triangles[f];
        const Vec3& p = surface.points[a];
        if (!((surface.points[b] - p).cross(surface.points[c] - p).norm() > 0))
            throw InputError("triangle " + std::to_string(f) +
                             " of the surface has no area, but every one must; remove it");
    }
    for (const auto& [f, g] : surface::crossings(surface.points, surface.triangles))
        if (!in_one_plane(surface, surface.triangles[f], surface.triangles[g]))
            throw InputError("triangles " + std::to_string(f) + " and " + std::to_string(g) +
                             " of the surface cross, but none may; mend the surface");
    if (const auto both = overlap_in_plane(surface))
        throw InputError("triangles " + std::to_string((*both)[0]) + " and " +
                         std::to_string((*both)[1]) +
                         " of the surface cover the same part of a plane, but none may; mend the "
                         "surface");
}

void check_count(std::size_t triangles, int count) {
    constexpr double kMost = 1073741824.0;  // 2^30: half-edges fit 32 bits
    if (count < 0 || !(std::ldexp(static_cast<double>(triangles), 2 * count) <= kMost))
        throw InputError("levels is " + std::to_string(count) + ", but must be 0 or more with " +
                         std::to_string(triangles) +
                         " triangles times 4 to its power at most 2^30");
}

}  // namespace

TriMesh Levels::surface(int level) const {
    const HalfEdges& mesh = meshes[level];
    return {{rest.begin(), rest.begin() + mesh.vertex_count}, mesh.triangles};
}

Levels make_levels(const TriMesh& surface, int count) {
    check_count(surface.triangles.size(), count);
    Levels levels;
    levels.meshes.push_back(
        make_half_edges(surface.triangles, static_cast<std::int32_t>(surface.points.size())));
    check_places(surface);
    levels.rest = surface.points;
    for (int level = 0; level < count; ++level) {
        const HalfEdges& mesh = levels.meshes.back();
        for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
            const std::int32_t h = mesh.edges[e];
            levels.ends.push_back({mesh.from(h), mesh.to(h)});
            levels.stencils.push_back(midpoint_stencil(mesh, static_cast<std::int32_t>(e)));
            levels.rest.push_back(levels.stencils.back().apply(levels.rest));
        }
        levels.meshes.push_back(split_in_four(mesh));
    }
    return levels;
}

}  // namespace myotet::membrane
