// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "Contraction/Contact.h"
#include "Dynamics/NodeAlgebra.h"
#include "Dynamics/Potential.h"
#include "LevelSet/Primitives.h"
#include "Support/AnalyticLevelSet.h"
#include "Unit/Dynamics/DynamicsShapes.h"

namespace myotet::contraction::test {

using dynamics::add_scaled;
using dynamics::BlockMatrix;
using dynamics::dot;
using dynamics::NodeVectors;
using dynamics::test::block;
using dynamics::test::random_vectors;

// Central differences over this step err by its square and by rounding / step.
inline constexpr double kStep = 1e-5, kDifference = 1e-6;
// Sums of some hundred terms of about 1.
inline constexpr double kRounding = 1e-12;
// What forces that balance to 1e-6 of all, and a level set of floats, leave of a solution.
inline constexpr double kSolved = 2e-5;

inline ContactField ball_field(double radius, double spacing) {
    return {std::make_shared<levelset::LevelSet>(support::sample_level_set(
                support::cube(radius + 4), spacing,
                [=](const Vec3& p) { return levelset::sphere_distance(p, Vec3::Zero(), radius); })),
            {}};
}

/// Below the plane z = 0.
inline ContactField floor_field() {
    return {std::make_shared<levelset::LevelSet>(support::sample_level_set(
                support::cube(8), 0.5, [](const Vec3& p) { return p.z(); })),
            {}};
}

/// The cube from 0 to `side` along each axis.
inline ContactField cube_field(double side, double spacing) {
    Box box;
    box.include(Vec3::Constant(-4));
    box.include(Vec3::Constant(side + 4));
    return {std::make_shared<levelset::LevelSet>(support::sample_level_set(
                box, spacing,
                [=](const Vec3& p) {
                    return levelset::box_distance(p - Vec3::Constant(side / 2),
                                                  Vec3::Constant(side / 2));
                })),
            {}};
}

inline NodeVectors forces_at(dynamics::Potential& potential, const NodeVectors& x) {
    NodeVectors f(x.size(), Vec3::Zero());
    EXPECT_TRUE(std::isfinite(potential.move_to(x)));
    potential.add_forces(f);
    return f;
}

inline BlockMatrix stiffness_at(dynamics::Potential& potential, const NodeVectors& x) {
    BlockMatrix K = dynamics::block_pattern(x.size(), potential.cliques());
    (void)potential.move_to(x);
    potential.add_stiffness(K);
    return K;
}

/// Forces are minus the gradient of the energy, the stiffness minus that of the forces.
inline void expect_derivatives(dynamics::Potential& potential, const NodeVectors& x) {
    const NodeVectors f = forces_at(potential, x);
    (void)stiffness_at(potential, x);  // whole from the second time on
    const BlockMatrix K = stiffness_at(potential, x);
    for (unsigned seed = 1; seed < 6; ++seed) {
        const NodeVectors d = random_vectors(x.size(), 1, seed),
                          e = random_vectors(x.size(), 1, seed + 10);
        NodeVectors up = x, down = x;
        add_scaled(kStep, d, up);
        add_scaled(-kStep, d, down);
        const double slope = (potential.move_to(up) - potential.move_to(down)) / (2 * kStep);
        EXPECT_NEAR(dot(f, d), -slope, kDifference * (1 + std::abs(slope)));
        NodeVectors change = forces_at(potential, down);
        add_scaled(-1, forces_at(potential, up), change);
        const NodeVectors product = dynamics::multiply(K, d);
        // Nodes that begin or cease to touch within the step, and those that pass from one
        // cell of the spline to the next, see their stiffness jump there.
        for (std::size_t n = 0; n < d.size(); ++n)
            EXPECT_LT((product[n] - change[n] / (2 * kStep)).norm(),
                      kDifference * (1 + product[n].norm()))
                << n;
        EXPECT_NEAR(dot(e, product), dot(d, dynamics::multiply(K, e)), kRounding * 100);
    }
}

/// Faces of the boundary whose corners all have this z.
inline std::vector<Triangle> faces_at(const TetMesh& mesh, double z) {
    std::vector<Triangle> some;
    for (const Triangle& t : boundary_faces(mesh.tets))
        if (std::abs(mesh.points[t[0]].z() - z) < 1e-9 &&
            std::abs(mesh.points[t[1]].z() - z) < 1e-9 &&
            std::abs(mesh.points[t[2]].z() - z) < 1e-9)
            some.push_back(t);
    return some;
}

inline std::vector<std::int32_t> nodes_at(const TetMesh& mesh, double z) {
    std::vector<std::int32_t> some;
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (std::abs(mesh.points[n].z() - z) < 1e-9) some.push_back(static_cast<std::int32_t>(n));
    return some;
}

/// Of a column of neo-Hookean material without a second constant, pressed by p: how short
/// it is, lambda of mu (1 / lambda - lambda) = p. It does not bulge.
inline double shortened(double mu, double p) {
    const double half = 0.5 * p / mu;
    return std::sqrt(half * half + 1) - half;
}

}  // namespace myotet::contraction::test
