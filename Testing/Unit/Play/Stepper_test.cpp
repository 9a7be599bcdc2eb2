// SPDX-License-Identifier: Apache-2.0
#include "Play/Stepper.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Support/PlayShapes.h"

namespace myotet::play {
namespace {

using namespace test;

constexpr double kStep = 1.0 / 60;
const Vec3 kGravity(0, 0, -9810);

World one_block() {
    World world = empty_world();
    (void)add_soft_body(world, {"block", block_at({0, 0, 0}, {20, 20, 20}, {4, 4, 4}), {}}, {});
    return world;
}

TEST(Stepper, free_flight_keeps_momentum_to_rounding) {
    World world = one_block();
    Stepper stepper(world, {});
    State state = stepper.start();
    state.v = shaken(state.v, 300, 5);
    for (Vec3& v : state.v) v += Vec3(100, 200, 300);
    const Vec3 before = momentum(world, state);
    for (int i = 0; i < 60; ++i) (void)stepper.step(kStep, state);
    EXPECT_LT((momentum(world, state) - before).norm(), 1e-11 * before.norm());
}

TEST(Stepper, falls_as_backward_euler_falls) {
    World world = one_block();
    world.gravity = kGravity;
    Stepper stepper(world, {});
    State state = stepper.start();
    const double z = centre_of_mass(world, state).z();
    constexpr int kSteps = 30;
    for (int i = 0; i < kSteps; ++i) (void)stepper.step(kStep, state);
    // z_n = z + g dt^2 (1 + 2 + ... + n)
    const double fall = -9810 * kStep * kStep * kSteps * (kSteps + 1) / 2;
    EXPECT_NEAR(centre_of_mass(world, state).z() - z, fall, 1e-9 * -fall);
    for (std::size_t n = 0; n < state.x.size(); ++n)
        EXPECT_LT((state.x[n] - world.rest[n] - Vec3(0, 0, fall)).norm(), 1e-6);
}

TEST(Stepper, what_nothing_drives_gains_no_energy) {
    World world = one_block();
    Stepper stepper(world, {});
    State state = stepper.start();
    // Stretched, turning and shaken.
    for (std::size_t n = 0; n < state.x.size(); ++n) {
        const Vec3 from = world.rest[n] - Vec3(10, 10, 10);
        state.x[n] = Vec3(10, 10, 10) + from.cwiseProduct(Vec3(1.4, 0.8, 1));
        state.v[n] = Vec3(0, 0, 20).cross(from);
    }
    state.v = shaken(state.v, 500, 3);
    double level = stepper.energies(state).total();
    const double first = level;
    for (int i = 0; i < 120; ++i) {
        const double next = stepper.step(kStep / 4, state).energies.total();
        EXPECT_LE(next, level + 1e-9 * first) << "step " << i;
        level = next;
    }
    EXPECT_LT(level, 0.2 * first) << "what shakes dies away";
}

TEST(Stepper, a_block_on_the_floor_carries_its_weight) {
    World world = one_block();
    world.gravity = kGravity;
    world.obstacles.push_back(floor_at(-0.5));
    Stepper stepper(world, {});
    State state = stepper.start();
    StepReport last;
    for (int i = 0; i < 90; ++i) last = stepper.step(kStep, state);
    const double weight = world.bodies[0].mass * 9810;
    EXPECT_NEAR(last.press, weight, 1e-3 * weight);
    // Pressure on 20 x 20 mm^2 sinks it in by at most p / k, less where samples at its foot's
    // edges stand for some of its sides too. The column's own compression is
    // rho g H^2 / (2 E), to 10 %: it bulges a little and friction holds its foot.
    const double pressure = weight / 400, sunk = pressure / world.contact.stiffness;
    const double compression = 1e-9 * 9810 * 400 / (2 * 0.05);
    double top = 0, bottom = 0;
    for (std::size_t n = 0; n < state.x.size(); ++n) {
        if (world.rest[n].z() == 20) top += (state.x[n].z() - 20) / 25;
        if (world.rest[n].z() == 0) bottom += state.x[n].z() / 25;
    }
    EXPECT_LT(bottom, -0.5 * sunk);
    EXPECT_GT(bottom, -sunk);
    EXPECT_NEAR(bottom - top, compression, 0.1 * compression);
    EXPECT_EQ(stepper.deepest(state), 0);
}

TEST(Stepper, what_slides_slows_by_friction_and_what_sticks_stays) {
    for (const double friction : {0.0, 0.1, 1.0}) {
        World world = one_block();
        world.contact.friction = friction;
        world.obstacles.push_back(floor_at(-0.5));
        world.gravity = Vec3(0.2 * 9810, 0, -9810);  // as on a slope of 1 : 5
        Stepper stepper(world, {});
        State state = stepper.start();
        constexpr int kSteps = 60;
        const double x = centre_of_mass(world, state).x();
        for (int i = 0; i < kSteps; ++i) (void)stepper.step(kStep, state);
        const double speed = momentum(world, state).x() / world.bodies[0].mass;
        const double free = 9810 * std::max(0.0, 0.2 - friction);
        EXPECT_NEAR(speed, free * kSteps * kStep, 0.03 * 9810 * 0.2) << friction;
        if (friction == 1.0) {
            EXPECT_LT(centre_of_mass(world, state).x() - x, 2.5);
        }
    }
}

TEST(Stepper, bodies_that_meet_exchange_momentum) {
    World world = empty_world();
    (void)add_soft_body(world, {"a", block_at({0, 0, 0}, {20, 20, 20}, {4, 4, 4}), {}}, {});
    (void)add_soft_body(world, {"b", block_at({25, 3, 2}, {20, 20, 20}, {4, 4, 4}), {}}, {});
    Stepper stepper(world, {});
    State state = stepper.start();
    for (std::int32_t n = 0; n < world.bodies[0].nodes; ++n) state.v[n].x() = 1000;
    const Vec3 before = momentum(world, state);
    double deepest = 0, energy = stepper.energies(state).total();
    for (int i = 0; i < 60; ++i) {
        const StepReport report = stepper.step(kStep / 4, state);
        deepest = std::max(deepest, report.deepest_before);
        EXPECT_LE(report.energies.total(), 1.001 * energy) << i;
        energy = report.energies.total();
    }
    EXPECT_LT((momentum(world, state) - before).norm(), 1e-2 * before.norm());
    EXPECT_LT(deepest, 1);
    double b = 0;
    for (std::int32_t n = 0; n < world.bodies[1].nodes; ++n)
        b += world.masses[world.bodies[1].first_node + n] *
             state.v[world.bodies[1].first_node + n].x();
    EXPECT_GT(b, 0.45 * before.x()) << "b goes at least as fast as a";
    EXPECT_GT(stepper.smallest_volume_ratio(state), 0.5);
}

struct Thrown {
    double deepest = 0, least = 1, lowest = 0, gain = 0;
};

// A ball of 10 g onto a block of 8 g.
Thrown thrown(double speed) {
    World world = one_block();
    world.contact.stiffness = 0.1;
    (void)add_ball(world, {"shot", 0, 5}, {10, 10.3, 30}, 1e-5);
    world.velocity.back() = {0, 0, -speed};
    world.obstacles.push_back(floor_at(-0.5));
    Stepper stepper(world, {});
    State state = stepper.start();
    Thrown thrown;
    thrown.lowest = state.x.back().z();
    double energy = stepper.energies(state).total();
    for (int i = 0; i < 40; ++i) {
        const double next = stepper.step(kStep / 2, state).energies.total();
        thrown.gain = std::max(thrown.gain, (next - energy) / energy);
        energy = next;
        thrown.deepest = std::max(thrown.deepest, stepper.deepest(state));
        thrown.least = std::min(thrown.least, stepper.smallest_volume_ratio(state));
        thrown.lowest = std::min(thrown.lowest, state.x.back().z());
    }
    return thrown;
}

TEST(Stepper, a_ball_thrown_onto_a_block_sinks_in_little) {
    const Thrown slow = thrown(1500);
    EXPECT_LT(slow.deepest, 1) << "a fifth of an edge";
    EXPECT_LT(slow.gain, 1e-3);
    EXPECT_GT(slow.least, 0.5);
}

TEST(Stepper, a_ball_that_goes_three_blocks_a_step_does_not_pass_and_inverts_nothing) {
    const Thrown fast = thrown(8000);
    EXPECT_GT(fast.least, 0);
    EXPECT_GT(fast.lowest, 0) << "its centre stays above the floor";
    EXPECT_LT(fast.gain, 1e-3);
}

TEST(Stepper, one_thread_and_many_give_the_same_bytes) {
    const auto run = [](int threads) {
        const ThreadLimit limit(threads);
        World world = empty_world();
        for (int i = 0; i < 4; ++i)
            (void)add_soft_body(
                world, {"ball", ball_at({3.0 * (i % 2), 2.0 * i, 15 + 22.0 * i}, 10, 4), {}}, {});
        world.gravity = kGravity;
        world.obstacles.push_back(floor_at(0));
        Stepper stepper(world, {});
        State state = stepper.start();
        for (int i = 0; i < 30; ++i) (void)stepper.step(kStep, state);
        return state;
    };
    const State one = run(1), many = run(4);
    EXPECT_EQ(one.x, many.x);
    EXPECT_EQ(one.v, many.v);
}

TEST(Stepper, says_what_is_wrong) {
    World world = one_block();
    EXPECT_THROW(Stepper(world, {.iterations = 0}), InputError);
    EXPECT_THROW(Stepper(world, {.tolerance = std::nan("")}), InputError);
    Stepper stepper(world, {});
    State state = stepper.start();
    EXPECT_THROW((void)stepper.step(0, state), InputError);
    world.contact.stiffness = 0;
    EXPECT_THROW(Stepper(world, {}), InputError);
}

}  // namespace
}  // namespace myotet::play
