// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "Dynamics/ForceField.h"

namespace myotet::dynamics {

struct State {
    NodeVectors x, v;
    double time = 0;  ///< s
};

/// A node whose velocity along a direction is prescribed; the rest is free.
struct VelocityConstraint {
    std::int32_t node = 0;
    Vec3 direction = Vec3::UnitX();  ///< unit
    double speed = 0;                ///< mm/s
};

/// Changes velocities in place, so that strain or strain rate stay bounded over
/// the next `time_step`.
using VelocityLimiter = std::function<void(const NodeVectors& x, NodeVectors& v, double time_step)>;

/// What is integrated.
struct Problem {
    std::vector<double> masses;  ///< t, one a node, positive
    ForceField* forces = nullptr;
    VelocityLimiter limit = {};                   ///< empty: none
    std::vector<VelocityConstraint> constraints;  ///< at most one a node
};

struct SolverOptions {
    double tolerance = 1e-6;  ///< of the residual, relative to the first one
    int iterations = 300;     ///< at most
};

/// What a solver did.
struct SolverSummary {
    bool converged = false;
    int iterations = 0;
    double residual = 0;  ///< relative
};

/// Solves (M - s D) v = right, D the field's damping at its present positions,
/// by conjugate gradients preconditioned by the masses, within the constraints
/// (filtered as in Baraff and Witkin 1998). `v` holds the first guess and
/// receives the result. Same bytes on any number of threads.
[[nodiscard]] SolverSummary solve_damped(const Problem& problem, double s, const NodeVectors& right,
                                         const SolverOptions& options, NodeVectors& v);

/// One step of the modified central Newmark scheme [Teran05, sec. 7, with its
/// erratum]: elastic forces explicit, damping implicit,
///   1. v' = v + dt/2 a(x, v')
///   2. limit v'
///   3. x <- x + dt v'
///   4. v <- v + dt/2 (a(x before, v before) + a(x, v))
///   5. limit v
/// Second order in x and v; stable for dt below about the time that sound takes
/// through the smallest element, however strong the damping. The field must
/// stand at state.x before, and does so afterwards.
/// Returns the worse of the two solvers' summaries.
[[nodiscard]] SolverSummary newmark_step(const Problem& problem, double time_step,
                                         const SolverOptions& options, State& state);

}  // namespace myotet::dynamics
