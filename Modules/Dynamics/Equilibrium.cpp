// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Dynamics/NodeAlgebra.h"
#include "Dynamics/Require.h"

namespace myotet::dynamics {
namespace {

// Part of the way to the first flat tetrahedron that a step may go.
constexpr double kSafety = 0.9;
// Armijo's part of the promised decrease.
constexpr double kDecrease = 1e-4;
// Below what rounding does to sums of energies, in epsilons, the slope decides.
constexpr double kEnergyRounding = 64, kForceRounding = 16;
// ... and shall become flatter by this.
constexpr double kFlatter = 0.9;
constexpr int kMostHalvings = 25;
// The first solves need no more than a direction.
constexpr double kLoosest = 0.1, kTightest = 1e-10;
// So many iterations cost a fifth of what the stiffness does: as short time steps need few,
// they are taken, and an iteration of Newton's method is saved.
constexpr int kCheap = 15;
constexpr double kGuess = 0.01;
// The last solve aims at this part of the tolerance.
constexpr double kEnough = 0.3;
// Bold steps in a row, how long each must be, and careful ones after they failed.
constexpr int kMostBold = 5, kRest = 1;
constexpr double kBold = 0.5;
// ... and by how much more it may raise the energy than it promised to lower it.
constexpr double kRaise = 1e3;
// How far along a downward curve a node may move at first, and least: parts of the body.
constexpr double kReach = 0.02, kLeastReach = 1e-4;

// What rounding of the positions alone does to forces and energies: epsilon times
// |K| |x|, and |K| times the squared distance of neighbours; and rounding of the energy.
struct Rounding {
    double force = 0, energy = 0;

