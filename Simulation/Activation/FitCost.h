// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Activation/FitTerms.h"
#include "Activation/WithinBounds.h"

namespace myotet::activation {

/// Excitation is looked at so often in an interval.
inline constexpr int kExcitationLooks = 4;

/// The cost of fit_curves by the coefficients of curves, spline by spline: what a place in
/// time costs depends on four of them, so that second derivatives, which are exact, lie in a
/// band. Targets and options must outlive it.
class FitCost {
public:
    FitCost(const FitTargets& targets, const FitOptions& options, const SplineBasis& basis);
    /// See CostAt: hinges are those of excitation. Cost: O(times muscles^2).
    [[nodiscard]] Cost at(const Eigen::VectorXd& x, double barrier, bool with_derivatives) const;

private:
    const FitTargets& targets_;
    const FitOptions& options_;
    SplineBasis basis_;
    Eigen::Index muscles_;
    std::vector<TargetTerm> terms_;
};

}  // namespace myotet::activation
