// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "Core/TetMesh.h"

namespace myotet::test {

/// Unit vectors spread evenly over the sphere (a golden spiral).
inline std::vector<Vec3> directions(int count) {
    std::vector<Vec3> out;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - 2 * (i + 0.5) / count, angle = i * 2.399963229728653;
        const double r = std::sqrt(1 - z * z);
        out.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    return out;
}

inline Vec3 torus_point(double major, double minor, double u, double v) {
    const double r = major + minor * std::cos(v);
    return {r * std::cos(u), r * std::sin(u), minor * std::sin(v)};
}

/// A torus about z with `n` x `m` quadrilaterals, each split in two.
inline TriMesh torus_surface(double major, double minor, int n, int m) {
    TriMesh mesh;
    const double turn = 2 * std::numbers::pi;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j)
            mesh.points.push_back(torus_point(major, minor, turn * i / n, turn * j / m));
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const int a = i * m + j, b = (i + 1) % n * m + j;
            const int c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    return mesh;
}

/// A sphere of `n` rings between its poles and 2 n points a ring.
inline TriMesh sphere_surface(const Vec3& centre, double radius, int n) {
    TriMesh mesh;
    const int m = 2 * n;
    mesh.points.push_back(centre + radius * Vec3::UnitZ());
    for (int i = 1; i <= n; ++i)
        for (int j = 0; j < m; ++j) {
            const double t = std::numbers::pi * i / (n + 1), u = 2 * std::numbers::pi * j / m;
            mesh.points.push_back(centre + radius * Vec3(std::sin(t) * std::cos(u),
                                                         std::sin(t) * std::sin(u), std::cos(t)));
        }
    mesh.points.push_back(centre - radius * Vec3::UnitZ());
    const int south = 1 + n * m;
    for (int j = 0; j < m; ++j) {
        const int k = (j + 1) % m;
        mesh.triangles.push_back({0, 1 + j, 1 + k});
        for (int i = 0; i + 1 < n; ++i) {
            const int a = 1 + i * m + j, b = 1 + (i + 1) * m + j;
            const int c = 1 + (i + 1) * m + k, d = 1 + i * m + k;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
        mesh.triangles.push_back({1 + (n - 1) * m + j, south, 1 + (n - 1) * m + k});
    }
    return mesh;
}

}  // namespace myotet::test
