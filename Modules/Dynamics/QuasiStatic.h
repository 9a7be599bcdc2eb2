// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Dynamics/Equilibrium.h"

namespace myotet::dynamics {

/// Moves the held nodes (and no other) to where they are at a load or time, and changes what
/// the potentials depend on besides, such as activation. A load may come again, and a lower
/// one after a higher one.
using ApplyLoad = std::function<void(double load, NodeVectors& x)>;

/// From one equilibrium to the next.
class LoadStepper {
public:
    /// As Equilibrium.
    LoadStepper(const std::vector<Potential*>& potentials, std::size_t nodes,
                const std::vector<std::int32_t>& held, const EquilibriumOptions& options);
    /// From x, an equilibrium, to the equilibrium at `load`; x changes only when that is
    /// found. Begins where the linearised body would be, which must not pass a flat
    /// tetrahedron.
    [[nodiscard]] EquilibriumSummary go_to(double load, const ApplyLoad& apply, NodeVectors& x);
    /// Of the potentials where they stand, N.
    [[nodiscard]] NodeVectors forces() const { return equilibrium_.forces(); }
    [[nodiscard]] LinearSolver& solver() { return equilibrium_.solver(); }

private:
    Equilibrium equilibrium_;
};

/// A body taken slowly from a load of 0 to one of 1.
struct LoadCase {
    std::vector<Potential*> potentials;  ///< their sum is the energy; at least one
    std::vector<std::int32_t> held;      ///< nodes whose positions are prescribed
    ApplyLoad apply;
};

struct LoadOptions {
    double first_step = 0.1;   ///< of the load
    double most_step = 0.2;    ///< grows up to this while steps are easy
    double least_step = 1e-3;  ///< gives up below it
    int easy_iterations = 4;   ///< a step of at most so many lets the next one grow
    EquilibriumOptions equilibrium;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// An equilibrium on the way.
struct LoadState {
    double load = 0;
    const NodeVectors& x;       ///< mm
    const NodeVectors& forces;  ///< of the potentials, N; on held nodes, minus what holds them
    const EquilibriumSummary& equilibrium;
};

struct LoadSummary {
    bool completed = false;  ///< a load of 1 was reached
    std::string message = "not run";
    double load = 0;  ///< the last one in equilibrium
    int steps = 0, failed_steps = 0;
    int iterations = 0, indefinite_iterations = 0, linear_iterations = 0;  ///< failed steps' too
    double residual = 0;  ///< the largest of an accepted step
};

/// Takes x, the equilibrium at load 0, through equilibria to load 1, or as far as it
/// goes. Each step begins where the linearised body would be, which must not pass a flat
/// tetrahedron; a step that would, or finds no equilibrium, is halved. `watch` sees each
/// equilibrium, the first at load 0. Same bytes on any number of threads.
/// Throws InputError when an option or the case breaks a rule.
[[nodiscard]] LoadSummary apply_load(const LoadCase& load_case, const LoadOptions& options,
                                     NodeVectors& x,
                                     const std::function<void(const LoadState&)>& watch);

}  // namespace myotet::dynamics