    Rounding(const BlockMatrix& K, const NodeVectors& x, double level) : energy(std::abs(level)) {
        double reach = 0, squares = 0;
        for (std::size_t n = 0; n < x.size(); ++n) {
            double distance = 0;
            for (std::size_t i = K.row_start[n]; i < K.row_start[n + 1]; ++i)
                distance = std::max(distance, (x[K.column[i]] - x[n]).squaredNorm());
            const auto node = static_cast<std::int32_t>(n);
            const double stiffness = K.value[K.at(node, node)].norm();
            squares += stiffness * stiffness;
            energy += stiffness * distance;
            reach = std::max(reach, x[n].norm());
        }
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        force = kForceRounding * epsilon * reach * std::sqrt(squares);
        energy *= kEnergyRounding * epsilon;
    }
};

double largest(const NodeVectors& v) {
    double most = 0;
    for (const Vec3& p : v) most = std::max(most, p.norm());
    return most;
}

// How far to follow a direction along which the energy curves downwards.
class Reach {
public:
    explicit Reach(const NodeVectors& x) {
        Box box;
        for (const Vec3& p : x) box.include(p);
        least_ = kLeastReach * box.diagonal();
        now_ = kReach * box.diagonal();
    }
    void extend(const NodeVectors& downward, NodeVectors& d) const {
        add_scaled(now_ / largest(downward), downward, d);
    }
    // A whole step may be followed by a longer one.
    void learn(double step) { now_ = std::max(least_, step < 1 ? step * now_ : 2 * now_); }

private:
    double least_, now_;
};

}  // namespace

void EquilibriumOptions::validate() const {
    require(tolerance > 0 && tolerance < 1, "tolerance", tolerance, "it must be within 0 and 1");
    require(iterations > 0, "number of iterations", iterations, "it must be positive");
    require(linear_iterations > 0, "number of linear iterations", linear_iterations,
            "it must be positive");
}

Equilibrium::Equilibrium(std::vector<Potential*> potentials, std::size_t nodes,
                         const std::vector<std::int32_t>& held, const EquilibriumOptions& options)
    : potentials_(std::move(potentials)),
      held_(nodes, 0),
      options_(options),
      solver_(options.linear_method) {
    options_.validate();
    require(!potentials_.empty(), "number of potentials", potentials_.size(),
            "there must be at least one");
    for (const std::int32_t n : held) {
        require(n >= 0 && n < static_cast<std::int32_t>(nodes), "held node", n,
                "it must be one of the nodes");
        held_[n] = 1;
    }
    Cliques all;
    for (const Potential* potential : potentials_) {
        const Cliques some = potential->cliques();
        for (std::size_t c = 0; c < some.size(); ++c)
            all.add({some.node.data() + some.start[c], some.node.data() + some.start[c + 1]});
    }
    K_ = block_pattern(nodes, all);
}

double Equilibrium::energy(const NodeVectors& x) {
    double sum = 0;
    for (Potential* potential : potentials_) sum += potential->move_to(x);
    return sum;
}

// All forces, and what the potentials' would be if they did not cancel, squared.
NodeVectors Equilibrium::forces(double& squares) const {
    NodeVectors sum(held_.size(), Vec3::Zero());
    potentials_.front()->add_forces(sum);
    squares = dot(sum, sum);
    for (std::size_t i = 1; i < potentials_.size(); ++i) {
        NodeVectors another(held_.size(), Vec3::Zero());
        potentials_[i]->add_forces(another);
        squares += dot(another, another);
        add_scaled(1, another, sum);
    }
    return sum;
}

NodeVectors Equilibrium::forces() const {
    double squares = 0;
    return forces(squares);
}

double Equilibrium::largest_step(const NodeVectors& x, const NodeVectors& by) const {
    double step = 1;
    for (const Potential* potential : potentials_)
        step = std::min(step, potential->largest_step(x, by));
    return step;
}

LinearSummary Equilibrium::direction(const NodeVectors& right, double tolerance, NodeVectors& d) {
    K_.set_zero();
    for (const Potential* potential : potentials_) potential->add_stiffness(K_);
    return solver_.solve(K_, held_, right, {tolerance, options_.linear_iterations, kCheap}, d);
}

LinearSummary Equilibrium::predict(const NodeVectors& x, NodeVectors& by) {
    double moved = 0;
    for (std::size_t n = 0; n < by.size(); ++n) {
        if (!held_[n]) by[n].setZero();
        moved = std::max(moved, by[n].squaredNorm());
    }
    if (!(moved > 0)) return {.converged = true};
    (void)energy(x);
    return direction(NodeVectors(x.size(), Vec3::Zero()), kGuess, by);
}

// Along d from x, where the forces are those. Returns the part of d that was gone, 0 when
// no step goes downhill.
double Equilibrium::line_search(const NodeVectors& forces_here, const NodeVectors& d,
                                double rounding, NodeVectors& x, double& level) {
    const double slope = -dot(forces_here, d);
    if (!(slope < 0)) return 0;
    double step = largest_step(x, d);
    if (step < 1) step *= kSafety;
    for (int i = 0; i < kMostHalvings; ++i, step *= 0.5) {
        NodeVectors trial = x;
        add_scaled(step, d, trial);
        const double there = energy(trial);
        const bool decreased = there <= level + kDecrease * step * slope;
        if (!decreased && !(there <= level + rounding)) continue;
        if (decreased || std::abs(dot(forces(), d)) <= kFlatter * std::abs(slope)) {
            x = std::move(trial);
            level = there;
            return step;
        }
    }
    (void)energy(x);
    return 0;
}

// A whole step of Newton's method that need not lower the energy. Returns whether it was
// taken; where it lowers the energy below that of the watched place, watching ends.
bool Equilibrium::bold_step(const NodeVectors& forces_here, const NodeVectors& d, NodeVectors& x,
                            double& level, Watch& watch) {
    if (watch.rest > 0) {
        --watch.rest;
        return false;
    }
    double step = largest_step(x, d);
    if (step < 1) step *= kSafety;
    if (step < kBold) return false;
    if (watch.steps == 0) watch = {x, forces_here, d, level, 0, 0, watch.rounding};
    if (watch.steps == kMostBold) return false;
    NodeVectors trial = x;
    add_scaled(step, d, trial);
    const double there = energy(trial);
    if (!(there <= level + kRaise * dot(forces_here, d))) return false;
    x = std::move(trial);
    level = there;
    ++watch.steps;
    if (level <= watch.level - kDecrease * dot(watch.forces, watch.d)) watch.steps = 0;
    return true;
}

EquilibriumSummary Equilibrium::find(NodeVectors& x) {
    EquilibriumSummary summary;
    const int factors = solver_.factors();
    summary.energy = energy(x);
    summary.message = "the energy at the start is not finite";
    if (!std::isfinite(summary.energy)) return summary;
    Reach reach(x);
    Watch watch;
    for (double first = 0;;) {
        double squares = 0;
        NodeVectors f = forces(squares);
        for (std::size_t n = 0; n < f.size(); ++n)
            if (held_[n]) f[n].setZero();
        const double left = std::sqrt(dot(f, f));
        summary.residual = squares > 0 ? left / std::sqrt(squares) : 0;
        summary.history.push_back(summary.residual);
        summary.factors = solver_.factors() - factors;
        summary.converged = summary.residual <= options_.tolerance && watch.allows(summary.energy);
        summary.message = "forces balance";
        if (summary.converged) return summary;
        summary.stopped = options_.stop && options_.stop();
        summary.message = "stopped";
        if (summary.stopped) return summary;
        summary.message = "out of iterations";
        if (summary.iterations == options_.iterations) return summary;

        first = std::max(first, left);
        NodeVectors d(x.size(), Vec3::Zero());
        const double enough = kEnough * options_.tolerance / summary.residual;
        const LinearSummary linear =
            direction(f, std::clamp(std::max(left / first, enough), kTightest, kLoosest), d);
        ++summary.iterations;
        summary.linear_iterations += linear.iterations;

        const Rounding rounding(K_, x, summary.energy);
        watch.rounding = rounding.energy;
        summary.converged = left <= rounding.force && watch.allows(summary.energy);
        summary.message = "forces balance to rounding";
        if (summary.converged) return summary;
        const bool downward = !linear.downward.empty();
        if (!downward && bold_step(f, d, x, summary.energy, watch)) continue;
        if (watch.steps > 0) {
            // Boldness led uphill: back, and on as the energy says.
            x = watch.x;
            f = watch.forces;
            d = watch.d;
            summary.energy = watch.level;
            watch = {.rest = kRest, .rounding = rounding.energy};
        } else if (downward) {
            ++summary.indefinite_iterations;
            reach.extend(linear.downward, d);
        }
        const double step = line_search(f, d, rounding.energy, x, summary.energy);
        summary.message = "no step lowers the energy";
        if (!(step > 0)) return summary;
        if (downward) reach.learn(step);
    }
}

}  // namespace myotet::dynamics
