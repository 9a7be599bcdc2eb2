// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>

#include "Fibres/FibreField.h"
#include "Phantoms/Fusiform.h"

namespace myotet::fibres::test {

inline Mat3 some_rotation() {
    return (Eigen::AngleAxisd(0.7, Vec3::UnitX()) * Eigen::AngleAxisd(-1.1, Vec3::UnitZ()))
        .toRotationMatrix();
}

/// A spindle about z: `rings` rings of triangles about the axis in `layers` layers, each
/// prism cut into three; R(z) is the radius.
inline TetMesh spindle(int rings, int layers, double length,
                       const std::function<double(double)>& radius) {
    const auto first_of = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
    const int disc = first_of(rings + 1);
    TetMesh mesh;
    for (int k = 0; k <= layers; ++k) {
        const double z = length * k / layers;
        mesh.points.emplace_back(0, 0, z);
        for (int ring = 1; ring <= rings; ++ring)
            for (int n = 0; n < 6 * ring; ++n) {
                const double angle = 2 * std::numbers::pi * n / (6 * ring);
                const double r = radius(z) * ring / rings;
                mesh.points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
            }
    }
    std::vector<Triangle> triangles;
    const auto node = [&](int ring, int n) {
        return ring == 0 ? 0 : first_of(ring) + n % (6 * ring);
    };
    for (int ring = 1; ring <= rings; ++ring)
        for (int side = 0; side < 6; ++side)
            for (int n = 0; n < ring; ++n) {
                const int out = side * ring + n, in = side * (ring - 1) + n;
                triangles.push_back({node(ring, out), node(ring, out + 1), node(ring - 1, in)});
                if (n > 0)
                    triangles.push_back(
                        {node(ring, out), node(ring - 1, in), node(ring - 1, in - 1)});
            }
    for (int k = 0; k < layers; ++k)
        for (Triangle t : triangles) {
            std::sort(t.begin(), t.end());
            for (int cut = 0; cut < 3; ++cut) {
                // The lowest numbers below, the highest above: neighbours agree.
                Tet tet;
                for (int c = 0; c < 4; ++c)
                    tet[c] = c <= cut ? t[c] + k * disc : t[c - 1] + (k + 1) * disc;
                const auto& x = mesh.points;
                if (signed_volume(x[tet[0]], x[tet[1]], x[tet[2]], x[tet[3]]) < 0)
                    std::swap(tet[2], tet[3]);
                mesh.tets.push_back(tet);
            }
        }
    return mesh;
}

inline TetMesh fusiform(int rings = 6, int layers = 50) {
    return spindle(rings, layers, phantoms::kFusiformLength, phantoms::fusiform_radius);
}

/// Files NAME.nodes (x y z in metres) and NAME.elems (part, then nodes from 0).
inline TetMesh spindle_made_elsewhere(const std::string& name) {
    constexpr double kMillimetre = 1000;  // a metre's
    TetMesh mesh;
    std::ifstream nodes(name + ".nodes"), elements(name + ".elems");
    for (Vec3 p; nodes >> p[0] >> p[1] >> p[2];) mesh.points.push_back(kMillimetre * p);
    std::int32_t part;
    for (Tet t; elements >> part >> t[0] >> t[1] >> t[2] >> t[3];) mesh.tets.push_back(t);
    return mesh;
}

/// A straight cylinder, its inner nodes moved at random.
inline TetMesh shaken_cylinder(double radius, double length) {
    constexpr int kRings = 4, kLayers = 10;
    TetMesh mesh = spindle(kRings, kLayers, length, [&](double) { return radius; });
    std::mt19937 random(11);
    std::uniform_real_distribution<double> by(-0.15 * radius / kRings, 0.15 * radius / kRings);
    for (Vec3& p : mesh.points)
        if (p.head<2>().norm() < 0.99 * radius && p.z() > 0.01 * length && p.z() < 0.99 * length)
            p += Vec3(by(random), by(random), by(random));
    return mesh;
}

/// Nodes whose z is this.
inline std::vector<std::int32_t> nodes_at(const TetMesh& mesh, double z) {
    std::vector<std::int32_t> nodes;
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (std::abs(mesh.points[n].z() - z) < 1e-9) nodes.push_back(static_cast<std::int32_t>(n));
    return nodes;
}

/// Degrees between lines: v and -v are the same.
inline double line_angle(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180 / std::numbers::pi;
}

/// Degrees by which fibres are off.
struct AngleError {
    double mean = 0, most = 0, share95 = 0;  ///< the last: 95 % are below it
};

inline AngleError angle_error(const TetMesh& mesh, const FibreField& fibres,
                              const std::function<Vec3(const Vec3&)>& truth) {
    AngleError error;
    std::vector<double> angles;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        angles.push_back(line_angle(fibres.direction[t], truth(centroid_of(mesh, mesh.tets[t]))));
        error.mean += angles.back() / static_cast<double>(mesh.tets.size());
    }
    std::sort(angles.begin(), angles.end());
    error.most = angles.back();
    error.share95 = angles[static_cast<std::size_t>(0.95 * static_cast<double>(angles.size()))];
    return error;
}

}  // namespace myotet::fibres::test
