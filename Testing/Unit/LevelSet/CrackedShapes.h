// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <random>

#include "SurfaceShapes.h"

namespace myotet::test {

inline void turn_all(TriMesh& surface) {
    for (Triangle& t : surface.triangles) std::swap(t[0], t[1]);
}

inline TriMesh together(TriMesh a, const TriMesh& b) {
    const auto first = static_cast<std::int32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const Triangle& t : b.triangles)
        a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return a;
}

/// Which cube of side `size` holds a triangle's middle: a number for the patch.
inline int patch_of(const TriMesh& surface, std::size_t triangle, double size) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : surface.triangles[triangle]) middle += surface.points[v] / 3;
    int number = 0;
    for (int a = 0; a < 3; ++a)
        number = 64 * number + static_cast<int>(std::floor(middle[a] / size)) + 32;
    return number;
}

/// Each patch gets points of its own, moved by up to `shift` along each axis:
/// cracks and overlaps between the patches.
inline TriMesh cut_into_patches(const TriMesh& surface, double size, double shift = 0) {
    TriMesh cut;
    std::map<std::pair<int, std::int32_t>, std::int32_t> point_of;
    std::map<int, Vec3> shift_of;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-shift, shift);
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
        const int patch = patch_of(surface, n, size);
        if (!shift_of.contains(patch))
            shift_of[patch] = Vec3(part(random), part(random), part(random));
        Triangle t = surface.triangles[n];
        for (std::int32_t& v : t) {
            const auto [it, fresh] =
                point_of.try_emplace({patch, v}, static_cast<std::int32_t>(cut.points.size()));
            if (fresh) cut.points.push_back(surface.points[v] + shift_of[patch]);
            v = it->second;
        }
        cut.triangles.push_back(t);
    }
    return cut;
}

}  // namespace myotet::test
