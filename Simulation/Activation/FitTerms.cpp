// SPDX-License-Identifier: Apache-2.0
#include "Activation/FitTerms.h"

#include <cmath>

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
    VectorXd forces(n), slopes(n);
    for (Index i = 0; i < n; ++i) {
        const Pull now = pull(static_cast<std::size_t>(i), activations[i]);
        forces[i] = now.force;
        slopes[i] = now.slope;
    }
    TermValues out{VectorXd::Zero(residuals_), MatrixXd::Zero(residuals_, n), {}, {}};
    const double torque = share_ / options_.torque_error, force = share_ / options_.force_error;
    const VectorXd asked = Eigen::Map<const VectorXd>(demand_.torques.data(), m);
    out.residuals.head(m) = torque * (demand_.arms * forces - asked);
    out.by_activation.topRows(m) = torque * demand_.arms * slopes.asDiagonal();
    Index row = m;
    for (const std::size_t i : pulling_) {
        out.residuals[row] = force * (forces[to_index(i)] - targets_.forces[time_][i]);
        out.by_activation(row++, to_index(i)) = force * slopes[to_index(i)];
    }
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

TermValues bending(const FitOptions& options, const VectorXd& bends, double share) {
    const double weight = share * std::sqrt(2 * options.smoothness);
    return {weight * bends, {}, {}, weight * MatrixXd::Identity(bends.size(), bends.size())};
}

Excitation implied_excitation(const muscle::ActivationDynamics& dynamics, double activation,
                              double rate) {
    const double slowness = 0.5 + 1.5 * activation;
    if (rate > 0)
        return {activation + dynamics.rise * slowness * rate, 1 + 1.5 * dynamics.rise * rate,
                dynamics.rise * slowness};
    const double fall = dynamics.fall / slowness;
    return {activation + fall * rate, 1 - 1.5 * fall / slowness * rate, fall};
}

TermValues excitation_out(const FitOptions& options, const VectorXd& activations,
                          const VectorXd& rates, double share) {
    const Index n = activations.size();
    const double weight = share / options.excitation_error;
    TermValues out{VectorXd::Zero(n), MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), {}};
    for (Index i = 0; i < n; ++i) {
        const Excitation u = implied_excitation(options.dynamics[static_cast<std::size_t>(i)],
                                                activations[i], rates[i]);
        if (u.value >= 0 && u.value <= 1) continue;
        out.residuals[i] = weight * (u.value < 0 ? u.value : u.value - 1);
        out.by_activation(i, i) = weight * u.by_activation;
        out.by_rate(i, i) = weight * u.by_rate;
    }
    return out;
}

}  // namespace myotet::activation
