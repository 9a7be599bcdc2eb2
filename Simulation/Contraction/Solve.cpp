// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Solve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "Contraction/Words.h"
#include "Core/Text.h"

namespace myotet::contraction {
namespace {

// A step of at most so many iterations lets the next one be longer.
constexpr int kEasy = 8;
// After one of more, the next one is shorter.
constexpr int kHard = 25;
// The first steps of quasi-static scenes are short: slack tendons have yet to straighten.
constexpr double kFirstPart = 1.0 / 16;
// Times nearer than this part of a step are the same.
constexpr double kSameTime = 1e-9;
// A last step shorter than this part of one is none.
constexpr double kSameEnd = 1e-6;
// Tetrahedra that a failed step names.
constexpr std::size_t kNamed = 3;

std::vector<double> flat(const std::vector<Vec3>& vectors) {
    std::vector<double> numbers;
    numbers.reserve(3 * vectors.size());
    for (const Vec3& v : vectors) numbers.insert(numbers.end(), v.data(), v.data() + 3);
    return numbers;
}

std::vector<Vec3> vectors_of(const std::vector<double>& numbers) {
    std::vector<Vec3> vectors(numbers.size() / 3);
    for (std::size_t n = 0; n < vectors.size(); ++n)
        vectors[n] = Vec3(numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2]);
    return vectors;
}

}  // namespace

int scene_steps(const Time& time) {
    return static_cast<int>(std::ceil(time.end / time.step - kSameEnd));
}

double scene_time(const Time& time, int step) {
    return step == scene_steps(time) ? time.end : step * time.step;
}

Simulation::Simulation(const Scene& scene, Model& model, const SolveOptions& options)
    : scene_(scene), model_(model), options_(options), activation_(model.bodies.size(), 0.0) {
    for (BodyModel& body : model.bodies) bodies_.push_back(body.elastic.get());
    if (model.weight) bodies_.push_back(model.weight.get());
    make_contacts();
    for (const HeldGroup& group : model.held)
        held_.insert(held_.end(), group.nodes.begin(), group.nodes.end());
    const std::vector<Vec3> still(model.rest.size(), Vec3::Zero());
    motion_ = {model.rest, still, still, still, 0};
    if (scene.time.scheme == Scheme::quasi_static) part_ = kFirstPart;
}

void Simulation::make_contacts() {
    contacts_ = std::make_unique<SceneContacts>(scene_, model_.contacts, model_.rest);
    potentials_ = bodies_;
    for (dynamics::Potential* contact : contacts_->potentials()) potentials_.push_back(contact);
}

void Simulation::make_solver() {
    if (quasi_static_ || implicit_) return;
    dynamics::EquilibriumOptions equilibrium = options_.equilibrium;
    if (factor_pays_) equilibrium.linear_method = dynamics::LinearMethod::factored;
    if (scene_.time.scheme == Scheme::quasi_static) {
        quasi_static_ = std::make_unique<dynamics::LoadStepper>(potentials_, model_.rest.size(),
                                                                held_, equilibrium);
        return;
    }
    dynamics::ImplicitOptions options;
    options.scheme = scene_.time.scheme == Scheme::generalized_alpha
                         ? dynamics::TimeScheme::generalized_alpha
                         : dynamics::TimeScheme::backward_euler;
    options.rho_infinity = scene_.time.rho_infinity;
    options.mass_damping = scene_.time.damping;
    options.equilibrium = std::move(equilibrium);
    implicit_ =
        std::make_unique<dynamics::ImplicitIntegrator>(potentials_, model_.masses, held_, options);
}

dynamics::LinearSolver* Simulation::linear_solver() {
    if (quasi_static_) return &quasi_static_->solver();
    return implicit_ ? &implicit_->solver() : nullptr;
}

void Simulation::drop_solver() {
    if (const auto* solver = linear_solver()) factor_pays_ = solver->factored();
    quasi_static_.reset();
    implicit_.reset();
}

