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
constexpr double kGuess = 0.01;
// The last solve aims at this part of the tolerance.
constexpr double kEnough = 0.3;
// How far along a downward curve a node may move at first, and least: parts of the body.
constexpr double kReach = 0.02, kLeastReach = 1e-4;

// What rounding of the positions alone does to forces and energies: epsilon times
// |K| |x|, and |K| times the squared distance of neighbours.
struct Rounding {
    double force = 0, energy = 0;

    Rounding(const BlockMatrix& K, const NodeVectors& x) {
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
    : potentials_(std::move(potentials)), held_(nodes, 0), options_(options) {
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

NodeVectors Equilibrium::forces() const {
    NodeVectors sum(held_.size(), Vec3::Zero());
    for (const Potential* potential : potentials_) potential->add_forces(sum);
    return sum;
}

double Equilibrium::largest_step(const NodeVectors& x, const NodeVectors& by) const {
    double step = 1;
    for (const Potential* potential : potentials_)
        step = std::min(step, potential->largest_step(x, by));
    return step;
}

// Root mean forces: of free nodes beside all.
double Equilibrium::residual(const NodeVectors& forces) const {
    NodeVectors left = forces;
    for (std::size_t n = 0; n < left.size(); ++n)
        if (held_[n]) left[n].setZero();
    const double all = dot(forces, forces);
    return all > 0 ? std::sqrt(dot(left, left) / all) : 0;
}

LinearSummary Equilibrium::direction(const NodeVectors& right, double tolerance, NodeVectors& d) {
    K_.set_zero();
    for (const Potential* potential : potentials_) potential->add_stiffness(K_);
    return solve(K_, held_, right, {tolerance, options_.linear_iterations}, d);
}

LinearSummary Equilibrium::predict(const NodeVectors& x, NodeVectors& by) {
    for (std::size_t n = 0; n < by.size(); ++n)
        if (!held_[n]) by[n].setZero();
    (void)energy(x);
    return direction(forces(), kGuess, by);
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

EquilibriumSummary Equilibrium::find(NodeVectors& x) {
    EquilibriumSummary summary;
    summary.energy = energy(x);
    summary.message = "the energy at the start is not finite";
    if (!std::isfinite(summary.energy)) return summary;
    Reach reach(x);
    for (double first = 0;;) {
        NodeVectors f = forces();
        summary.residual = residual(f);
        summary.history.push_back(summary.residual);
        summary.converged = summary.residual <= options_.tolerance;
        summary.message = "forces balance";
        if (summary.converged) return summary;
        summary.message = "out of iterations";
        if (summary.iterations == options_.iterations) return summary;

        for (std::size_t n = 0; n < f.size(); ++n)
            if (held_[n]) f[n].setZero();
        const double left = std::sqrt(dot(f, f));
        first = std::max(first, left);
        NodeVectors d(x.size(), Vec3::Zero());
        const double enough = kEnough * options_.tolerance / summary.residual;
        const LinearSummary linear =
            direction(f, std::clamp(std::max(left / first, enough), kTightest, kLoosest), d);
        ++summary.iterations;
        summary.linear_iterations += linear.iterations;

        const Rounding rounding(K_, x);
        summary.converged = left <= rounding.force;
        summary.message = "forces balance to rounding";
        if (summary.converged) return summary;
        if (!linear.downward.empty()) {
            ++summary.indefinite_iterations;
            reach.extend(linear.downward, d);
        }
        const double step = line_search(f, d, rounding.energy, x, summary.energy);
        summary.message = "no step lowers the energy";
        if (!(step > 0)) return summary;
        if (!linear.downward.empty()) reach.learn(step);
    }
}

}  // namespace myotet::dynamics
