// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Implicit.h"

#include <numbers>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Dynamics/NodalLoads.h"
#include "Elasticity/Masses.h"
#include "Elasticity/Viscous.h"
#include "ImplicitShapes.h"
#include "Support/ReferenceCase.h"

namespace myotet::dynamics {
namespace {

using test::Block;
using test::distance;
using test::kDensity;
using test::kExact;
using test::rubber;
using test::run;
constexpr double kOrder = 0.15;  // orders are observed at steps of finite length

TEST(ImplicitIntegrator, BackwardEulerBearsAnyStep) {
    Block block(2);
    for (const double dt : {1e-4, 1.0, 1e6}) {
        const ImplicitOptions options{.scheme = TimeScheme::backward_euler};
        ImplicitIntegrator integrator({&block.body}, block.masses, block.at_height(0), options);
        Motion motion = integrator.start(block.stretched(), block.still());
        double before = block.body.move_to(motion.x) + kinetic_energy(block.masses, motion.v);
        NodeVectors x = motion.x;
        for (int i = 0; i < 5; ++i) {
            const EquilibriumSummary step = integrator.step(dt, {}, motion);
            ASSERT_TRUE(step.converged) << step.message;
            const double now = step.energy + kinetic_energy(block.masses, motion.v);
            EXPECT_LE(now, before * (1 + 1e-6));
            before = now;
        }
        if (dt >= 1) {
            // At once where it rests.
            Equilibrium equilibrium({&block.body}, x.size(), block.at_height(0), {});
            ASSERT_TRUE(equilibrium.find(x).converged);
            EXPECT_LT(distance(motion.x, x), 1e-4);
        }
    }
}

Vec3 momentum(const Block& block, const NodeVectors& v) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < v.size(); ++n) sum += block.masses[n] * v[n];
    return sum;
}
Vec3 spin(const Block& block, const Motion& motion) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < motion.x.size(); ++n)
        sum += block.masses[n] * motion.x[n].cross(motion.v[n]);
    return sum;
}

// A stretched block that also turns, at about a tenth of the frequency of its vibrations.
Motion thrown(const Block& block, ImplicitIntegrator& integrator) {
    const NodeVectors x = block.stretched();
    NodeVectors v = x;
    for (Vec3& p : v) p = Vec3(0, 0, 1500).cross(p) + Vec3(100, 200, 300);
    return integrator.start(x, v);
}

TEST(ImplicitIntegrator, AFreeBodyKeepsItsMomentum) {
    for (const double rho : {0.5, 0.9, 1.0}) {
        Block block(2);
        const ImplicitOptions options{.rho_infinity = rho, .equilibrium = kExact};
        ImplicitIntegrator integrator({&block.body}, block.masses, {}, options);
        Motion motion = thrown(block, integrator);
        const Vec3 before = momentum(block, motion.v);
        run(integrator, 5e-5, 100, motion);
        // As exact as the equilibria of all steps together.
        EXPECT_LT((momentum(block, motion.v) - before).norm(), 1e-8 * before.norm());
    }
}

TEST(ImplicitIntegrator, AFreeBodyKeepsItsSpinToSecondOrder) {
    const auto lost = [](int steps) {
        Block block(2);
        ImplicitIntegrator integrator({&block.body}, block.masses, {}, {.equilibrium = kExact});
        Motion motion = thrown(block, integrator);
        const Vec3 before = spin(block, motion);
        run(integrator, 1e-3 / steps, steps, motion);
        return (spin(block, motion) - before).norm() / before.norm();
    };
    const double coarse = lost(40), fine = lost(80);
    EXPECT_LT(fine, 5e-3);
    EXPECT_GT(std::log2(coarse / fine), 2 - 2 * kOrder);
}

// A slim beam of quadratic tetrahedra, held at one end, and its first vibration.
struct Beam {
    elasticity::QuadraticMesh mesh =
        elasticity::quadratic_mesh(myotet::test::five_tet_block({10, 1, 1}, {5, 1, 1}));
    ElasticBody body{elasticity::quadratic_points(mesh), mesh.points.size(), rubber(0.3)};
    std::vector<double> masses =
        elasticity::nodal_masses(mesh, std::vector<double>(mesh.tets.size(), kDensity));
    std::vector<std::int32_t> held;
    NodeVectors shape;  // its tip moves by 1
    double omega = 0;