void Simulation::forget() {
    if (auto* solver = linear_solver()) {
        factor_pays_ = solver->factored();
        solver->forget();
    }
    contacts_->forget();
}

void Simulation::apply(double time, std::vector<Vec3>& x) {
    contacts_->set_time(time);
    for (const HeldGroup& group : model_.held) {
        const Pose pose = group.bone < 0 ? Pose{} : pose_at(scene_.bones[group.bone].motion, time);
        for (const std::int32_t n : group.nodes) x[n] = pose(model_.rest[n]);
    }
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
        activation_[b] = value_at(scene_.bodies[b].activation, time);
        muscle::TissueLaw& law = *model_.bodies[b].law;
        law.set_activation(std::vector<double>(law.activation().size(), activation_[b]));
    }
}

// What depends on speeds takes them as differences over the step, so that positions alone
// tell where a run stands.
void Simulation::begin_rates(double seconds) {
    for (BodyModel& body : model_.bodies) {
        body.law->begin_step(seconds);
        if (body.viscous) body.viscous->begin_step(seconds, elasticity::RateOrder::first);
    }
}

void Simulation::accept_rates() {
    for (BodyModel& body : model_.bodies) {
        body.law->accept(body.elastic->gradients());
        if (body.viscous) body.viscous->accept(body.elastic->gradients());
    }
}

// The bodies have long been where they are.
void Simulation::settle_rates() {
    for (BodyModel& body : model_.bodies) {
        body.law->accept(body.elastic->gradients());
        if (body.viscous) body.viscous->stop(body.elastic->gradients());
    }
}

dynamics::EquilibriumSummary Simulation::step_to(double time) {
    // A matrix has room for the nodes that are near one another now.
    if (contacts_->update_pairs(motion_.x)) drop_solver();
    make_solver();
    const auto moved = [this](double at, std::vector<Vec3>& x) { apply(at, x); };
    dynamics::EquilibriumSummary summary;
    if (quasi_static_) {
        summary = quasi_static_->go_to(time, moved, motion_.x);
        if (summary.converged) {
            motion_.f = quasi_static_->forces();
            motion_.time = time;
        }
    } else {
        begin_rates(time - motion_.time);
        summary = implicit_->step(time - motion_.time, moved, motion_);
        if (summary.converged) {
            motion_.time = time;
            accept_rates();
        }
    }
    return summary;
}

StepSummary Simulation::begin() {
    StepSummary summary;
    if (scene_.time.scheme != Scheme::quasi_static) {
        apply(0, motion_.x);
        make_solver();
        motion_ = implicit_->start(motion_.x, motion_.v);
        settle_rates();
        summary.converged = true;
        return summary;
    }
    const dynamics::EquilibriumSummary step = step_to(0);
    summary.converged = step.converged;
    summary.stopped = step.stopped;
    summary.iterations = step.iterations;
    summary.linear_iterations = step.linear_iterations;
    summary.factors = step.factors;
    if (!step.converged) summary.message = step.message + "; " + trouble();
    forget();
    return summary;
}

StepSummary Simulation::advance(double to) {
    StepSummary summary;
    const double whole = scene_.time.step, part_before = part_;
    const dynamics::Motion before = motion_;
    while (to - motion_.time > kSameTime * whole) {
        double next = std::min(to, motion_.time + part_ * whole);
        if (to - next < kSameTime * whole) next = to;
        const dynamics::EquilibriumSummary step = step_to(next);
        summary.iterations += step.iterations;
        summary.linear_iterations += step.linear_iterations;
        summary.factors += step.factors;
        if (step.converged) {
            ++summary.steps;
            // Forces that balance to the rounding of positions leave nothing to speak of.
            if (step.residual <= options_.equilibrium.tolerance)
                summary.residual = std::max(summary.residual, step.residual);
            if (step.iterations <= kEasy) part_ = std::min(1.0, 2 * part_);
            if (step.iterations > kHard) part_ = std::max(options_.least_part, 0.5 * part_);
            continue;
        }
        if (step.stopped) {
            summary.stopped = true;
            motion_ = before;
            part_ = part_before;
            return summary;
        }
        ++summary.failed_steps;
        part_ *= 0.5;
        if (part_ >= options_.least_part) continue;
        summary.message = "no equilibrium beyond " + rounded(motion_.time) + " s: " + step.message +
                          "; " + trouble();
        return summary;
    }
    summary.converged = true;
    forget();
    return summary;
}

