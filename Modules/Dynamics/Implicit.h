// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Dynamics/Equilibrium.h"
#include "Dynamics/Inertia.h"

namespace myotet::dynamics {

/// Nodes in motion, and what the next time step needs to know of them.
struct Motion {
    NodeVectors x, v, a;  ///< mm, mm/s, mm/s^2
    NodeVectors f;        ///< N, of the potentials at x as they were at `time`
    double time = 0;      ///< s
};

/// sum_i m_i |v_i|^2 / 2, mJ
[[nodiscard]] double kinetic_energy(const std::vector<double>& masses, const NodeVectors& v);

enum class TimeScheme {
    backward_euler,     ///< first order; damps all that is faster than a step
    generalized_alpha,  ///< second order; damps what is much faster, by rho_infinity a step
};

struct ImplicitOptions {
    TimeScheme scheme = TimeScheme::generalized_alpha;
    /// What a step leaves of a vibration much faster than it, with generalized_alpha: 0 to
    /// 1. 1 is the trapezoidal rule, which damps nothing.
    double rho_infinity = 0.9;
    double mass_damping = 0;  ///< 1/s: a force of this times mass and velocity against motion
    EquilibriumOptions equilibrium;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Time steps of any length, each the least of a potential, which Equilibrium finds: so no
/// tetrahedron inverts, and where a body buckles the step still ends. Generalized alpha
/// [Chung and Hulbert 1993]: with
///   x = x~ + beta dt^2 a,  x~ = x_n + dt v_n + dt^2 (1/2 - beta) a_n
///   v = v~ + gamma dt a,   v~ = v_n + dt (1 - gamma) a_n
/// inertia, mass damping c and the potentials' forces f balance in
///   (1 - am) M a + am M a_n + c M ((1 - af) v + af v_n) = (1 - af) f(x) + af f_n,
///   af = rho / (1 + rho), am = (2 rho - 1) / (1 + rho), gamma = 1/2 - am + af,
///   beta = (1 - am + af)^2 / 4,
/// where forces are averaged, not positions: that is what makes x the least of
///   (1 - af) Psi(x) - af f_n . x + terms of M, quadratic in x.
/// Backward Euler: am = af = 0, beta = gamma = 1, x~ = x_n + dt v_n.
///
/// Neither keeps angular momentum exactly; what is lost falls with the order of the scheme.
/// Cost of a step: two to five iterations of Newton's method, see Equilibrium; 11 to 80 ms
/// for 3 000 tetrahedra in patches on one thread. Same bytes on any number of threads.
class ImplicitIntegrator {
public:
    /// Moves held nodes (and no other) to where they are at a time, and changes what the
    /// potentials depend on besides, such as activation. A time may come again, and an
    /// earlier one after a later one.
    using Apply = std::function<void(double time, NodeVectors& x)>;

    /// `masses`, t: one a node, positive at free nodes. The potentials must outlive it.
    /// Throws InputError when an option or a mass breaks its rule.
    ImplicitIntegrator(std::vector<Potential*> potentials, std::vector<double> masses,
                       const std::vector<std::int32_t>& held, const ImplicitOptions& options);
    ImplicitIntegrator(const ImplicitIntegrator&) = delete;
    ImplicitIntegrator& operator=(const ImplicitIntegrator&) = delete;

    /// A motion that begins at time 0 with these positions and velocities, its accelerations
    /// those of the potentials as they are now.
    [[nodiscard]] Motion start(const NodeVectors& x, const NodeVectors& v);

    /// One step of dt seconds. Its equilibrium is sought from where velocities lead; where
    /// that flattens a tetrahedron or is uphill, from the linearised end of the step, or from
    /// where free nodes are. When it does not converge the motion is unchanged: try a
    /// shorter step. The velocities and accelerations of held nodes are differences over
    /// the step. The summary's energy is that of the potentials, without inertia. `apply`
    /// may be empty. Throws InputError unless dt > 0 and the motion has one of each a node.
    [[nodiscard]] EquilibriumSummary step(double dt, const Apply& apply, Motion& motion);
    [[nodiscard]] LinearSolver& solver() { return equilibrium_.solver(); }

private:
    struct Coefficients {
        double am = 0, af = 0, beta = 1, gamma = 1, xi = 0;  // x~ = x_n + dt v_n + xi dt^2 a_n
        explicit Coefficients(const ImplicitOptions& options);
    };
    [[nodiscard]] Vec3 x_tilde(double dt, const Motion& motion, std::size_t n) const;
    [[nodiscard]] Vec3 v_tilde(double dt, const Motion& motion, std::size_t n) const;
    void set_inertia(double dt, const Motion& motion);
    [[nodiscard]] bool guess(double dt, const Motion& motion, NodeVectors& there,
                             EquilibriumSummary& summary);
    [[nodiscard]] double energy_after(const NodeVectors& x, const NodeVectors& by);
    [[nodiscard]] bool fits(const NodeVectors& x, const NodeVectors& by) const;
    void advance(double dt, NodeVectors x, Motion& motion) const;
    [[nodiscard]] NodeVectors forces() const;

    std::vector<Potential*> potentials_;
    std::vector<double> masses_;
    std::vector<char> held_;
    double mass_damping_;
    Coefficients scheme_;
    Inertia inertia_;
    Equilibrium equilibrium_;
};

}  // namespace myotet::dynamics
