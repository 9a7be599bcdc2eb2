// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Newmark.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Parallel.h"
#include "Dynamics/MeshForces.h"
#include "Dynamics/StrainLimit.h"
#include "DynamicsShapes.h"

namespace myotet::dynamics {
namespace {

constexpr SolverOptions kExact{1e-13, 1000};

State run(Problem& problem, State state, double step, int steps,
          const SolverOptions& options = kExact) {
    problem.forces->move_to(state.x);
    for (int i = 0; i < steps; ++i)
        EXPECT_TRUE(newmark_step(problem, step, options, state).converged);
    return state;
}

// Error at the time 1 of an oscillator of mass 1 against its closed form.
double oscillator_error(double k, double c, int steps) {
    test::Wells wells(k, c);
    Problem problem{{1.0}, &wells};
    const State end = run(problem, {{Vec3(1, 0, 0)}, {Vec3(0, 1, 0)}}, 1.0 / steps, steps);
    const double decay = std::exp(-c / 2), w = std::sqrt(k - c * c / 4);
    const Vec3 exact(decay * (std::cos(w) + c / (2 * w) * std::sin(w)), decay * std::sin(w) / w, 0);
    return (end.x[0] - exact).norm();
}

TEST(Newmark, IsOfSecondOrderOnAnUndampedOscillator) {
    const double coarse = oscillator_error(30, 0, 64), fine = oscillator_error(30, 0, 128);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
    EXPECT_LT(fine, 1e-2);
}

TEST(Newmark, ConvergesWithDamping) {
    // The half step is implicit in the damping: first order there, by design.
    const double coarse = oscillator_error(30, 2, 128), fine = oscillator_error(30, 2, 256);
    EXPECT_GT(std::log2(coarse / fine), 0.95);
    EXPECT_LT(fine, 2e-2);
}

TEST(Newmark, KeepsTheEnergyOfAnUndampedOscillatorBounded) {
    test::Wells wells(30, 0);
    Problem problem{{1.0}, &wells};
    State state{{Vec3(1, 0, 0)}, {Vec3::Zero()}};
    wells.move_to(state.x);
    for (int i = 0; i < 20000; ++i) {
        ASSERT_TRUE(newmark_step(problem, 0.05, kExact, state).converged);
        const double energy = 15 * state.x[0].squaredNorm() + 0.5 * state.v[0].squaredNorm();
        ASSERT_NEAR(energy / 15, 1, 0.1) << i;
    }
}

TEST(Newmark, IsStableWhereAnExplicitSchemeBlowsUp) {
    // Explicit damping is stable for c dt / m < 2; here it is 50.
    test::Wells wells(1, 500);
    Problem problem{{1.0}, &wells};
    const State end = run(problem, {{Vec3(1, 0, 0)}, {Vec3(10, 0, 0)}}, 0.1, 1000);
    EXPECT_LT(end.x[0].norm(), 1.1);
    EXPECT_LT(end.v[0].norm(), 0.01);
}

/// A block of rubber thrown and twisted.
struct Thrown {
    TetMesh mesh = test::block(3, 1);
    std::vector<double> masses = elasticity::nodal_masses(mesh, 1);
    elasticity::NeoHookean law{elasticity::lame_from(1, 0.3)};
    ElementForces elements{mesh, [this](const Mat3& F) { return law.stress(F); }, {0.05, 0.05}};
    SpringForces springs{mesh, masses, {.sound_speed = 1}};
    State state{mesh.points, test::random_vectors(mesh.points.size(), 0.3, 4)};

    [[nodiscard]] std::pair<Vec3, Vec3> momenta(const State& s) const {
        Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
        for (std::size_t i = 0; i < masses.size(); ++i) {
            linear += masses[i] * s.v[i];
            angular += masses[i] * s.x[i].cross(s.v[i]);
        }
        return {linear, angular};
    }
};

TEST(Newmark, MomentumIsKeptToRoundingWithLimitsActive) {
    Thrown thrown;
    for (ForceField* field :
         {static_cast<ForceField*>(&thrown.elements), static_cast<ForceField*>(&thrown.springs)}) {
        Problem problem{thrown.masses, field};
        const AltitudeLimiter limiter(thrown.mesh, thrown.masses, {.strain = 0.02, .rate = 0.002});
        bool active = false;
        problem.limit = [&](const NodeVectors& x, NodeVectors& v, double dt) {
            const NodeVectors before = v;
            limiter(x, v, dt);
            active = active || before != v;
        };
        const auto before = thrown.momenta(thrown.state);
        const State end = run(problem, thrown.state, 0.02, 60);
        const auto after = thrown.momenta(end);
        EXPECT_TRUE(active);
        EXPECT_LT((after.first - before.first).norm(), 1e-10);
        // The torque of a step is exact to the order of the scheme alone: positions
        // and velocities are half a step apart.
        EXPECT_LT((after.second - before.second).norm(), 0.02 * (1 + before.second.norm()));
    }
}

TEST(Newmark, ConstraintsHoldAndLeaveTheRestFree) {
    Thrown thrown;
    Problem problem{thrown.masses, &thrown.elements};
    const Vec3 up = Vec3(1, 2, 2) / 3;
    problem.constraints = {{0, up, 0.25}, {5, Vec3::UnitX(), 0}};
    const State end = run(problem, thrown.state, 0.02, 20);
    EXPECT_NEAR(end.v[0].dot(up), 0.25, 1e-9);
    EXPECT_NEAR(end.v[5].x(), 0, 1e-9);
    EXPECT_NEAR(end.x[5].x(), thrown.mesh.points[5].x(), 1e-9);
    EXPECT_GT(end.v[5].norm(), 1e-3);
}

TEST(Newmark, SameBytesOnOneThreadOrMany) {
    const auto end = [](int threads) {
        const ThreadLimit limit(threads);
        Thrown thrown;
        Problem problem{thrown.masses, &thrown.springs};
        return run(problem, thrown.state, 0.02, 10, {1e-8, 200}).x;
    };
    EXPECT_EQ(end(1), end(3));
}

TEST(SolveDamped, SaysWhenItDoesNotConverge) {
    Thrown thrown;
    Problem problem{thrown.masses, &thrown.elements};
    NodeVectors v = thrown.state.v;
    const SolverSummary summary = solve_damped(problem, 50, v, {1e-12, 2}, v);
    EXPECT_FALSE(summary.converged);
    EXPECT_EQ(summary.iterations, 2);
    EXPECT_GT(summary.residual, 1e-12);
}

}  // namespace
}  // namespace myotet::dynamics
