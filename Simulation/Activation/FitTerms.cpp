// SPDX-License-Identifier: Apache-2.0
#include "Activation/FitTerms.h"

#include <cmath>

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Time constants scale with kIdle + kActive a, see muscle::ActivationDynamics.
constexpr double kIdle = 0.5, kActive = 1.5;

Index to_index(std::size_t i) { return static_cast<Index>(i); }

}  // namespace

TargetTerm::TargetTerm(const FitTargets& targets, const FitOptions& options, std::size_t time)
    : targets_(targets),
      options_(options),
      time_(time),
      demand_(targets.demands[time]),
      share_(1 / std::sqrt(static_cast<double>(targets.times.size()))) {
    for (std::size_t i = 0; i < demand_.muscles(); ++i) {
        if (!targets.forces.empty() && !std::isnan(targets.forces[time][i])) pulling_.push_back(i);
        if (!demand_.measured.empty() && !std::isnan(demand_.measured[i])) measured_.push_back(i);
    }
    residuals_ = static_cast<int>(demand_.coordinates() + pulling_.size() + measured_.size() +
                                  demand_.muscles());
}

Pull TargetTerm::pull(std::size_t muscle, double activation) const {
    if (targets_.pull) return targets_.pull(time_, muscle, activation);
    const double passive = demand_.passive.empty() ? 0 : demand_.passive[muscle];
    return {passive + demand_.gains[muscle] * activation, demand_.gains[muscle]};
}

TermValues TargetTerm::evaluate(const VectorXd& activations) const {
    const Index n = to_index(demand_.muscles()), m = to_index(demand_.coordinates());
    VectorXd forces(n), slopes(n), bends(n);
    for (Index i = 0; i < n; ++i) {
        const Pull now = pull(static_cast<std::size_t>(i), activations[i]);
        forces[i] = now.force;
        slopes[i] = now.slope;
        bends[i] = now.bend;
    }
    TermValues out{VectorXd::Zero(residuals_), MatrixXd::Zero(residuals_, n), {}};
    const double torque = share_ / options_.torque_error, force = share_ / options_.force_error;
    const VectorXd asked = Eigen::Map<const VectorXd>(demand_.torques.data(), m);
    out.residuals.head(m) = torque * (demand_.arms * forces - asked);
    out.by_activation.topRows(m) = torque * demand_.arms * slopes.asDiagonal();
    // By forces.
    VectorXd wrong = torque * demand_.arms.transpose() * out.residuals.head(m);
    Index row = m;
    for (const std::size_t i : pulling_) {
        out.residuals[row] = force * (forces[to_index(i)] - targets_.forces[time_][i]);
        wrong[to_index(i)] += force * out.residuals[row];
        out.by_activation(row++, to_index(i)) = force * slopes[to_index(i)];
    }
    out.curvature = wrong.cwiseProduct(bends);
    const double measured = share_ / options_.measured_error;
    for (const std::size_t i : measured_) {
        out.residuals[row] = measured * (activations[to_index(i)] - demand_.measured[i]);
        out.by_activation(row++, to_index(i)) = measured;
    }
    const double effort = share_ * std::sqrt(2 * options_.effort);
    out.residuals.tail(n) = effort * activations;
    out.by_activation.bottomRows(n).diagonal().setConstant(effort);
    return out;
}

Excitation rising(const muscle::ActivationDynamics& dynamics, double activation, double rate) {
    const double slowness = kIdle + kActive * activation, by = kActive * dynamics.rise;
    return {activation + dynamics.rise * slowness * rate, 1 + by * rate, dynamics.rise * slowness,
            0, by};
}

Excitation falling(const muscle::ActivationDynamics& dynamics, double activation, double rate) {
    const double slowness = kIdle + kActive * activation;
    const double fall = dynamics.fall / slowness, by = -kActive * fall / slowness;
    return {activation + fall * rate, 1 + by * rate, fall, -2 * kActive / slowness * by * rate, by};
}

Excitation implied_excitation(const muscle::ActivationDynamics& dynamics, double activation,
                              double rate) {
    return rate > 0 ? rising(dynamics, activation, rate) : falling(dynamics, activation, rate);
}

// The least is at s = (w + sqrt(w^2 + 4 round^2)) / 2, which is the slope too.
Hinge hinge(double w, double round) {
    if (round == 0) return w > 0 ? Hinge{0.5 * w * w, w, 1} : Hinge{0, 0, 0};
    const double root = std::hypot(w, 2 * round);
    const double slope = w > 0 ? 0.5 * (w + root) : 2 * round * round / (root - w);
    return {0.5 * w * slope + round * round * std::asinh(0.5 * w / round), slope, slope / root};
}

}  // namespace myotet::activation