    Beam() {
        std::vector<char> is_held;
        for (std::size_t n = 0; n < mesh.points.size(); ++n) {
            is_held.push_back(mesh.points[n].x() == 0);
            if (is_held.back()) held.push_back(static_cast<std::int32_t>(n));
            shape.emplace_back(0, 0, mesh.points[n].x());
        }
        BlockMatrix K = block_pattern(shape.size(), body.cliques());
        (void)body.move_to(mesh.points);
        body.add_stiffness(K);
        // Inverse iteration: K shape' = M shape.
        for (int i = 0; i < 5; ++i) {
            NodeVectors right = shape;
            for (std::size_t n = 0; n < right.size(); ++n) right[n] *= masses[n] * 1e7;
            shape.assign(shape.size(), Vec3::Zero());
            EXPECT_TRUE(solve(K, is_held, right, {1e-12, 5000}, shape).converged);
            double most = 0;
            for (const Vec3& p : shape) most = std::max(most, std::abs(p.z()));
            for (Vec3& p : shape) p /= most;
        }
        omega = std::sqrt(0.5 * dot(shape, multiply(K, shape)) / kinetic_energy(masses, shape));
    }
};

TEST(ImplicitIntegrator, AVibrationKeepsItsEnergyAndItsPeriod) {
    // Over ten periods, the tip swinging by a seventh of the beam's length to each side.
    constexpr double kKept = 5e-3, kSteps = 80, kSwing = 1.4;
    for (const double rho : {0.9, 1.0}) {
        Beam beam;
        // A cantilever by Euler and Bernoulli; shear and so few elements move it a little.
        const double slim = 1.8751 * 1.8751 / 100 * std::sqrt(0.1 / kDensity / 12);
        EXPECT_NEAR(beam.omega / slim, 1, 0.05);
        ImplicitIntegrator integrator({&beam.body}, beam.masses, beam.held, {.rho_infinity = rho});
        NodeVectors v = beam.shape;
        for (Vec3& p : v) p *= kSwing * beam.omega;
        Motion motion = integrator.start(beam.mesh.points, v);
        const double before = kinetic_energy(beam.masses, motion.v),
                     period = 2 * std::numbers::pi / beam.omega;
        const std::size_t tip = 3;  // a corner at the far end
        double least = before, most = before, highest = 0, z = 0;
        int turns = 0;
        for (int i = 0; i < 10 * kSteps; ++i) {
            const EquilibriumSummary step = integrator.step(period / kSteps, {}, motion);
            ASSERT_TRUE(step.converged) << step.message;
            const double now = step.energy + kinetic_energy(beam.masses, motion.v);
            least = std::min(least, now);
            most = std::max(most, now);
            const double there = motion.x[beam.mesh.tets.back()[tip]].z() -
                                 beam.mesh.points[beam.mesh.tets.back()[tip]].z();
            turns += z * there < 0;
            highest = std::max(highest, there);
            z = there;
        }
        EXPECT_GT(least, (1 - kKept) * before) << rho;
        EXPECT_LT(most, (1 + kKept) * before) << rho;
        EXPECT_NEAR(highest, kSwing, 0.1 * kSwing);
        EXPECT_NEAR(turns, 20, 1);
    }
}

TEST(ImplicitIntegrator, HeldNodesGoWhereTheyAreTold) {
    Block block(2);
    const auto held = block.at_height(2);
    const auto place = [&](std::int32_t n, double time) -> Vec3 {
        return block.mesh.points[n] + Vec3(0.3 * std::sin(1e3 * time), 50 * time, 0);
    };
    std::vector<double> times;
    const auto apply = [&](double time, NodeVectors& x) {
        times.push_back(time);
        for (const std::int32_t n : held) x[n] = place(n, time);
    };
    ImplicitIntegrator integrator({&block.body}, block.masses, held, {});
    Motion motion = integrator.start(block.mesh.points, block.still());
    for (int i = 1; i <= 20; ++i) {
        const NodeVectors before = motion.x;
        ASSERT_TRUE(integrator.step(1e-4, apply, motion).converged);
        EXPECT_DOUBLE_EQ(motion.time, 1e-4 * i);
        EXPECT_EQ(times.back(), motion.time);
        for (const std::int32_t n : held) {
            EXPECT_EQ(motion.x[n], place(n, motion.time));
            EXPECT_EQ(motion.v[n], Vec3((motion.x[n] - before[n]) / 1e-4));
        }
    }
    EXPECT_GT((motion.x[0] - block.mesh.points[0]).norm(), 0.01);  // the rest came along
}

