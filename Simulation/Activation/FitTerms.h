// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "Activation/FitCurves.h"

namespace myotet::activation {

/// Residuals of a place in time and their derivatives by what they depend on there.
struct TermValues {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd by_activation, by_rate, by_bend;  ///< (residual, muscle); empty: none
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

/// Bending and excitation at a time; `share` the root of its part of a mean.
[[nodiscard]] TermValues bending(const FitOptions& options, const Eigen::VectorXd& bends,
                                 double share);
[[nodiscard]] TermValues excitation_out(const FitOptions& options,
                                        const Eigen::VectorXd& activations,
                                        const Eigen::VectorXd& rates, double share);

/// Excitation that an activation and its rate imply, and its derivatives by them.
struct Excitation {
    double value, by_activation, by_rate;
};
[[nodiscard]] Excitation implied_excitation(const muscle::ActivationDynamics& dynamics,
                                            double activation, double rate);

}  // namespace myotet::activation
