// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Play/Detect.h"
#include "Play/Solve.h"

namespace myotet::play {

/// Where nodes are and how they move.
struct State {
    dynamics::NodeVectors x, v;  ///< mm, mm/s
    double time = 0;             ///< s
};

struct StepOptions {
    int iterations = 8;  ///< of Newton's method in a part of a step, at most
    /// Ends when an iteration moved no node farther, in mean edges of the finest mesh.
    double tolerance = 3e-2;
    int parts = 4;  ///< that a step may be cut into where things close in on each other fast
    SolveOptions linear;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// mJ; elastic of a muscle: with what its activation stores.
struct Energies {
    double kinetic = 0, elastic = 0, weight = 0, contact = 0;
    [[nodiscard]] double total() const { return kinetic + elastic + weight + contact; }
};

struct StepReport {
    int parts = 1;  ///< that the step was cut into
    int iterations = 0, linear_iterations = 0;
    bool settled = false;       ///< the tolerance was met
    int touching = 0;           ///< touches that press at the end
    double press = 0;           ///< sum of their forces, N
    double deepest_before = 0;  ///< at the step's beginning, see Touches, mm
    Energies energies;          ///< at the end
};

/// Backward Euler in steps that must take little time: with y = x_n + dt v_n + dt^2 g each
/// step seeks the least of
///   sum_i m_i / (2 dt^2) |x_i - y_i|^2 + Psi(x) + touches(x)
/// by a few iterations of Newton's method, v = (x - x_n) / dt [Martin and others 2011;
/// Gast and others 2015]. What may touch is found once, where the step begins. Each
/// iteration solves by conjugate gradients and goes at most nine tenths of the way to where
/// a tetrahedron would be flat, halved until the sum is less (Armijo): no tetrahedron ever
/// inverts, however few the iterations. A step is cut into parts where things close in on each
/// other by more than a mean edge in it.
///
/// A body that nothing touches or holds keeps its momentum to rounding: what conjugate
/// gradients left of it is made up by a shift of the whole body, which no energy feels.
/// Backward Euler takes energy and spin from what moves, the more the longer the step.
class Stepper {
public:
    /// The world must outlive it. Throws InputError where options or contact break a rule.
    Stepper(World& world, const StepOptions& options);

    /// At rest as the world says, with its velocities.
    [[nodiscard]] State start();
    /// One step of dt seconds. Throws InputError unless dt is positive.
    StepReport step(double dt, State& state);

    /// Where the state is.
    [[nodiscard]] Energies energies(const State& state);
    /// How deep samples of one thing are in another, mm; 0: none is.
    [[nodiscard]] double deepest(const State& state);
    /// The smallest det F of any tetrahedron there.
    [[nodiscard]] double smallest_volume_ratio(const State& state) const;

private:
    [[nodiscard]] double move_bodies(const dynamics::NodeVectors& x);
    [[nodiscard]] double energy(const dynamics::NodeVectors& x);
    [[nodiscard]] double largest_step(const dynamics::NodeVectors& x,
                                      const dynamics::NodeVectors& by) const;
    [[nodiscard]] int parts() const;
    void solve_step(double dt, State& state, StepReport& report);
    void begin(double dt, const State& state);
    void first_guess(dynamics::NodeVectors& x);
    void assemble(const dynamics::NodeVectors& x);
    double search(const dynamics::NodeVectors& d, dynamics::NodeVectors& x);
    void mend_momentum(dynamics::NodeVectors& x) const;

    World& world_;
    StepOptions options_;
    double edge_ = 0;  // shortest mean edge, mm
    dynamics::BlockMatrix K_;
    std::vector<std::size_t> diagonal_;  // places of the diagonal blocks
    // Of the step at hand.
    double per_time_ = 0;          // 1 / dt^2
    dynamics::NodeVectors ahead_;  // y
    Touches touches_;
    dynamics::NodeVectors forces_;  // minus the gradient of the sum
    double level_ = 0;              // the sum where x is
};

}  // namespace myotet::play