TEST(ImplicitIntegrator, ARigidDriftGoesOnWithoutForces) {
    Block block(2);
    const Vec3 speed(200, -300, 100);
    const auto held = block.at_height(0);
    const auto apply = [&](double time, NodeVectors& x) {
        for (const std::int32_t n : held) x[n] = block.mesh.points[n] + time * speed;
    };
    for (const TimeScheme scheme : {TimeScheme::backward_euler, TimeScheme::generalized_alpha}) {
        ImplicitIntegrator integrator({&block.body}, block.masses, held, {.scheme = scheme});
        Motion motion = integrator.start(block.mesh.points, NodeVectors(27, speed));
        for (int i = 0; i < 10; ++i) ASSERT_TRUE(integrator.step(1e-2, apply, motion).converged);
        for (std::size_t n = 0; n < 27; ++n)
            EXPECT_LT((motion.x[n] - block.mesh.points[n] - 0.1 * speed).norm(), 1e-9);
    }
}

TEST(ImplicitIntegrator, FreeFallIsExact) {
    // A parabola, whatever the step: x~ and v~ contain it.
    Block block(1);
    NodalLoads weight(8);
    for (std::size_t n = 0; n < 8; ++n) weight.forces()[n] = Vec3(0, 0, -9810 * block.masses[n]);
    ImplicitIntegrator integrator({&block.body, &weight}, block.masses, {},
                                  {.equilibrium = kExact});
    Motion motion = integrator.start(block.mesh.points, block.still());
    run(integrator, 0.01, 10, motion);
    for (std::size_t n = 0; n < 8; ++n)
        EXPECT_LT((motion.x[n] - block.mesh.points[n] - Vec3(0, 0, -49.05)).norm(), 1e-7);
}

TEST(ImplicitIntegrator, MassDampingSlowsADrift) {
    Block block(1);
    const ImplicitOptions options{.mass_damping = 20, .equilibrium = kExact};
    ImplicitIntegrator integrator({&block.body}, block.masses, {}, options);
    Motion motion = integrator.start(block.mesh.points, NodeVectors(8, Vec3(100, 0, 0)));
    run(integrator, 1e-3, 100, motion);
    // v = v_0 exp(-c t), but for c dt squared.
    for (const Vec3& v : motion.v) EXPECT_NEAR(v.x() / (100 * std::exp(-2)), 1, 4e-4);
}

TEST(ImplicitIntegrator, ViscosityEndsAtTheSameEquilibrium) {
    const auto law =
        std::make_shared<elasticity::ViscousLaw>(rubber(), std::vector<double>(48, 2e-5));
    Block block(2, law), plain(2);
    NodalLoads load(27);
    for (const std::int32_t n : block.at_height(2)) load.forces()[n] = Vec3(0.01, 0, 0.005);
    const auto held = block.at_height(0);
    const ImplicitOptions options{.scheme = TimeScheme::backward_euler, .equilibrium = kExact};
    ImplicitIntegrator integrator({&block.body, &load}, block.masses, held, options);
    Motion motion = integrator.start(block.mesh.points, block.still());
    const double dt = 2e-4;
    double before = INFINITY;
    for (int i = 0; i < 200; ++i) {
        law->begin_step(dt, elasticity::RateOrder::first);
        ASSERT_TRUE(integrator.step(dt, {}, motion).converged);
        law->accept(block.body.gradients());
        const double now = plain.body.move_to(motion.x) + load.move_to(motion.x) +
                           kinetic_energy(block.masses, motion.v);
        EXPECT_LE(now, before + 1e-12);  // nothing but loses energy
        before = now;
    }
    NodeVectors x = motion.x;
    Equilibrium equilibrium({&plain.body, &load}, 27, held, kExact);
    ASSERT_TRUE(equilibrium.find(x).converged);
    EXPECT_LT(distance(motion.x, x), 1e-6);
    EXPECT_GT(distance(motion.x, block.mesh.points), 0.1);
}

