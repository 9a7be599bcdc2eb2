// SPDX-License-Identifier: Apache-2.0
#include "Membrane/RungeKutta.h"

#include <algorithm>
#include <cmath>

namespace myotet::membrane {

namespace {

void resize(NodeForces& forces, std::size_t count) {
    forces.total.resize(count, Vec3::Zero());
    forces.external.resize(count, Vec3::Zero());
    forces.pressing.resize(count, Vec3::Zero());
}

}  // namespace

void Stepper::prepare(const Body& body, std::span<const char> fixed, const Motion& motion) {
    const Active& active = body.active;
    moving_.clear();
    for (const std::int32_t i : active.nodes)
        if (active.inertia[i] > 0 && !fixed[i]) moving_.push_back(i);
    resize(forces_, motion.x.size());
    resize(stage_forces_, motion.x.size());
    v_sum_.resize(motion.x.size());
    a_sum_.resize(motion.x.size());
    stage_ = motion;
    energy_ = find_forces(body, motion, forces_) + kinetic_energy(body, motion);
    // Below a strain of a ten-thousandth all over energy is rounding and the
    // trapezoids of work.
    double mass = 0;
    for (const std::int32_t i : active.nodes) mass += active.mass[i];
    most_ = std::max({most_, energy_, 1e-8 * body.wall.young * mass / body.wall.density});
}

// The stage that lies `part` (s) from the start along the last stage's slopes.
void Stepper::advance_stage(const Body& body, const NodeForces& forces, double part,
                            const Motion& motion) {
    for (const std::int32_t i : moving_) {
        const Vec3 slope = stage_.v[i];
        stage_.x[i] = motion.x[i] + part * slope;
        stage_.v[i] = motion.v[i] + part / body.active.inertia[i] * forces.total[i];
    }
    stage_.time = motion.time + part;
    follow(body.active, stage_);
}

// Of the loads between two moments, by trapezoids, N mm.
double Stepper::work(const Body& body, const Motion& motion) const {
    double sum = 0;
    for (const std::int32_t i : body.active.nodes)
        sum +=
            0.5 * (forces_.external[i] + stage_forces_.external[i]).dot(stage_.x[i] - motion.x[i]);
    return sum;
}

bool Stepper::step(const Body& body, double step, Motion& motion) {
    for (const std::int32_t i : body.active.nodes) {
        stage_.v[i] = motion.v[i];
        stage_.x[i] = motion.x[i];
    }
    for (const std::int32_t i : moving_) {
        v_sum_[i] = motion.v[i];
        a_sum_[i] = forces_.total[i];
    }
    constexpr double kPart[] = {0.5, 0.5, 1}, kWeight[] = {2, 2, 1};
    for (int k = 0; k < 3; ++k) {
        advance_stage(body, k == 0 ? forces_ : stage_forces_, kPart[k] * step, motion);
        find_forces(body, stage_, stage_forces_);
        for (const std::int32_t i : moving_) {
            v_sum_[i] += kWeight[k] * stage_.v[i];
            a_sum_[i] += kWeight[k] * stage_forces_.total[i];
        }
    }
    for (const std::int32_t i : moving_) {
        stage_.x[i] = motion.x[i] + step / 6 * v_sum_[i];
        stage_.v[i] = motion.v[i] + step / 6 / body.active.inertia[i] * a_sum_[i];
    }
    follow(body.active, stage_);
    constexpr double kGain = 0.01;
    const double now = find_forces(body, stage_, stage_forces_) + kinetic_energy(body, stage_);
    const double gain = now - energy_ - work(body, motion);
    if (!(gain <= kGain * std::max(most_, energy_))) return false;
    energy_ = now;
    most_ = std::max(most_, now);
    std::swap(forces_, stage_forces_);
    for (const std::int32_t i : body.active.nodes) {
        motion.x[i] = stage_.x[i];
        motion.v[i] = stage_.v[i];
    }
    motion.time = stage_.time;
    return true;
}

}  // namespace myotet::membrane
