// SPDX-License-Identifier: Apache-2.0
#include "Play/Stepper.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Elasticity/LinearTet.h"

namespace myotet::play {

using dynamics::NodeVectors;

namespace {

// Of the way to the first flat tetrahedron.
constexpr double kMostOfTheWay = 0.9;
// Of what the slope promises, a step must bring so much (Armijo).
constexpr double kEnough = 1e-4;
constexpr int kHalvings = 12;
// Sums differ by rounding in this part of what inertia would cost without the step.
constexpr double kRounding = 1e-12;
// Mean edges that an iteration moves nodes by when there is nothing left to be gained.
constexpr double kNothing = 1e-5;
constexpr double kFrictionError = 0.1;
// What slides slower sticks, mm/s.
constexpr double kSlip = 1;
// Mean edges by which things may close in on each other in a part of a step.
constexpr double kLongestWay = 1;

template <class Act>
void each_body(World& world, const Act& act) {
    parallel_for(0, world.bodies.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) act(b);
    });
}

// Whether what friction's springs pull, as they were set, is what it should be now: to a part
// of the most that it may pull.
bool friction_fits(std::span<const Touch> touches, double slip) {
    double wrong = 0, most = 0;
    for (const Touch& t : touches) {
        const double limit = t.friction * t.stiffness * t.press, slide = t.slide.norm();
        wrong += std::abs(t.drag - limit / std::max(slide, slip)) * slide;
        most += limit;
    }
    return wrong <= kFrictionError * most;
}

dynamics::BlockMatrix pattern_of(const World& world) {
    dynamics::Cliques all;
    for (const Body& body : world.bodies) {
        const dynamics::Cliques part = body.elastic->cliques();
        for (std::size_t c = 0; c < part.size(); ++c)
            all.add({part.node.data() + part.start[c], part.node.data() + part.start[c + 1]});
    }
    return dynamics::block_pattern(world.rest.size(), all);
}

}  // namespace

void StepOptions::validate() const {
    if (!(iterations >= 1 && iterations <= 1000))
        throw InputError("iterations are " + std::to_string(iterations) +
                         ", but must be from 1 to 1000");
    if (!(parts >= 1 && parts <= 1000))
        throw InputError("parts are " + std::to_string(parts) + ", but must be from 1 to 1000");
    if (!(tolerance > 0 && tolerance < 1))
        throw InputError("tolerance is " + std::to_string(tolerance) +
                         ", but must be a part of an edge between 0 and 1");
    if (!(linear.tolerance > 0 && linear.tolerance < 1 && linear.iterations >= 1))
        throw InputError("linear tolerance is " + std::to_string(linear.tolerance) + " in " +
                         std::to_string(linear.iterations) +
                         " iterations, but must lie between 0 and 1, in at least one");
}

Stepper::Stepper(World& world, const StepOptions& options)
    : world_(world), options_(options), edge_(world.shortest_mean_edge()) {
    options.validate();
    world.contact.validate();
    make_muscles(world);
    K_ = pattern_of(world);
    for (std::size_t n = 0; n < K_.rows(); ++n) {
        const auto i = static_cast<std::int32_t>(n);
        diagonal_.push_back(K_.at(i, i));
    }
}

State Stepper::start() { return {world_.rest, world_.velocity, 0}; }

double Stepper::move_bodies(const NodeVectors& x) {
    std::vector<double> energy(world_.bodies.size());
    each_body(world_, [&](std::size_t b) { energy[b] = world_.bodies[b].elastic->move_to(x); });
    double sum = 0;
    for (const double e : energy) sum += e;
    return sum;
}

double Stepper::energy(const NodeVectors& x) {
    double inertia = 0;
    for (std::size_t n = 0; n < x.size(); ++n)
        if (!world_.held[n]) inertia += world_.masses[n] * (x[n] - ahead_[n]).squaredNorm();
    return 0.5 * per_time_ * inertia + move_bodies(x) + move_to(touches_.all, x);
}

