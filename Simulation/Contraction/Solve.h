// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Contraction/Checkpoint.h"
#include "Contraction/Model.h"
#include "Dynamics/Implicit.h"
#include "Dynamics/QuasiStatic.h"

namespace myotet::contraction {

/// How a scene's steps are solved.
struct SolveOptions {
    /// Slack tendons that straighten take many iterations, but far fewer than as many shorter
    /// steps.
    dynamics::EquilibriumOptions equilibrium{.iterations = 150};
    /// A step that finds no equilibrium is cut in halves, down to this part of the scene's;
    /// after an easy one they grow again.
    double least_part = 1.0 / 256;
};

/// Steps from 0 to the scene's end, and when step i ends, s; the last one may be shorter.
[[nodiscard]] int scene_steps(const Time& time);
[[nodiscard]] double scene_time(const Time& time, int step);

/// What a step of the scene took.
struct StepSummary {
    bool converged = false;
    bool stopped = false;  ///< as EquilibriumOptions::stop asked for
    std::string message;   ///< why not; which tetrahedra, where and how they are
    int steps = 0, failed_steps = 0;
    int iterations = 0, linear_iterations = 0, factors = 0;
    double residual = 0;  ///< the largest of its equilibria
};

/// A scene in time: where its nodes are, and how they get to the next moment.
class Simulation {
public:
    /// Scene and model must outlive it.
    Simulation(const Scene& scene, Model& model, const SolveOptions& options);

    /// Settles the bodies at time 0.
    [[nodiscard]] StepSummary begin();
    /// From the present time to a later one, in as many steps as it takes. When it does not
    /// converge, the simulation stands at the last moment that did; when it is stopped, where
    /// it stood before. What only saves time is forgotten at the end, so that whoever goes on
    /// from a checkpoint gets the same bytes.
    [[nodiscard]] StepSummary advance(double to);

    [[nodiscard]] double time() const { return motion_.time; }
    [[nodiscard]] const std::vector<Vec3>& positions() const { return motion_.x; }
    [[nodiscard]] const std::vector<Vec3>& velocities() const { return motion_.v; }
    /// Forces of the bodies on all nodes, N: on held nodes, what pulls at the bones.
    [[nodiscard]] const std::vector<Vec3>& forces() const { return motion_.f; }
    /// Of each contact of the scene.
    [[nodiscard]] std::vector<ContactReport> contacts() const { return contacts_->reports(); }
    [[nodiscard]] double activation(std::size_t body) const { return activation_[body]; }

    void save(Checkpoint& checkpoint) const;
    void load(const Checkpoint& checkpoint);

private:
    void apply(double time, std::vector<Vec3>& x);
    void make_contacts();
    void make_solver();
    void drop_solver();
    [[nodiscard]] dynamics::LinearSolver* linear_solver();
    void forget();
    [[nodiscard]] dynamics::EquilibriumSummary step_to(double time);
    void begin_rates(double seconds);
    void accept_rates();
    void settle_rates();
    [[nodiscard]] std::string trouble() const;

    const Scene& scene_;
    Model& model_;
    SolveOptions options_;
    std::vector<dynamics::Potential*> bodies_, potentials_;  // and with contacts
    std::vector<std::int32_t> held_;
    std::unique_ptr<SceneContacts> contacts_;
    std::unique_ptr<dynamics::LoadStepper> quasi_static_;
    std::unique_ptr<dynamics::ImplicitIntegrator> implicit_;
    dynamics::Motion motion_;
    std::vector<double> activation_;
    double part_ = 1;           // of the scene's step that is tried next
    bool factor_pays_ = false;  // what solvers have learned so far
};

}  // namespace myotet::contraction
