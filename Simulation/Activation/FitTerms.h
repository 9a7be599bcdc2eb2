// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "Activation/FitCurves.h"

namespace myotet::activation {

/// Residuals at a time and their derivatives by the activations there.
struct TermValues {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd by_activation;  ///< (residual, muscle)
    /// A muscle: residuals times their second derivatives by its activation, summed.
    Eigen::VectorXd curvature;
};

/// Of what is asked at a time of the targets: torques, forces, measured activations, effort.
class TargetTerm {
public:
    TargetTerm(const FitTargets& targets, const FitOptions& options, std::size_t time);
    [[nodiscard]] int residuals() const { return residuals_; }
    [[nodiscard]] TermValues evaluate(const Eigen::VectorXd& activations) const;

private:
    [[nodiscard]] Pull pull(std::size_t muscle, double activation) const;
    const FitTargets& targets_;
    const FitOptions& options_;
    std::size_t time_;
    const Demand& demand_;
    double share_;                                 ///< root of this time's part of a mean
    std::vector<std::size_t> pulling_, measured_;  ///< muscles whose force or activation is known
    int residuals_ = 0;
};

/// Excitation that an activation and its rate imply, and its derivatives by them.
struct Excitation {
    double value, by_activation, by_rate;
    double by_activation_twice, by_both;  ///< by the rate twice it is 0
};
[[nodiscard]] Excitation implied_excitation(const muscle::ActivationDynamics& dynamics,
                                            double activation, double rate);
/// By the law of a muscle that rises, and of one that falls, whatever the sign of the rate.
/// Between activations of 0 and 1 what is more than 1 by the first is so, and what is less
/// than 0 by the second: limits by these are smooth where the rate changes its sign.
[[nodiscard]] Excitation rising(const muscle::ActivationDynamics& dynamics, double activation,
                                double rate);
[[nodiscard]] Excitation falling(const muscle::ActivationDynamics& dynamics, double activation,
                                 double rate);

/// 1/2 max(w, 0)^2 and its derivatives, rounded: the least over s of
/// 1/2 s^2 - round^2 ln(s - w), a constant apart.
struct Hinge {
    double value, slope, bend;
};
[[nodiscard]] Hinge hinge(double w, double round);

}  // namespace myotet::activation
