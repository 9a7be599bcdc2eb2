// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>

#include "Play/Stepper.h"
#include "Support/ReferenceCase.h"

namespace myotet::play::test {

/// A block with a corner at `low`.
inline TetMesh block_at(const Vec3& low, const Vec3& size, const std::array<int, 3>& cells) {
    TetMesh mesh = myotet::test::five_tet_block(size, cells);
    for (Vec3& p : mesh.points) p += low;
    return mesh;
}

/// A ball of radius r about a centre: a block of n^3 cells, drawn onto spheres.
inline TetMesh ball_at(const Vec3& centre, double r, int n) {
    TetMesh mesh = myotet::test::five_tet_block({2, 2, 2}, {n, n, n});
    for (Vec3& p : mesh.points) {
        const Vec3 q = p - Vec3::Ones();
        // A cube's shell goes to a sphere's [Nowell 2005]: smooth, and positive everywhere.
        const Vec3 s = q.cwiseProduct(q);
        const Vec3 ball(q.x() * std::sqrt(1 - s.y() / 2 - s.z() / 2 + s.y() * s.z() / 3),
                        q.y() * std::sqrt(1 - s.z() / 2 - s.x() / 2 + s.z() * s.x() / 3),
                        q.z() * std::sqrt(1 - s.x() / 2 - s.y() / 2 + s.x() * s.y() / 3));
        p = centre + r * ball;
    }
    return mesh;
}

/// A spindle along z from 0 to `length`, of radius 5 to 10 mm as the phantom's belly times
/// `wider`: n x n cells across, m along.
inline TetMesh spindle(double length, double wider, int n, int m) {
    TetMesh mesh = myotet::test::five_tet_block({2, 2, 1}, {n, n, m});
    for (Vec3& p : mesh.points) {
        const double s = std::sin(M_PI * p.z()), r = wider * (5 + 5 * s * s);
        const double x = p.x() - 1, y = p.y() - 1;
        // A square to a disc [Nowell 2005].
        p = {r * x * std::sqrt(1 - y * y / 2), r * y * std::sqrt(1 - x * x / 2), length * p.z()};
    }
    return mesh;
}

inline std::vector<Vec3> shaken(std::vector<Vec3> x, double by, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-by, by);
    for (Vec3& p : x) p += Vec3(part(random), part(random), part(random));
    return x;
}

inline Vec3 momentum(const World& world, const State& state) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < state.v.size(); ++n) sum += world.masses[n] * state.v[n];
    return sum;
}

inline Vec3 centre_of_mass(const World& world, const State& state) {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (std::size_t n = 0; n < state.x.size(); ++n) {
        sum += world.masses[n] * state.x[n];
        mass += world.masses[n];
    }
    return sum / mass;
}

/// Flesh-like bodies whose surfaces keep 0.5 mm apart.
inline World empty_world() {
    World world;
    world.contact = {.gap = 0.5, .stiffness = 0.05, .friction = 0.3};
    return world;
}

inline Obstacle floor_at(double z) {
    Obstacle floor;
    floor.name = "floor";
    floor.point = {0, 0, z};
    return floor;
}

}  // namespace myotet::play::test
