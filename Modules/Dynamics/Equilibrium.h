// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "Dynamics/LinearSolver.h"
#include "Dynamics/Potential.h"

namespace myotet::dynamics {

/// How well and how long equilibrium is sought.
struct EquilibriumOptions {
    /// Ends when the force left on free nodes is this part of what each potential does to
    /// all nodes, held ones included (root sums of squares), or no more than rounding of
    /// the positions does.
    double tolerance = 1e-6;
    int iterations = 40;           ///< of Newton's method, at most
    int linear_iterations = 2000;  ///< of conjugate gradients in each, at most
    LinearMethod linear_method = LinearMethod::automatic;
    std::function<bool()> stop;  ///< asked before each iteration; empty: never
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

struct EquilibriumSummary {
    bool converged = false;
    bool stopped = false;  ///< as options asked for
    std::string message = "not run";
    int iterations = 0;             ///< of Newton's method
    int indefinite_iterations = 0;  ///< of those, where the energy curved downwards
    int linear_iterations = 0;      ///< of conjugate gradients in all
    int factors = 0;                ///< Cholesky factors made
    double residual = 0;            ///< as `tolerance` measures it
    double energy = 0;              ///< mJ
    std::vector<double> history;    ///< residual before each iteration and at the end
};

/// Finds positions where the sum of some potentials is least while some nodes are
/// held, by Newton's method [Nocedal and Wright 2006, ch. 3, 7, 15.4]:
/// - a direction d from K d = f by conjugate gradients, solved the better the nearer the
///   end (relative residual |f| / |f at the start|: second order is kept), but no better
///   than the end needs;
/// - where the energy curves downwards, as in buckling, as far as conjugate gradients
///   came and on along the curve, by a reach that grows while such steps succeed;
/// - a step at most 90 % of the way to where the energy becomes infinite: up to five whole
///   steps in a row that may raise the energy, as they do where volume hardly changes, as
///   long as it ends lower (watchdog); where it does not, from where they began, halved
///   until the energy has decreased by 1e-4 of what the slope promises (Armijo) or, where
///   rounding hides that, the slope.
/// So no tetrahedron ever inverts, the energy at the end is not above that at the start but
/// for rounding, and buckling is followed to where it ends.
///
/// Cost of an iteration on a lattice's mesh: about 1.2 us a tetrahedron, and 0.017 us for
/// each iteration of conjugate gradients, some 50 to 400. Same bytes on any number of
/// threads.
class Equilibrium {
public:
    /// The potentials must outlive it. Throws InputError when an option breaks its rule,
    /// a held node is not among the nodes, or there is no potential.
    Equilibrium(std::vector<Potential*> potentials, std::size_t nodes,
                const std::vector<std::int32_t>& held, const EquilibriumOptions& options);

    /// From x, where the energy must be finite. When it does not converge, x is the best
    /// found.
    [[nodiscard]] EquilibriumSummary find(NodeVectors& x);

    /// To first order, how free nodes go along when the held ones move by what `by` says of
    /// them: one solve at x, none when nothing moves. The first guess of a load step; what
    /// else changes is left to find(), which looks how far each step may go.
    [[nodiscard]] LinearSummary predict(const NodeVectors& x, NodeVectors& by);

    /// The least of what the potentials allow.
    [[nodiscard]] double largest_step(const NodeVectors& x, const NodeVectors& by) const;

    /// Forces of the potentials on all nodes where they stand, N: nothing on free nodes
    /// in equilibrium; on held ones, minus what holds them.
    [[nodiscard]] NodeVectors forces() const;

    /// The solver of its linear equations, which remembers from one call to the next.
    [[nodiscard]] LinearSolver& solver() { return solver_; }

private:
    [[nodiscard]] double energy(const NodeVectors& x);
    [[nodiscard]] LinearSummary direction(const NodeVectors& right, double tolerance,
                                          NodeVectors& d);
    [[nodiscard]] NodeVectors forces(double& squares) const;
    // Where a run of bold steps began.
    struct Watch {
        NodeVectors x, forces, d;
        double level = 0;
        int steps = 0;        ///< taken since, with the energy not below
        int rest = 0;         ///< careful steps before the next bold one
        double rounding = 0;  ///< of energies
        [[nodiscard]] bool allows(double energy) const {
            return steps == 0 || energy <= level + rounding;
        }
    };
    bool bold_step(const NodeVectors& forces, const NodeVectors& d, NodeVectors& x, double& level,
                   Watch& watch);
    double line_search(const NodeVectors& forces, const NodeVectors& d, double rounding,
                       NodeVectors& x, double& level);

    std::vector<Potential*> potentials_;
    std::vector<char> held_;
    EquilibriumOptions options_;
    BlockMatrix K_;
    LinearSolver solver_;
};

}  // namespace myotet::dynamics
