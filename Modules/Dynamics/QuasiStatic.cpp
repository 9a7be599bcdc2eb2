// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/QuasiStatic.h"

#include <algorithm>
#include <cmath>

#include "Dynamics/NodeAlgebra.h"
#include "Dynamics/Require.h"

namespace myotet::dynamics {
namespace {

// A guess may use up this part of the way to the first flat tetrahedron.
constexpr double kMostOfTheWay = 0.7;
constexpr double kGrowth = 1.5;
// Loads nearer to one another than this are the same.
constexpr double kSameLoad = 1e-12;

void record(const EquilibriumSummary& step, double load, LoadSummary& summary) {
    summary.iterations += step.iterations;
    summary.indefinite_iterations += step.indefinite_iterations;
    summary.linear_iterations += step.linear_iterations;
    if (!step.converged) {
        ++summary.failed_steps;
        return;
    }
    ++summary.steps;
    summary.load = load;
    summary.residual = std::max(summary.residual, step.residual);
}

}  // namespace

LoadStepper::LoadStepper(const std::vector<Potential*>& potentials, std::size_t nodes,
                         const std::vector<std::int32_t>& held, const EquilibriumOptions& options)
    : equilibrium_(potentials, nodes, held, options) {}

EquilibriumSummary LoadStepper::go_to(double load, const ApplyLoad& apply, NodeVectors& x) {
    NodeVectors there = x;
    apply(load, there);
    NodeVectors by = there;
    add_scaled(-1, x, by);
    EquilibriumSummary summary;
    const LinearSummary guess = equilibrium_.predict(x, by);
    NodeVectors farther = by;
    for (Vec3& p : farther) p /= kMostOfTheWay;
    if (equilibrium_.largest_step(x, farther) < 1) {
        summary.message = "a tetrahedron would be flattened";
    } else {
        there = x;
        add_scaled(1, by, there);
        apply(load, there);
        summary = equilibrium_.find(there);
    }
    summary.linear_iterations += guess.iterations;
    if (summary.converged) x = std::move(there);
    return summary;
}

void LoadOptions::validate() const {
    require(least_step > 0, "least step", least_step, "it must be positive");
    require(first_step >= least_step && first_step <= 1, "first step", first_step,
            "it must lie between the least step and 1");
    require(most_step >= first_step && most_step <= 1, "most step", most_step,
            "it must lie between the first step and 1");
    require(easy_iterations >= 0, "number of easy iterations", easy_iterations,
            "it must not be negative");
    equilibrium.validate();
}

LoadSummary apply_load(const LoadCase& load_case, const LoadOptions& options, NodeVectors& x,
                       const std::function<void(const LoadState&)>& watch) {
    options.validate();
    if (!load_case.apply)
        throw InputError("LoadCase::apply is empty, but something must move the held nodes");
    LoadStepper stepper(load_case.potentials, x.size(), load_case.held, options.equilibrium);
    LoadSummary summary;
    const auto show = [&](double load, const EquilibriumSummary& step) {
        if (watch) watch({load, x, stepper.forces(), step});
    };
    const EquilibriumSummary start = stepper.go_to(0, load_case.apply, x);
    record(start, 0, summary);
    summary.message = "no equilibrium at the start: " + start.message;
    if (!start.converged) return summary;
    summary.steps = 0;
    show(0, start);
    for (double size = options.first_step; summary.load < 1 - kSameLoad;) {
        const double load = std::min(1.0, summary.load + size);
        const EquilibriumSummary step = stepper.go_to(load, load_case.apply, x);
        record(step, load, summary);
        if (step.converged) {
            show(load, step);
            if (step.iterations <= options.easy_iterations)
                size = std::min(options.most_step, kGrowth * size);
            continue;
        }
        size *= 0.5;
        summary.message = "no equilibrium beyond: " + step.message;
        if (size < options.least_step) return summary;
    }
    summary.completed = true;
    summary.message = "the whole load is on";
    return summary;
}

}  // namespace myotet::dynamics