double Stepper::largest_step(const NodeVectors& x, const NodeVectors& by) const {
    std::vector<double> step(world_.bodies.size(), 1.0);
    each_body(world_,
              [&](std::size_t b) { step[b] = world_.bodies[b].elastic->largest_step(x, by); });
    double least = 1;
    for (const double s : step) least = std::min(least, s);
    return least;
}

void Stepper::begin(double dt, const State& state) {
    per_time_ = 1 / (dt * dt);
    ahead_ = state.x;
    for (std::size_t n = 0; n < ahead_.size(); ++n)
        if (!world_.held[n]) ahead_[n] += dt * state.v[n] + dt * dt * world_.gravity;
    for (Body& body : world_.bodies)
        if (body.law) {
            const double a = contraction::value_at(body.activation, state.time + dt);
            body.law->set_activation(std::vector<double>(body.law->activation().size(), a));
        }
    const std::vector<Touch> before = std::move(touches_.all);
    touches_ = find_touches(world_, {state.x, ahead_, state.time, dt});
    lag_friction(touches_.all, before, kSlip * dt);
}

// From where velocities lead, as far as that flattens nothing, if the sum is less there.
void Stepper::first_guess(NodeVectors& x) {
    const double staying = energy(x);
    NodeVectors by(x.size()), there(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) by[n] = ahead_[n] - x[n];
    const double far = largest_step(x, by);
    const double s = far < 1 ? kMostOfTheWay * far : 1;
    for (std::size_t n = 0; n < x.size(); ++n) there[n] = x[n] + s * by[n];
    level_ = energy(there);
    if (level_ < staying)
        x = std::move(there);
    else
        level_ = energy(x);
}

// Forces and stiffness of the sum at x, where it was evaluated last.
void Stepper::assemble(const NodeVectors& x) {
    K_.set_zero();
    forces_.assign(x.size(), Vec3::Zero());
    each_body(world_, [&](std::size_t b) {
        world_.bodies[b].elastic->add_forces(forces_);
        world_.bodies[b].elastic->add_stiffness(K_);
    });
    for (std::size_t n = 0; n < x.size(); ++n) {
        const double m = per_time_ * world_.masses[n];
        forces_[n] += m * (ahead_[n] - x[n]);
        K_.value[diagonal_[n]].diagonal().array() += m;
    }
    add_forces(touches_.all, forces_);
    for (std::size_t n = 0; n < x.size(); ++n)
        if (world_.held[n]) forces_[n].setZero();
}

// Takes a step along d; returns the part of d that was taken, 0 when none lowers the sum.
double Stepper::search(const NodeVectors& d, NodeVectors& x) {
    double slope = 0;
    for (std::size_t n = 0; n < x.size(); ++n) slope += forces_[n].dot(d[n]);
    const double far = largest_step(x, d);
    double s = far < 1 ? kMostOfTheWay * far : 1;
    NodeVectors there(x.size());
    const double rounding = kRounding * std::abs(level_);
    for (int i = 0; i <= kHalvings; ++i, s *= 0.5) {
        for (std::size_t n = 0; n < x.size(); ++n) there[n] = x[n] + s * d[n];
        const double level = energy(there);
        if (level <= level_ - kEnough * s * slope + rounding) {
            x = std::move(there);
            level_ = level;
            return s;
        }
    }
    level_ = energy(x);
    return 0;
}

// sum m (x - y) = 0 where the body's own forces, whose sum is nothing, are all there are.
void Stepper::mend_momentum(NodeVectors& x) const {
    std::vector<char> touched(x.size(), 0);
    for (const Touch& t : touches_.all)
        if (t.press > 0)
            for (int i = 0; i < t.count; ++i) touched[t.node[i]] = 1;
    for (const Body& body : world_.bodies) {
        const std::int32_t end = body.first_node + body.nodes;
        bool free = !body.held;
        Vec3 sum = Vec3::Zero();
        for (std::int32_t n = body.first_node; n < end; ++n) {
            free = free && !touched[n];
            sum += world_.masses[n] * (ahead_[n] - x[n]);
        }
        if (!free) continue;
        sum /= body.mass;
        for (std::int32_t n = body.first_node; n < end; ++n) x[n] += sum;
    }
}