// Where the bodies stand now, which is where the last attempt ended: the free nodes with
// most force left and, of the tetrahedra around them, those that are flattest.
std::string Simulation::trouble() const {
    std::vector<Vec3> left(model_.rest.size(), Vec3::Zero());
    for (const dynamics::Potential* potential : potentials_) potential->add_forces(left);
    for (const std::int32_t n : held_) left[n].setZero();
    struct Bad {
        double force = 0, J = 1;
        std::size_t body = 0, tet = 0;
    };
    std::vector<Bad> worst;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
        const BodyModel& body = model_.bodies[b];
        for (std::size_t t = 0; t < body.mesh.mesh.tets.size(); ++t) {
            double force = 0;
            for (const std::int32_t n : body.mesh.mesh.tets[t])
                force += left[body.first_node + n].norm();
            worst.push_back({std::isfinite(force) ? force : HUGE_VAL, 1, b, t});
        }
    }
    const std::size_t count = std::min(kNamed, worst.size());
    std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(count),
                      worst.end(), [](const Bad& a, const Bad& b) { return a.force > b.force; });
    std::string text = "forces balance least in";
    for (std::size_t i = 0; i < count; ++i) {
        const BodyModel& body = model_.bodies[worst[i].body];
        const Tet& tet = body.mesh.mesh.tets[worst[i].tet];
        Vec3 centre = Vec3::Zero();
        for (const std::int32_t n : tet) centre += 0.25 * model_.rest[body.first_node + n];
        // Points of linear elements and patches begin with the tetrahedra themselves.
        const bool quadratic = body.nodes != body.mesh.mesh.points.size();
        const std::size_t point = quadratic ? 4 * worst[i].tet : worst[i].tet;
        const double J = body.elastic->gradients()[point].determinant();
        text += (i > 0 ? "," : "") +
                formatted(" tetrahedron %zu of %s at (%.0f, %.0f, %.0f) mm, J %.3g", worst[i].tet,
                          scene_.bodies[worst[i].body].name.c_str(), centre.x(), centre.y(),
                          centre.z(), J);
    }
    return text + "; try a shorter 'step', a finer mesh there or a stiffer matrix";
}

void Simulation::save(Checkpoint& checkpoint) const {
    checkpoint.time = motion_.time;
    checkpoint.reals["x"] = flat(motion_.x);
    checkpoint.reals["v"] = flat(motion_.v);
    checkpoint.reals["a"] = flat(motion_.a);
    checkpoint.reals["f"] = flat(motion_.f);
    checkpoint.reals["part"] = {part_};
    checkpoint.integers["factor_pays"] = {factor_pays_};
}

void Simulation::load(const Checkpoint& checkpoint) {
    const std::size_t length = 3 * model_.rest.size();
    motion_ = {vectors_of(checkpoint.reals_of("x", length)),
               vectors_of(checkpoint.reals_of("v", length)),
               vectors_of(checkpoint.reals_of("a", length)),
               vectors_of(checkpoint.reals_of("f", length)), checkpoint.time};
    part_ = checkpoint.reals_of("part", 1)[0];
    factor_pays_ = checkpoint.integers_of("factor_pays", 1)[0] != 0;
    quasi_static_.reset();
    implicit_.reset();
    make_contacts();
    // The bodies stand where they did.
    std::vector<Vec3> x = motion_.x;
    apply(motion_.time, x);
    for (dynamics::Potential* potential : potentials_) (void)potential->move_to(motion_.x);
    if (scene_.time.scheme == Scheme::quasi_static) return;
    settle_rates();
}

}  // namespace myotet::contraction
