// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
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

/// Flips edges until none has opposite angles of more than 180 degrees together, and no
/// edge stands twice (Lawson 1977, on a surface).
inline void flip_to_delaunay(TriMesh& mesh) {
    const auto cotangent = [&](std::int32_t apex, std::int32_t a, std::int32_t b) {
        const Vec3 u = mesh.points[a] - mesh.points[apex], v = mesh.points[b] - mesh.points[apex];
        return u.dot(v) / u.cross(v).norm();
    };
    for (int round = 0, changed = 1; changed && round < 100; ++round) {
        changed = 0;
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> side;  // triangle of (a, b)
        const auto enter = [&](std::int32_t f) {
            const Triangle& t = mesh.triangles[f];
            for (int i = 0; i < 3; ++i) side[{t[i], t[(i + 1) % 3]}] = f;
        };
        const auto apex = [&](std::int32_t f, std::int32_t a, std::int32_t b) {
            for (const std::int32_t v : mesh.triangles[f])
                if (v != a && v != b) return v;
            return -1;
        };
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) enter(static_cast<std::int32_t>(f));
        const auto edges = side;
        for (const auto& [edge, ignored] : edges) {
            const auto [a, b] = edge;
            if (a > b || !side.contains({a, b}) || !side.contains({b, a})) continue;
            const std::int32_t f = side[{a, b}], g = side[{b, a}], c = apex(f, a, b),
                               d = apex(g, a, b);
            if (side.contains({c, d}) || side.contains({d, c})) continue;
            if (!(cotangent(c, a, b) + cotangent(d, a, b) < -1e-9)) continue;
            side.erase({a, b});
            side.erase({b, a});
            mesh.triangles[f] = {c, a, d};
            mesh.triangles[g] = {c, d, b};
            enter(f);
            enter(g);
            changed = 1;
        }
    }
}

/// A closed surface of the shape of a stomach, a J with a wide fundus and a narrow end,
/// 150 mm high, of `count` points and so 3 count - 6 edges, spread evenly: a sphere's
/// poles are drawn out along an arc. Its front is at -y.
inline TriMesh stomach_like(int count) {
    const auto place = [](const Vec3& q) {
        const double s = 0.5 * (1 - q.z());  // from the fundus to the pylorus
        const double turn = -0.5 + 3.1 * s * s, bend = 62 - 8 * s;
        const Vec3 centre(-bend * std::cos(turn), 0, -bend * std::sin(turn) - 40 * s);
        const Vec3 out(-std::cos(turn), 0, -std::sin(turn));
        const double thick = 46 - 26 * s;
        return Vec3(centre + thick * (q.x() * out - q.y() * Vec3::UnitY()));
    };
    std::vector<Vec3> q = even_sphere(1, count).points, at(count);
    for (int round = 0; round < 400; ++round) {
        for (int i = 0; i < count; ++i) at[i] = place(q[i]);
        for (int i = 1; i < count; ++i) {
            Vec3 push = Vec3::Zero();
            for (int j = 0; j < count; ++j)
                if (i != j) push += (at[i] - at[j]) / std::pow((at[i] - at[j]).norm(), 5);
            constexpr double kStep = 1e-5;
            const Vec3 u = q[i].unitOrthogonal(), v = q[i].cross(u);
            Eigen::Matrix<double, 3, 2> slope;
            slope << (place((q[i] + kStep * u).normalized()) - at[i]) / kStep,
                (place((q[i] + kStep * v).normalized()) - at[i]) / kStep;
            const Eigen::Matrix2d square = slope.transpose() * slope;
            const Vec3 step = 2e4 / std::pow(count, 0.5) * push;
            const Eigen::Vector2d along = square.ldlt().solve(slope.transpose() * step);
            const double size = std::min(1.0, 0.05 / along.norm());
            q[i] = (q[i] + size * (along[0] * u + along[1] * v)).normalized();
        }
    }
    TriMesh mesh = hull_of_sphere(q);
    for (Vec3& p : mesh.points) p = place(p);
    flip_to_delaunay(mesh);
    return mesh;
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
