// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "Core/TetMesh.h"

namespace myotet {

/// Convex hull of points in general position on a sphere about the origin, by
/// trying every triple: for small counts.
inline TriMesh hull_of_sphere(std::vector<Vec3> points) {
    TriMesh mesh{std::move(points), {}};
    const auto& p = mesh.points;
    const auto n = static_cast<std::int32_t>(p.size());
    for (std::int32_t a = 0; a < n; ++a)
        for (std::int32_t b = a + 1; b < n; ++b)
            for (std::int32_t c = b + 1; c < n; ++c) {
                Vec3 normal = (p[b] - p[a]).cross(p[c] - p[a]);
                const bool outward = normal.dot(p[a]) > 0;
                if (!outward) normal = -normal;
                const double level = normal.dot(p[a]);
                const bool face = std::none_of(p.begin(), p.end(), [&](const Vec3& q) {
                    return normal.dot(q) > level * (1 + 1e-12);
                });
                if (face) mesh.triangles.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
            }
    return mesh;
}

/// `count` points spread evenly over a sphere: a spiral, then driven apart as like
/// charges are. The first is a pole, at +z.
inline TriMesh even_sphere(double radius, int count) {
    std::vector<Vec3> points(count);
    for (int i = 0; i < count; ++i) {
        const double z = 1 - 2.0 * i / (count - 1),
                     turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
        const double around = std::sqrt(std::max(0.0, 1 - z * z));
        points[i] = {around * std::cos(turn), around * std::sin(turn), z};
    }
    for (int round = 0; round < 300; ++round) {
        std::vector<Vec3> push(count, Vec3::Zero());
        for (int i = 0; i < count; ++i)
            for (int j = 0; j < count; ++j)
                if (i != j) {
                    const Vec3 away = points[i] - points[j];
                    push[i] += away / std::pow(away.norm(), 3);
                }
        for (int i = 1; i < count; ++i)
            points[i] = (points[i] + 0.5 / std::pow(count, 1.5) * push[i]).normalized();
    }
    for (Vec3& p : points) p *= radius;
    return hull_of_sphere(std::move(points));
}

/// The icosahedron's triangles in four, `times` over, every point on the sphere.
inline TriMesh ico_sphere(double radius, int times) {
    const double g = std::numbers::phi;
    std::vector<Vec3> corners;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-g, g}) {
            corners.emplace_back(0, s, t);
            corners.emplace_back(s, t, 0);
            corners.emplace_back(t, 0, s);
        }
    for (Vec3& c : corners) c.normalize();
    TriMesh mesh = hull_of_sphere(corners);
    for (int k = 0; k < times; ++k) {
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
        const auto mid = [&](std::int32_t a, std::int32_t b) {
            const auto [at, made] = middle.try_emplace(
                std::minmax(a, b), static_cast<std::int32_t>(mesh.points.size()));
            if (made) mesh.points.push_back((mesh.points[a] + mesh.points[b]).normalized());
            return at->second;
        };
        std::vector<Triangle> parts;
        for (const auto& [a, b, c] : mesh.triangles) {
            const auto ab = mid(a, b), bc = mid(b, c), ca = mid(c, a);
            parts.insert(parts.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(parts);
    }
    for (Vec3& p : mesh.points) p *= radius;
    return mesh;
}

/// A sheet of `columns` by `rows` rhombi of equilateral triangles in z = 0, its
/// sides along x; odd rows are shifted by half an edge.
inline TriMesh sheet(int columns, int rows, double edge) {
    TriMesh mesh;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            mesh.points.emplace_back((i + 0.5 * (j % 2)) * edge, j * edge * std::sqrt(0.75), 0);
    const auto at = [&](int i, int j) { return j * (columns + 1) + i; };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const std::int32_t a = at(i, j), b = at(i + 1, j), c = at(i, j + 1),
                               d = at(i + 1, j + 1);
            if (j % 2 == 0)
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
            else
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
        }
    return mesh;
}

}  // namespace myotet