TEST(ImplicitIntegrator, AStepThatFailsLeavesTheMotionAsItWas) {
    Block block(2);
    const auto held = [&] {
        auto nodes = block.at_height(0);
        for (const std::int32_t n : block.at_height(2)) nodes.push_back(n);
        return nodes;
    }();
    // Down through the floor in a millisecond.
    const auto apply = [&](double time, NodeVectors& x) {
        for (const std::int32_t n : block.at_height(2)) x[n].z() = 2 - 3e3 * time;
    };
    ImplicitIntegrator integrator({&block.body}, block.masses, held, {});
    Motion motion = integrator.start(block.mesh.points, block.still());
    ASSERT_TRUE(integrator.step(1e-5, apply, motion).converged);
    const Motion before = motion;
    const EquilibriumSummary step = integrator.step(1e-3, apply, motion);
    EXPECT_FALSE(step.converged);
    EXPECT_FALSE(step.message.empty());
    EXPECT_EQ(motion.x, before.x);
    EXPECT_EQ(motion.v, before.v);
    EXPECT_EQ(motion.a, before.a);
    EXPECT_EQ(motion.f, before.f);
    EXPECT_EQ(motion.time, before.time);
    // ... and shorter ones get on, to a third of the height.
    for (int i = 0; i < 43; ++i) ASSERT_TRUE(integrator.step(1e-5, apply, motion).converged) << i;
}

TEST(ImplicitIntegrator, NothingInvertsHoweverFastItIs) {
    Block block(2);
    ImplicitIntegrator integrator({&block.body}, block.masses, {}, {.rho_infinity = 0.5});
    // Several lengths of the block in a step, every node its own way.
    Motion motion = integrator.start(block.mesh.points, test::random_vectors(27, 2e4, 5));
    for (int i = 0; i < 10; ++i) {
        const EquilibriumSummary step = integrator.step(2e-4, {}, motion);
        ASSERT_TRUE(step.converged) << step.message;
        for (const Mat3& F : block.body.gradients()) EXPECT_GT(F.determinant(), 0);
    }
}

TEST(ImplicitIntegrator, RefusesWhatMakesNoSense) {
    Block block(1);
    const auto make = [&](const ImplicitOptions& options) {
        return ImplicitIntegrator({&block.body}, block.masses, {}, options)
            .start(block.mesh.points, block.still());
    };
    EXPECT_THROW((void)make({.rho_infinity = -0.1}), InputError);
    EXPECT_THROW((void)make({.rho_infinity = 1.1}), InputError);
    EXPECT_THROW((void)make({.rho_infinity = std::nan("")}), InputError);
    EXPECT_THROW((void)make({.mass_damping = -1}), InputError);
    EXPECT_THROW((void)make({.mass_damping = INFINITY}), InputError);
    EXPECT_THROW((void)make({.equilibrium = {.tolerance = 0}}), InputError);
    std::vector<double> masses = block.masses;
    masses[3] = 0;
    EXPECT_THROW(ImplicitIntegrator({&block.body}, masses, {}, {}), InputError);
    EXPECT_NO_THROW(ImplicitIntegrator({&block.body}, masses, {3}, {}));
    EXPECT_THROW(ImplicitIntegrator({&block.body}, block.masses, {8}, {}), InputError);
    EXPECT_THROW(ImplicitIntegrator({}, block.masses, {}, {}), InputError);
    ImplicitIntegrator integrator({&block.body}, block.masses, {}, {});
    EXPECT_THROW((void)integrator.start(block.mesh.points, {}), InputError);
    Motion motion = integrator.start(block.mesh.points, block.still());
    for (const double dt : {0.0, -1.0, std::nan(""), static_cast<double>(INFINITY)})
        EXPECT_THROW((void)integrator.step(dt, {}, motion), InputError);
    motion.f.pop_back();
    EXPECT_THROW((void)integrator.step(1, {}, motion), InputError);
}

TEST(ImplicitIntegrator, SameBytesOnOneThreadOrMany) {
    const auto on = [](int threads) {
        const ThreadLimit limit(threads);
        Block block(6);
        ImplicitIntegrator integrator({&block.body}, block.masses, block.at_height(0), {});
        Motion motion = integrator.start(block.stretched(), block.still());
        run(integrator, 1e-4, 3, motion);
        return std::tuple(motion.x, motion.v, motion.a, motion.f);
    };
    EXPECT_EQ(on(1), on(3));
}

TEST(KineticEnergy, IsHalfTheMassTimesSpeedSquared) {
    EXPECT_DOUBLE_EQ(kinetic_energy({2, 3}, {Vec3(1, 0, 0), Vec3(0, 2, 2)}), 1 + 12);
}

}  // namespace
}  // namespace myotet::dynamics
