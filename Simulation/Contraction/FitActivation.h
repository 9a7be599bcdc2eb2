// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Activation/FitExpensive.h"
#include "Activation/SplineBasis.h"
#include "Contraction/Trial.h"
#include "Skeleton/Table.h"

namespace myotet::contraction {

struct ActivationFitOptions {
    int intervals = 0;     ///< of the spline; 0: one each 0.2 s, at most 5
    int evaluations = 40;  ///< runs of the scene, at most
    double goal = 0.01;    ///< ends where the misfit is this part of the target's most
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// A quantity of the history that shall come to a target.
struct FittedQuantity {
    std::string name;
    double most = 0;    ///< of the target's size
    double misfit = 0;  ///< root mean square, in the quantity's unit
};

/// The activation with which a scene comes nearest to a target.
struct ActivationFit {
    activation::ExpensiveFit fit;   ///< residuals in parts of goal x most
    activation::SplineBasis basis;  ///< whose coefficients were sought
    Curve activation;               ///< each 10 ms
    History history;                ///< of the best run
    std::vector<FittedQuantity> quantities;
};

/// Seeks the activation of a body, whatever the scene says of it, with which columns of the
/// history come nearest to those of a table of the same names: a cubic B-spline in time with
/// coefficients from 0 to 1, least squares, by activation::fit_expensive. It begins with the
/// activation that the scene has. The scene is left with the last activation that was tried.
/// Each evaluation is a run of the scene; one for each coefficient finds the first
/// derivatives. Throws InputError when a column is no quantity of the history or nothing but
/// zeros, or times leave the scene's; Interrupted.
[[nodiscard]] ActivationFit fit_activation(Scene& scene, Model& model, std::size_t body,
                                           const skeleton::Table& target,
                                           const ActivationFitOptions& options,
                                           ProgressSink& progress);

}  // namespace myotet::contraction
