// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Dynamics/ElasticBody.h"
#include "Dynamics/NodeAlgebra.h"
#include "DynamicsShapes.h"
#include "Elasticity/Materials.h"
#include "OriginSprings.h"

namespace myotet::dynamics {
namespace {

using elasticity::NeoHookean;
using test::OriginSprings;
const EquilibriumOptions kExact{.tolerance = 1e-11};

std::shared_ptr<const elasticity::PointLaw> rubber(double poisson) {
    return std::make_shared<elasticity::OneLaw<NeoHookean>>(
        NeoHookean{elasticity::lame_from(1, poisson)});
}

std::vector<std::int32_t> nodes_where(const TetMesh& mesh, auto&& holds) {
    std::vector<std::int32_t> nodes;
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (holds(mesh.points[n])) nodes.push_back(static_cast<std::int32_t>(n));
    return nodes;
}

bool on_surface(const Vec3& p, double side) { return p.minCoeff() == 0 || p.maxCoeff() == side; }

// A block whose lower face is held, and whose upper one was moved.
struct Pressed {
    TetMesh mesh;
    ElasticBody body;
    std::vector<std::int32_t> held;
    NodeVectors x;

    explicit Pressed(const Mat3& upper, int cubes = 3, double poisson = 0.45)
        : mesh(test::block(cubes, 1)),
          body(mesh, rubber(poisson)),
          held(nodes_where(mesh, [&](const Vec3& p) { return p.z() == 0 || p.z() == cubes; })),
          x(mesh.points) {
        // The inside follows in proportion to the height: a finite energy to begin with.
        const Vec3 centre(0.5 * cubes, 0.5 * cubes, 0);
        for (Vec3& p : x) {
            const Vec3 there = centre + upper * (p - centre);
            p += p.z() / cubes * (there - p);
        }
    }
};

TEST(Equilibrium, PatchTestUniformStrainIsReproduced) {
    // With every boundary node on an affine map, the inside follows it.
    const TetMesh mesh = test::block(4, 0.7);
    ElasticBody body(mesh, rubber(0.45));
    const auto held = nodes_where(mesh, [](const Vec3& p) { return on_surface(p, 4 * 0.7); });
    Mat3 A;
    A << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, 0.1, -0.2, 1.1;
    NodeVectors x = mesh.points;
    for (Vec3& p : x) p = A * p + Vec3(1, 2, 3);
    const NodeVectors exact = x;
    std::vector<char> is_held(x.size(), 0);
    for (const std::int32_t n : held) is_held[n] = 1;
    const NodeVectors off = test::random_vectors(x.size(), 0.1, 4);
    for (std::size_t n = 0; n < x.size(); ++n)
        if (!is_held[n]) x[n] += off[n];
    Equilibrium equilibrium({&body}, x.size(), held, kExact);
    EXPECT_TRUE(equilibrium.find(x).converged);
    for (std::size_t n = 0; n < x.size(); ++n) EXPECT_LT((x[n] - exact[n]).norm(), 1e-9);
}

TEST(Equilibrium, ConvergesQuadratically) {
    Pressed block(Vec3(1, 1, 0.7).asDiagonal());
    Equilibrium equilibrium({&block.body}, block.x.size(), block.held, kExact);
    const EquilibriumSummary summary = equilibrium.find(block.x);
    ASSERT_TRUE(summary.converged) << summary.message;
    // The number of right digits at least nearly doubles: r' < C r^1.8 once r is small.
    int checked = 0;
    for (std::size_t i = 1; i < summary.history.size(); ++i) {
        const double before = summary.history[i - 1], after = summary.history[i];
        if (before > 1e-2 || before < 1e-6) continue;
        EXPECT_LT(after, 10 * std::pow(before, 1.8)) << i;
        ++checked;
    }
    EXPECT_GE(checked, 1);
    EXPECT_LE(summary.iterations, 10);
}

TEST(Equilibrium, ReactionsBalance) {
    Mat3 turned = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
    turned(2, 2) = 0.8;
    Pressed block(turned);
    Equilibrium equilibrium({&block.body}, block.x.size(), block.held, kExact);
    ASSERT_TRUE(equilibrium.find(block.x).converged);
    Vec3 total = Vec3::Zero(), torque = Vec3::Zero();
    double size = 0;
    const NodeVectors f = equilibrium.forces();
    for (const std::int32_t n : block.held) {
        total += f[n];
        torque += block.x[n].cross(f[n]);
        size += f[n].norm();
    }
    EXPECT_GT(size, 1);
    EXPECT_LT(total.norm(), 1e-9 * size);
    EXPECT_LT(torque.norm(), 1e-8 * size);
}

TEST(Equilibrium, ARigidMotionOfTheHeldNodesCostsNothing) {
    Pressed block(Mat3::Identity());
    const Mat3 Q = Eigen::AngleAxisd(0.4, Vec3(1, 1, 0).normalized()).toRotationMatrix();
    const auto moved = [&](const Vec3& p) -> Vec3 { return Q * p + Vec3(1, -2, 3); };
    const NodeVectors off = test::random_vectors(block.x.size(), 0.1, 4);
    for (std::size_t n = 0; n < block.x.size(); ++n) block.x[n] = moved(block.x[n]) + off[n];
    for (const std::int32_t n : block.held) block.x[n] = moved(block.mesh.points[n]);
    Equilibrium equilibrium({&block.body}, block.x.size(), block.held, kExact);
    const EquilibriumSummary summary = equilibrium.find(block.x);
    EXPECT_TRUE(summary.converged) << summary.message;
    EXPECT_LT(summary.energy, 1e-14);  // of what rounding leaves of a stiffness of 1
    for (std::size_t n = 0; n < block.x.size(); ++n)
        EXPECT_LT((block.x[n] - moved(block.mesh.points[n])).norm(), 1e-9);
}

TEST(Equilibrium, TheEnergyNeverGrowsAndNothingInvertsFromAWildStart) {
    // Far from equilibrium, where the energy curves downwards.
    Pressed block(Vec3(1, 1, 0.5).asDiagonal(), 4);
    const NodeVectors off = test::random_vectors(block.x.size(), 0.23, 8);
    std::vector<char> held(block.x.size(), 0);
    for (const std::int32_t n : block.held) held[n] = 1;
    double scale = 1;
    NodeVectors start;
    do {  // as wild as stays positive
        start = block.x;
        for (std::size_t n = 0; n < start.size(); ++n)
            if (!held[n]) start[n] += scale * off[n];
        scale *= 0.9;
    } while (!std::isfinite(block.body.move_to(start)));
    double energy = block.body.move_to(start);
    EquilibriumOptions one = kExact;
    one.iterations = 1;
    Equilibrium step({&block.body}, start.size(), block.held, one);
    int indefinite = 0;
    for (int i = 0; i < 60; ++i) {
        const EquilibriumSummary summary = step.find(start);
        EXPECT_TRUE(std::isfinite(summary.energy));
        EXPECT_LE(summary.energy, energy * (1 + 1e-12));
        energy = summary.energy;
        indefinite += summary.indefinite_iterations;
        if (summary.converged) break;
    }
    EXPECT_GT(indefinite, 0);  // the case is there
    EXPECT_LT(step.find(start).residual, 1e-8);
}

TEST(Equilibrium, AColumnBuckles) {
    // Twenty cubes high and two wide, pressed by a fifth: straight, it is no minimum.
    TetMesh mesh = test::block(20, 1);
    const auto outside = [&](const Tet& t) {
        const Vec3 c =
            0.25 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]] + mesh.points[t[3]]);
        return c.x() > 2 || c.y() > 2;
    };
    std::erase_if(mesh.tets, outside);
    ElasticBody body(mesh, rubber(0.45));
    std::vector<std::int32_t> held = nodes_where(mesh, [](const Vec3& p) {
        return p.z() == 0 || p.z() == 20 || p.x() > 2 || p.y() > 2;  // the rest is in no element
    });
    NodeVectors x = mesh.points;
    for (Vec3& p : x) {
        p.z() *= 0.8;
        p.x() += 1e-3 * p.z() * (16 - p.z());  // which way, a symmetric column cannot tell
    }
    EquilibriumOptions many = kExact;
    many.iterations = 200;
    Equilibrium equilibrium({&body}, x.size(), held, many);
    const EquilibriumSummary summary = equilibrium.find(x);
    ASSERT_TRUE(summary.converged) << summary.message;
    EXPECT_GT(summary.indefinite_iterations, 0);
    double aside = 0;  // of the column's middle
    for (std::size_t n = 0; n < x.size(); ++n)
        if (mesh.points[n] == Vec3(1, 1, 10)) aside = (x[n] - mesh.points[n]).head<2>().norm();
    EXPECT_GT(aside, 1);
}

