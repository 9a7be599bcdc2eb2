// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "Activation/Demand.h"

namespace myotet {
class ProgressSink;
}

namespace myotet::activation {

/// What a simulation says of a set of coefficients.
struct Evaluation {
    /// Always as many, in units of usual errors: one of that size is 1. Empty: the simulation
    /// failed there, and `message` says how.
    std::vector<double> residuals;
    /// (residual, coefficient) derivatives, where the simulation knows them; empty: it does not.
    Eigen::MatrixXd sensitivities;
    std::string message;
};
using Evaluate = std::function<Evaluation(const std::vector<double>& coefficients)>;

/// How few coefficients of a simulation that takes seconds or minutes are fitted.
struct ExpensiveOptions {
    std::vector<double> lowest, highest;  ///< a coefficient
    /// A coefficient: for differences, and about how far one may change at first; empty: 0.05
    /// of the range between its bounds.
    std::vector<double> steps;
    int evaluations = 40;  ///< at most, those for differences included
    double goal = 0;       ///< ends when the root mean square of residuals is no more
    /// Ends when the model promises to lessen the sum of squares by less than this part.
    double tolerance = 1e-4;
    /// Ends when no coefficient would change by more than this part of its step.
    double least_step = 1e-3;

    /// Throws InputError naming the field, its value and the rule.
    void validate(std::size_t coefficients) const;
};

struct ExpensiveFit {
    Status status = Status::not_converged;
    std::string message = "not run";
    std::vector<double> coefficients;  ///< the best that were evaluated
    std::vector<double> residuals;     ///< there
    Eigen::MatrixXd sensitivities;     ///< as known at the end
    double first_rms = 0, rms = 0;
    int evaluations = 0, failures = 0;
    std::vector<double> history;  ///< best rms after each evaluation; NaN when the first failed
};

/// The least sum of squared residuals of a simulation within bounds, with few evaluations:
/// Levenberg and Marquardt's method [Nocedal and Wright 2006, sec. 10.3] whose derivatives are
/// found once, by forward differences or from the simulation, and then learn from each
/// evaluation by Broyden's rank-one formula [Broyden 1965]; found anew where steps fail with
/// learned ones. A failed simulation shortens the step. Evaluations come one after another, the
/// same each time the simulation is. Tells progress and a sentence an evaluation. The first
/// evaluation, at `start`, must succeed: if not the status is infeasible. Throws InputError
/// when an option breaks its rule or residuals change their number, Interrupted when the user
/// asks to stop.
[[nodiscard]] ExpensiveFit fit_expensive(const Evaluate& evaluate, const std::vector<double>& start,
                                         const ExpensiveOptions& options, ProgressSink& progress);

}  // namespace myotet::activation
