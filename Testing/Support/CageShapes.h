// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "Core/TetMesh.h"

namespace myotet::testing {

/// A closed tube about a curve: `rings` rings of `sides` points, a point at each end. `centre`
/// and `radius` are asked at parts of the way from 0 to 1; the curve lies in the plane z = 0.
inline TriMesh tube(int rings, int sides, const std::function<Vec3(double)>& centre,
                    const std::function<double(double)>& radius) {
    TriMesh mesh;
    const auto number = [&](int i, int j) { return i * sides + (j + sides) % sides; };
    for (int i = 0; i < rings; ++i) {
        const double s = (i + 0.5) / rings, step = 1e-5;
        const Vec3 along = (centre(s + step) - centre(s - step)).normalized();
        const Vec3 across = along.cross(Vec3::UnitZ());
        for (int j = 0; j < sides; ++j) {
            const double turn = 2 * std::numbers::pi * j / sides;
            mesh.points.push_back(
                centre(s) + radius(s) * (std::cos(turn) * across + std::sin(turn) * Vec3::UnitZ()));
        }
    }
    for (int i = 0; i + 1 < rings; ++i)
        for (int j = 0; j < sides; ++j) {
            mesh.triangles.push_back({number(i, j), number(i, j + 1), number(i + 1, j)});
            mesh.triangles.push_back({number(i, j + 1), number(i + 1, j + 1), number(i + 1, j)});
        }
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(centre(0));
    mesh.points.push_back(centre(1));
    for (int j = 0; j < sides; ++j) {
        mesh.triangles.push_back({first, number(0, j + 1), number(0, j)});
        mesh.triangles.push_back({first + 1, number(rings - 1, j), number(rings - 1, j + 1)});
    }
    if (volume(mesh) < 0)
        for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

/// A bent capsule, as a banana: 60 mm along its middle, 12 mm thick, with rounded ends.
inline TriMesh banana(int rings = 80, int sides = 40) {
    constexpr double kBend = 35, kHalfAngle = 30 / kBend, kRadius = 6;
    return tube(
        rings, sides,
        [](double s) {
            const double turn = kHalfAngle * (2 * s - 1);
            return Vec3(kBend * std::sin(turn), kBend * (1 - std::cos(turn)), 0);
        },
        [](double s) {
            const double end = std::min(s, 1 - s) * 60 / kRadius;
            return end >= 1 ? kRadius : kRadius * std::sqrt(1 - (1 - end) * (1 - end));
        });
}

/// A torus about z.
inline TriMesh ring(double large, double small, int around = 60, int sides = 24) {
    TriMesh mesh;
    const auto number = [&](int i, int j) { return (i % around) * sides + j % sides; };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < sides; ++j) {
            const double u = 2 * std::numbers::pi * i / around,
                         v = 2 * std::numbers::pi * j / sides;
            const double r = large + small * std::cos(v);
            mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), small * std::sin(v));
            mesh.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
            mesh.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
        }
    return mesh;
}

/// A box, two triangles a side.
inline TriMesh block(const Vec3& low, const Vec3& high) {
    TriMesh mesh;
    for (int c = 0; c < 8; ++c)
        mesh.points.emplace_back(c & 1 ? high[0] : low[0], c & 2 ? high[1] : low[1],
                                 c & 4 ? high[2] : low[2]);
    for (const auto& q : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                          std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
    }
    return mesh;
}

inline TriMesh moved(TriMesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.points) p += by;
    return mesh;
}

inline TriMesh turned_inside_out(TriMesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

inline TriMesh together(TriMesh a, const TriMesh& b) {
    const auto first = static_cast<std::int32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const Triangle& t : b.triangles)
        a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return a;
}

}  // namespace myotet::testing