TEST(Equilibrium, PotentialsAddUp) {
    // A single free node between springs to the origin and the body.
    const TetMesh mesh{{Vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
    ElasticBody body(mesh, rubber(0.3));
    OriginSprings wells(0.2);
    NodeVectors x = mesh.points;
    Equilibrium equilibrium({&body, &wells}, 4, {0, 1, 2}, kExact);
    ASSERT_TRUE(equilibrium.find(x).converged);
    EXPECT_LT(x[3].z(), 0.999);
    NodeVectors pull(4, Vec3::Zero());
    (void)body.move_to(x);
    body.add_forces(pull);
    EXPECT_LT((pull[3] - 0.2 * x[3]).norm(), 1e-10);
}

TEST(Equilibrium, SaysWhyItDidNotConverge) {
    Pressed block(Vec3(1, 1, 0.5).asDiagonal());
    EquilibriumOptions few = kExact;
    few.iterations = 2;
    Equilibrium equilibrium({&block.body}, block.x.size(), block.held, few);
    const EquilibriumSummary summary = equilibrium.find(block.x);
    EXPECT_FALSE(summary.converged);
    EXPECT_EQ(summary.message, "out of iterations");
    EXPECT_EQ(summary.iterations, 2);
    NodeVectors inverted = block.mesh.points;
    inverted[21].z() += 5;
    EXPECT_FALSE(equilibrium.find(inverted).converged);
}

TEST(Equilibrium, RefusesOptionsThatMakeNoSense) {
    Pressed block(Mat3::Identity());
    const auto make = [&](const std::vector<std::int32_t>& held, const EquilibriumOptions& o) {
        return Equilibrium({&block.body}, block.x.size(), held, o);
    };
    EXPECT_THROW((void)make({0}, {.tolerance = std::nan("")}), InputError);
    EXPECT_THROW((void)make({0}, {.iterations = 0}), InputError);
    EXPECT_THROW((void)make({0}, {.linear_iterations = -1}), InputError);
    EXPECT_THROW((void)make({99999}, {}), InputError);
    EXPECT_THROW((void)make({-1}, {}), InputError);
    EXPECT_THROW((void)Equilibrium({}, 3, {}, {}), InputError);
}

TEST(Equilibrium, SameBytesOnOneThreadOrMany) {
    const auto on = [](int threads) {
        const ThreadLimit limit(threads);
        Pressed block(Vec3(1, 1, 0.8).asDiagonal(), 8);
        Equilibrium equilibrium({&block.body}, block.x.size(), block.held, {});
        EXPECT_TRUE(equilibrium.find(block.x).converged);
        return block.x;
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::dynamics