// As many parts as what is about to touch closes in by mean edges: its planes are found where
// a part begins, and hold for no longer ways.
int Stepper::parts() const {
    double closing = 0;
    for (const Touch& t : touches_.all) {
        const double to = t.normal.dot(t.sum(ahead_)) - t.offset;
        if (to < t.gap) closing = std::max(closing, t.apart - to);
    }
    const double parts = std::ceil(closing / (kLongestWay * edge_));
    return static_cast<int>(std::clamp(parts, 1.0, static_cast<double>(options_.parts)));
}

// Ends when an iteration moved little and, lest what was left undone should feed motion, the
// energy is not above that at the beginning; where something drives it, when one moved less
// than rounding shows.
void Stepper::solve_step(double dt, State& state, StepReport& report) {
    const double before = energies(state).total();
    State next{state.x, state.v, state.time + dt};
    NodeVectors d;
    first_guess(next.x);
    MYOTET_CHECK(std::isfinite(level_), "a step begins where no tetrahedron is inverted");
    bool settled = false;
    for (int i = 0; i < options_.iterations && !settled; ++i) {
        if (i > 0) {
            lag_friction(touches_.all, kSlip * dt);
            level_ = energy(next.x);
        }
        assemble(next.x);
        report.linear_iterations +=
            solve({K_, touches_.all, world_.held}, forces_, options_.linear, d);
        const double s = search(d, next.x);
        mend_momentum(next.x);
        double farthest = 0;
        for (const Vec3& by : d) farthest = std::max(farthest, by.squaredNorm());
        const double moved = s * std::sqrt(farthest) / edge_;
        for (std::size_t n = 0; n < next.x.size(); ++n) next.v[n] = (next.x[n] - state.x[n]) / dt;
        settled = moved <= options_.tolerance && friction_fits(touches_.all, kSlip * dt) &&
                  (moved <= kNothing || energies(next).total() <= before);
        ++report.iterations;
    }
    state = std::move(next);
    report.settled = report.settled && settled;
}

StepReport Stepper::step(double dt, State& state) {
    if (!(dt > 0 && std::isfinite(dt)))
        throw InputError("time step is " + std::to_string(dt) + " s, but it must be positive");
    begin(dt, state);
    StepReport report{.parts = parts(), .settled = true, .deepest_before = touches_.deepest};
    const double end = state.time + dt, part = dt / report.parts;
    for (int i = 0; i < report.parts; ++i) {
        if (report.parts > 1) begin(part, state);
        report.deepest_before = std::max(report.deepest_before, touches_.deepest);
        solve_step(part, state, report);
    }
    state.time = end;
    report.energies = energies(state);
    for (const Touch& t : touches_.all) {
        report.touching += t.press > 0;
        report.press += t.stiffness * t.press;
    }
    return report;
}

Energies Stepper::energies(const State& state) {
    Energies sum;
    sum.kinetic = 0;
    for (std::size_t n = 0; n < state.x.size(); ++n) {
        if (world_.held[n]) continue;
        sum.kinetic += 0.5 * world_.masses[n] * state.v[n].squaredNorm();
        sum.weight -= world_.masses[n] * world_.gravity.dot(state.x[n]);
    }
    sum.elastic = move_bodies(state.x);
    (void)move_to(touches_.all, state.x);
    for (const Touch& t : touches_.all) sum.contact += 0.5 * t.stiffness * t.press * t.press;
    return sum;
}

double Stepper::deepest(const State& state) {
    return find_touches(world_, {state.x, state.x, state.time, 0}).deepest;
}

double Stepper::smallest_volume_ratio(const State& state) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Body& body : world_.bodies)
        for (const Tet& t : body.tets) {
            const double now = signed_volume(state.x[t[0]], state.x[t[1]], state.x[t[2]],
                                             state.x[t[3]]),
                         before = signed_volume(world_.rest[t[0]], world_.rest[t[1]],
                                                world_.rest[t[2]], world_.rest[t[3]]);
            least = std::min(least, now / before);
        }
    return least;
}

}  // namespace myotet::play
