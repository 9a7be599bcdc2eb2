// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Implicit.h"

#include <cmath>

#include "Core/Parallel.h"
#include "Dynamics/NodeAlgebra.h"
#include "Dynamics/Require.h"

namespace myotet::dynamics {
namespace {

constexpr std::size_t kGrain = 4096;
// A guess may use up this part of the way to the first flat tetrahedron.
constexpr double kMostOfTheWay = 0.7;

// Held nodes obey no equation of motion.
std::vector<double> free_masses(std::vector<double> masses, const std::vector<char>& held) {
    for (std::size_t n = 0; n < masses.size(); ++n)
        if (held[n]) masses[n] = 0;
    return masses;
}

std::vector<char> flags(const std::vector<std::int32_t>& held, std::size_t nodes) {
    std::vector<char> is_held(nodes, 0);
    for (const std::int32_t n : held) {
        require(n >= 0 && n < static_cast<std::int32_t>(nodes), "held node", n,
                "it must be one of the nodes");
        is_held[n] = 1;
    }
    return is_held;
}

std::vector<Potential*> with(std::vector<Potential*> potentials, Potential* another) {
    potentials.push_back(another);
    return potentials;
}

}  // namespace

double kinetic_energy(const std::vector<double>& masses, const NodeVectors& v) {
    return parallel_sum(0, v.size(), kGrain, [&](std::size_t first, std::size_t last) {
        double sum = 0;
        for (std::size_t n = first; n < last; ++n) sum += 0.5 * masses[n] * v[n].squaredNorm();
        return sum;
    });
}

void ImplicitOptions::validate() const {
    require(rho_infinity >= 0 && rho_infinity <= 1, "rho_infinity", rho_infinity,
            "it must be within 0 and 1");
    require(mass_damping >= 0 && std::isfinite(mass_damping), "mass damping", mass_damping,
            "it must be finite and not negative");
    equilibrium.validate();
}

ImplicitIntegrator::Coefficients::Coefficients(const ImplicitOptions& options) {
    options.validate();
    if (options.scheme == TimeScheme::backward_euler) return;
    const double rho = options.rho_infinity;
    af = rho / (1 + rho);
    am = (2 * rho - 1) / (1 + rho);
    gamma = 0.5 - am + af;
    beta = 0.25 * (1 - am + af) * (1 - am + af);
    xi = 0.5 - beta;
}

ImplicitIntegrator::ImplicitIntegrator(std::vector<Potential*> potentials,
                                       std::vector<double> masses,
                                       const std::vector<std::int32_t>& held,
                                       const ImplicitOptions& options)
    : potentials_(std::move(potentials)),
      masses_(std::move(masses)),
      held_(flags(held, masses_.size())),
      mass_damping_(options.mass_damping),
      scheme_(options),
      inertia_(free_masses(masses_, held_)),
      equilibrium_(with(potentials_, &inertia_), masses_.size(), held, options.equilibrium) {
    require(!potentials_.empty(), "number of potentials", potentials_.size(),
            "there must be at least one");
    for (std::size_t n = 0; n < masses_.size(); ++n)
        if (!held_[n] && !(masses_[n] > 0 && std::isfinite(masses_[n])))
            throw InputError("mass of free node " + std::to_string(n) + " is " +
                             std::to_string(masses_[n]) + " t, but it must be positive");
}

NodeVectors ImplicitIntegrator::forces() const {
    NodeVectors sum(masses_.size(), Vec3::Zero());
    for (const Potential* potential : potentials_) potential->add_forces(sum);
    return sum;
}

Motion ImplicitIntegrator::start(const NodeVectors& x, const NodeVectors& v) {
    require(x.size() == masses_.size() && v.size() == masses_.size(), "number of positions",
            x.size(), "positions, velocities and masses must be as many");
    for (Potential* potential : potentials_) (void)potential->move_to(x);
    Motion motion{x, v, NodeVectors(x.size(), Vec3::Zero()), forces()};
    for (std::size_t n = 0; n < x.size(); ++n)
        if (!held_[n]) motion.a[n] = motion.f[n] / masses_[n] - mass_damping_ * v[n];
    return motion;
}

Vec3 ImplicitIntegrator::x_tilde(double dt, const Motion& motion, std::size_t n) const {
    return motion.x[n] + dt * motion.v[n] + scheme_.xi * dt * dt * motion.a[n];
}

Vec3 ImplicitIntegrator::v_tilde(double dt, const Motion& motion, std::size_t n) const {
    return motion.v[n] + (1 - scheme_.gamma) * dt * motion.a[n];
}

// The balance of the header with a and v as functions of x, by 1 - af:
//   M k (x - x~) + M g - af / (1 - af) f_n = f(x),
//   k = (1 - am) / ((1 - af) beta dt^2) + c gamma / (beta dt),
//   g = (am a_n + c af v_n) / (1 - af) + c v~,
// which is a pull from x_n by w = x~ - x_n - (g - af / (1 - af) f_n / m) / k.
void ImplicitIntegrator::set_inertia(double dt, const Motion& motion) {
    const auto [am, af, beta, gamma, xi] = scheme_;
    const double c = mass_damping_, part = 1 / (1 - af);
    const double k = part * (1 - am) / (beta * dt * dt) + c * gamma / (beta * dt);
    NodeVectors way(masses_.size(), Vec3::Zero());
    for (std::size_t n = 0; n < way.size(); ++n) {
        if (held_[n]) continue;
        const Vec3 g =
            part * (am * motion.a[n] + c * af * motion.v[n]) + c * v_tilde(dt, motion, n);
        way[n] = dt * motion.v[n] + xi * dt * dt * motion.a[n] -
                 (g - part * af / masses_[n] * motion.f[n]) / k;
    }
    inertia_.pull(k, motion.x, std::move(way));
}

bool ImplicitIntegrator::fits(const NodeVectors& x, const NodeVectors& by) const {
    NodeVectors farther = by;
    for (Vec3& p : farther) p /= kMostOfTheWay;
    return equilibrium_.largest_step(x, farther) == 1;
}

double ImplicitIntegrator::energy_after(const NodeVectors& x, const NodeVectors& by) {
    NodeVectors there = x;
    add_scaled(1, by, there);
    double sum = inertia_.move_to(there);
    for (Potential* potential : potentials_) sum += potential->move_to(there);
    return sum;
}

// Moves the free nodes of `there`, where held ones are at the end of the step. Where velocities
// lead uphill the step is longer than they last, and the linearised body knows better.
bool ImplicitIntegrator::guess(double dt, const Motion& motion, NodeVectors& there,
                               EquilibriumSummary& summary) {
    NodeVectors stay(there.size(), Vec3::Zero());
    for (std::size_t n = 0; n < stay.size(); ++n)
        if (held_[n]) stay[n] = there[n] - motion.x[n];
    NodeVectors by = stay;
    // Backward Euler's accelerations are differences of velocities: no guide to the next.
    const double curve = scheme_.xi == 0 ? 0 : 0.5 * dt * dt;
    for (std::size_t n = 0; n < by.size(); ++n)
        if (!held_[n]) by[n] = dt * motion.v[n] + curve * motion.a[n];
    bool found = fits(motion.x, by) && energy_after(motion.x, by) <= energy_after(motion.x, stay);
    if (!found) {
        summary.linear_iterations += equilibrium_.predict(motion.x, by).iterations;
        found = fits(motion.x, by);
    }
    if (!found) {
        by = std::move(stay);
        found = fits(motion.x, by);
    }
    for (std::size_t n = 0; n < by.size(); ++n)
        if (!held_[n]) there[n] = motion.x[n] + by[n];
    return found;
}

void ImplicitIntegrator::advance(double dt, NodeVectors x, Motion& motion) const {
    for (std::size_t n = 0; n < x.size(); ++n) {
        if (held_[n]) {
            const Vec3 v = (x[n] - motion.x[n]) / dt;
            motion.a[n] = (v - motion.v[n]) / dt;
            motion.v[n] = v;
        } else {
            const Vec3 a = (x[n] - x_tilde(dt, motion, n)) / (scheme_.beta * dt * dt);
            motion.v[n] = v_tilde(dt, motion, n) + scheme_.gamma * dt * a;
            motion.a[n] = a;
        }
    }
    motion.x = std::move(x);
    motion.f = forces();
    motion.time += dt;
}

EquilibriumSummary ImplicitIntegrator::step(double dt, const Apply& apply, Motion& motion) {
    require(dt > 0 && std::isfinite(dt), "time step", dt, "it must be positive");
    for (const NodeVectors* vectors : {&motion.x, &motion.v, &motion.a, &motion.f})
        require(vectors->size() == masses_.size(), "number of a motion's vectors", vectors->size(),
                "there must be one of each a node");
    set_inertia(dt, motion);
    NodeVectors there = motion.x;
    if (apply) apply(motion.time + dt, there);
    EquilibriumSummary summary;
    if (!guess(dt, motion, there, summary)) {
        summary.message = "a tetrahedron would be flattened";
        return summary;
    }
    const int linear_iterations = summary.linear_iterations;
    summary = equilibrium_.find(there);
    summary.linear_iterations += linear_iterations;
    summary.energy -= inertia_.energy();
    if (summary.converged) advance(dt, std::move(there), motion);
    return summary;
}

}  // namespace myotet::dynamics
