// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>
#include <cmath>

#include "Elasticity/Viscous.h"
#include "ImplicitShapes.h"
#include "OriginSprings.h"

namespace myotet::dynamics {
namespace {

using test::Block;
using test::distance;
using test::kExact;
using test::OriginSprings;
using test::rubber;

// Where a stretched block is after 0.2 ms, about the period of its slowest vibration. Points of
// a viscous law begin at rest.
NodeVectors released(const ImplicitOptions& options, int steps, double viscosity = 0) {
    const auto law =
        std::make_shared<elasticity::ViscousLaw>(rubber(), std::vector<double>(6, viscosity));
    Block block(1, law);
    ImplicitIntegrator integrator({&block.body}, block.masses, {}, options);
    Motion motion = integrator.start(
        block.stretched(), viscosity > 0 ? block.still() : test::random_vectors(8, 100, 3));
    law->stop(block.body.gradients());
    const double dt = 2e-4 / steps;
    for (int i = 0; i < steps; ++i) {
        law->begin_step(dt);
        EXPECT_TRUE(integrator.step(dt, {}, motion).converged);
        law->accept(block.body.gradients());
    }
    return motion.x;
}

// Observed order: of what halving the step changes, beside what halving it again does.
double order(const ImplicitOptions& options, int steps, double viscosity = 0) {
    const NodeVectors coarse = released(options, steps, viscosity),
                      middle = released(options, 2 * steps, viscosity),
                      fine = released(options, 4 * steps, viscosity);
    return std::log2(distance(coarse, middle) / distance(middle, fine));
}

// Orders are observed at steps of finite length.
constexpr double kOrder = 0.15;

TEST(ImplicitIntegrator, BackwardEulerIsOfFirstOrder) {
    EXPECT_NEAR(order({.scheme = TimeScheme::backward_euler, .equilibrium = kExact}, 80), 1,
                kOrder);
}

TEST(ImplicitIntegrator, GeneralizedAlphaIsOfSecondOrder) {
    for (const double rho : {0.0, 0.5, 0.9, 1.0})
        EXPECT_NEAR(order({.rho_infinity = rho, .equilibrium = kExact}, 160), 2, kOrder) << rho;
}

TEST(ImplicitIntegrator, DampingKeepsTheOrder) {
    constexpr double kPerSecond = 3e3, kEta = 1e-6;
    EXPECT_NEAR(order({.mass_damping = kPerSecond, .equilibrium = kExact}, 160), 2, kOrder);
    EXPECT_NEAR(order({.equilibrium = kExact}, 160, kEta), 2, kOrder);
    EXPECT_NEAR(order({.scheme = TimeScheme::backward_euler, .equilibrium = kExact}, 80, kEta), 1,
                kOrder);
}

// The matrix by which a step multiplies (x, dt v, dt^2 a) of a vibration x'' = - omega^2 x.
Mat3 amplification(const ImplicitOptions& options, double omega_dt) {
    OriginSprings springs(omega_dt * omega_dt);
    ImplicitIntegrator integrator({&springs}, {1}, {}, options);
    Motion motion = integrator.start({Vec3::Zero()}, {Vec3::Zero()});
    // Three vibrations at once, one along each axis.
    motion.x = {Vec3::UnitX()};
    motion.v = {Vec3::UnitY()};
    motion.a = {Vec3::UnitZ()};
    motion.f = {-omega_dt * omega_dt * motion.x[0]};
    EXPECT_TRUE(integrator.step(1, {}, motion).converged);
    Mat3 A;
    A << motion.x[0].transpose(), motion.v[0].transpose(), motion.a[0].transpose();
    return A;
}
double spectral_radius(const ImplicitOptions& options, double omega_dt) {
    return amplification(options, omega_dt).eigenvalues().cwiseAbs().maxCoeff();
}

// Eigenvalues that meet in threes are known to the cube root of rounding only.
constexpr double kTriple = 1e-4;

TEST(ImplicitIntegrator, RhoInfinityIsWhatAStepLeavesOfFastVibrations) {
    for (const double rho : {0.0, 0.5, 0.9, 1.0}) {
        const ImplicitOptions options{.rho_infinity = rho, .equilibrium = kExact};
        EXPECT_NEAR(spectral_radius(options, 1e5), rho, 1e-2 + kTriple) << rho;
        EXPECT_NEAR(spectral_radius(options, 1e-3), 1, 1e-6) << rho;
        for (double omega_dt = 0.1; omega_dt < 1e4; omega_dt *= 2)
            EXPECT_LE(spectral_radius(options, omega_dt), 1 + kTriple) << rho << " " << omega_dt;
    }
}

TEST(ImplicitIntegrator, TheTrapezoidKeepsAVibrationForEver) {
    const Mat3 A = amplification({.rho_infinity = 1, .equilibrium = kExact}, 0.7);
    // From consistent accelerations: a = -0.49 x.
    Vec3 state(1, 0, -0.49);
    for (int i = 0; i < 1000; ++i) state = A * state;
    EXPECT_NEAR(0.49 * state[0] * state[0] + state[1] * state[1], 0.49, 1e-9);
}

}  // namespace
}  // namespace myotet::dynamics
