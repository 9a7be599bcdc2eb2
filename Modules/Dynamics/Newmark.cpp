// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Newmark.h"

#include <cmath>

#include "Core/Parallel.h"
#include "Dynamics/NodeAlgebra.h"

namespace myotet::dynamics {
namespace {

constexpr std::size_t kGrain = 4096;

NodeVectors zeros(const Problem& problem) {
    return NodeVectors(problem.masses.size(), Vec3::Zero());
}

void remove_constrained(const Problem& problem, NodeVectors& r) {
    for (const VelocityConstraint& c : problem.constraints)
        r[c.node] -= r[c.node].dot(c.direction) * c.direction;
}

void obey(const Problem& problem, NodeVectors& v) {
    for (const VelocityConstraint& c : problem.constraints)
        v[c.node] += (c.speed - v[c.node].dot(c.direction)) * c.direction;
}

// (M - s D) v
NodeVectors apply(const Problem& problem, double s, const NodeVectors& v) {
    NodeVectors out = zeros(problem);
    problem.forces->add_damping(v, out);
    parallel_for(0, v.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) out[i] = problem.masses[i] * v[i] - s * out[i];
    });
    return out;
}

NodeVectors preconditioned(const Problem& problem, const NodeVectors& r) {
    NodeVectors z = r;
    for (std::size_t i = 0; i < z.size(); ++i) z[i] /= problem.masses[i];
    return z;
}

SolverSummary worse(const SolverSummary& a, const SolverSummary& b) {
    return {a.converged && b.converged, std::max(a.iterations, b.iterations),
            std::max(a.residual, b.residual)};
}

}  // namespace

SolverSummary solve_damped(const Problem& problem, double s, const NodeVectors& right,
                           const SolverOptions& options, NodeVectors& v) {
    obey(problem, v);
    NodeVectors r = right;
    add_scaled(-1, apply(problem, s, v), r);
    remove_constrained(problem, r);
    NodeVectors z = preconditioned(problem, r);
    NodeVectors p = z;
    double rz = dot(r, z);
    // Measured against the right hand side: a good first guess ends at once.
    const double scale = dot(right, preconditioned(problem, right)) + rz;
    SolverSummary summary;
    const auto settled = [&] {
        summary.residual = scale > 0 ? std::sqrt(rz / scale) : 0;
        return summary.converged = summary.residual <= options.tolerance;
    };
    while (!settled() && summary.iterations < options.iterations) {
        NodeVectors q = apply(problem, s, p);
        remove_constrained(problem, q);
        const double alpha = rz / dot(p, q);
        if (!std::isfinite(alpha)) break;
        add_scaled(alpha, p, v);
        add_scaled(-alpha, q, r);
        z = preconditioned(problem, r);
        const double next = dot(r, z);
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + next / rz * p[i];
        rz = next;
        ++summary.iterations;
    }
    return summary;
}

SolverSummary newmark_step(const Problem& problem, double time_step, const SolverOptions& options,
                           State& state) {
    const double half = 0.5 * time_step;
    ForceField& field = *problem.forces;
    NodeVectors elastic = zeros(problem);
    field.add_elastic(elastic);

    NodeVectors right = elastic;  // M v + dt/2 F
    NodeVectors later = elastic;  // gathers M v + dt/2 (F + D v) + dt/2 F after
    field.add_damping(state.v, later);
    for (std::size_t i = 0; i < right.size(); ++i) {
        right[i] = problem.masses[i] * state.v[i] + half * right[i];
        later[i] = problem.masses[i] * state.v[i] + half * later[i];
    }
    NodeVectors halfway = state.v;
    const SolverSummary first = solve_damped(problem, half, right, options, halfway);
    if (problem.limit) problem.limit(state.x, halfway, time_step);

    add_scaled(time_step, halfway, state.x);
    field.move_to(state.x);
    elastic = zeros(problem);
    field.add_elastic(elastic);
    add_scaled(half, elastic, later);
    state.v = std::move(halfway);  // as first guess
    const SolverSummary second = solve_damped(problem, half, later, options, state.v);
    if (problem.limit) problem.limit(state.x, state.v, time_step);
    state.time += time_step;
    return worse(first, second);
}

}  // namespace myotet::dynamics
