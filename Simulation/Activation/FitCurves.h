// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "Activation/Demand.h"
#include "Activation/Distribution.h"
#include "Activation/SplineBasis.h"
#include "Muscle/ActivationDynamics.h"

namespace myotet::activation {

/// What activation curves are fitted to.
struct FitTargets {
    std::vector<double> times;  ///< s, ascending
    /// One a time: torques, and how muscles make them; `measured` activations. Bounds of a
    /// demand are not used. Torques that do not matter: no coordinates.
    std::vector<Demand> demands;
    /// [time][muscle] measured pulls, N, NaN where there are none; empty: none anywhere.
    std::vector<std::vector<double>> forces;
    /// What a muscle pulls at a time of the list; none: in proportion, as the demands say.
    std::function<Pull(std::size_t time, std::size_t muscle, double activation)> pull;

    void validate() const;
};

/// How activation curves are fitted. Errors are those that are usual in each target: one of
/// that size counts 1/2.
struct FitOptions {
    double spacing = 0.05;         ///< of knots, s; about the time a muscle needs to relax
    int intervals = 0;             ///< between knots; 0: by spacing
    double torque_error = 100;     ///< N mm
    double force_error = 5;        ///< N
    double measured_error = 0.05;  ///< of activation
    double effort = 1e-3;      ///< weight of the mean of a^2: who pulls where nothing else tells
    double smoothness = 1e-9;  ///< weight of the mean of (d2a/dt2)^2, s^4
    /// Excitation outside 0 to 1 of this size counts 1/2.
    double excitation_error = 1e-3;
    std::vector<muscle::ActivationDynamics> dynamics;  ///< a muscle; empty: any rate may be
    std::vector<double> lowest, highest;               ///< a muscle; empty: 0 and 1
    int iterations = 200;                              ///< at most

    void validate(std::size_t muscles) const;
};

struct FitSummary {
    Status status = Status::not_converged;
    std::string message = "not run";
    int iterations = 0;
    double first_cost = 0, cost = 0;
    double slope = 0;             ///< largest d cost / d coefficient that no bound stops
    double torque_rms = 0;        ///< N mm
    double force_rms = 0;         ///< N
    double measured_rms = 0;      ///< of activation
    double excitation_out = 0;    ///< farthest that the implied excitation is outside 0 to 1
    bool held_by_bounds = false;  ///< some coefficient is at a bound
};

struct CurveFit {
    ActivationCurves curves;
    FitSummary summary;
};

/// Activations over a whole time, all at once: coefficients of cubic splines, within the
/// bounds and so their curves too, with the least sum of squares
///     1/2 mean |torque error|^2 + 1/2 mean |force error|^2 + 1/2 mean |measured error|^2
///         + effort mean a^2 + smoothness mean a''^2
///         + 1/2 mean |excitation outside 0 to 1|^2,
/// errors in parts of the usual ones, sums over coordinates or muscles, means over time. The
/// excitation u that a curve implies is that of muscle::ActivationDynamics,
///     a + rise (0.5 + 1.5 a) a'  or  a + fall a' / (0.5 + 1.5 a)  as a' is positive or not,
/// looked at four times an interval. By least_within_bounds, with exact first and second
/// derivatives: some 20 to 100 iterations of O(times muscles^2 + intervals muscles^3), most
/// where torques are faster than muscles. Limits of excitation are not convex, so that there
/// may be several least costs; where muscles nearly can, all starts tried lead to the same.
/// Same bytes each run.
/// Throws InputError.
[[nodiscard]] CurveFit fit_curves(const FitTargets& targets, const FitOptions& options);

/// The cost of given curves and its derivative by their coefficients.
struct FitValue {
    double cost = 0;
    Eigen::MatrixXd slope;  ///< (muscle, spline)
};
[[nodiscard]] FitValue fit_value(const FitTargets& targets, const FitOptions& options,
                                 const ActivationCurves& curves);

}  // namespace myotet::activation
