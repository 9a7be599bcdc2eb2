// SPDX-License-Identifier: Apache-2.0
#include "Activation/FitCurves.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "Activation/FitCost.h"
#include "Activation/Require.h"
#include "Activation/WithinBounds.h"

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Nearer to a bound than this is at it.
constexpr double kAtBound = 1e-9;
// Of the slope at the end, beside the first cost; sought is a tenth.
constexpr double kSlope = 1e-6;
struct Bounds {
    VectorXd lowest, highest;  ///< a muscle

    [[nodiscard]] bool low(Index i, double c) const { return c <= lowest[i] + kAtBound; }
    [[nodiscard]] bool high(Index i, double c) const { return c >= highest[i] - kAtBound; }
};

SplineBasis basis_of(const FitTargets& targets, const FitOptions& options) {
    SplineBasis basis{.begin = targets.times.front(), .end = targets.times.back()};
    basis.intervals = options.intervals > 0
                          ? options.intervals
                          : std::max(1, static_cast<int>(std::ceil(
                                            (basis.end - basis.begin) / options.spacing - 1e-9)));
    basis.validate();
    return basis;
}

// Root of the mean square of what a span of residuals was in its own unit.
struct Mean {
    double sum = 0;
    int count = 0;
    void add(double x) {
        sum += x * x;
        ++count;
    }
    [[nodiscard]] double root() const { return count > 0 ? std::sqrt(sum / count) : 0; }
};

void measure(const FitTargets& targets, const FitOptions& options, const ActivationCurves& curves,
             FitSummary& out) {
    Mean torque, force, measured;
    for (std::size_t k = 0; k < targets.times.size(); ++k) {
        const Demand& demand = targets.demands[k];
        const std::vector<double> a = curves.activations(targets.times[k]);
        VectorXd pulls(static_cast<Index>(a.size()));
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double passive = demand.passive.empty() ? 0 : demand.passive[i];
            const double pull =
                targets.pull ? targets.pull(k, i, a[i]).force : passive + demand.gains[i] * a[i];
            pulls[static_cast<Index>(i)] = pull;
            if (!targets.forces.empty() && !std::isnan(targets.forces[k][i]))
                force.add(pull - targets.forces[k][i]);
            if (!demand.measured.empty() && !std::isnan(demand.measured[i]))
                measured.add(a[i] - demand.measured[i]);
        }
        const VectorXd made = demand.arms * pulls;
        for (std::size_t c = 0; c < demand.coordinates(); ++c)
            torque.add(made[static_cast<Index>(c)] - demand.torques[c]);
    }
    out.torque_rms = torque.root();
    out.force_rms = force.root();
    out.measured_rms = measured.root();
    const SplineBasis& basis = curves.basis;
    for (int look = 0; look <= basis.intervals * kExcitationLooks && !options.dynamics.empty();
         ++look) {
        const double time = basis.begin + look * basis.spacing() / kExcitationLooks;
        const std::vector<double> a = curves.activations(time), rates = curves.rates(time);
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double u = implied_excitation(options.dynamics[i], a[i], rates[i]).value;
            out.excitation_out = std::max({out.excitation_out, -u, u - 1});
        }
    }
}

}  // namespace

void FitTargets::validate() const {
    require(times.size() >= 2, "times.size()", static_cast<double>(times.size()),
            "there must be at least two");
    for (std::size_t k = 0; k < times.size(); ++k)
        require(std::isfinite(times[k]) && (k == 0 || times[k] > times[k - 1]),
                "times[" + std::to_string(k) + "]", times[k], "times must ascend");
    require(demands.size() == times.size(), "demands.size()", static_cast<double>(demands.size()),
            "there must be one a time");
    require(forces.empty() || forces.size() == times.size(), "forces.size()",
            static_cast<double>(forces.size()), "there must be one a time, or none");
    for (const Demand& demand : demands) {
        demand.validate();
        require(demand.muscles() == demands.front().muscles() && demand.muscles() > 0,
                "demands.muscles()", static_cast<double>(demand.muscles()),
                "it must be the same at all times, and not 0");
    }
    for (const std::vector<double>& row : forces)
        require_each(row, demands.front().muscles(), "forces", "it must be finite, or NaN: unknown",
                     [](double x) { return !std::isinf(x); });
}

void FitOptions::validate(std::size_t muscles) const {
    const auto positive = [](double x, const char* name) {
        require(x > 0 && std::isfinite(x), name, x, "it must be positive");
    };
    positive(spacing, "spacing");
    positive(torque_error, "torque_error");
    positive(force_error, "force_error");
    positive(measured_error, "measured_error");
    positive(excitation_error, "excitation_error");
    require(intervals >= 0, "intervals", intervals, "it must not be negative");
    require(iterations > 0, "iterations", iterations, "it must be positive");
    require(effort >= 0, "effort", effort, "it must not be negative");
    require(smoothness >= 0, "smoothness", smoothness, "it must not be negative");
    require(dynamics.empty() || dynamics.size() == muscles, "dynamics.size()",
            static_cast<double>(dynamics.size()), "it must be the number of muscles");
    for (const muscle::ActivationDynamics& of_muscle : dynamics) of_muscle.validate();
    const auto bound = [](double x) { return x >= 0 && x <= 1; };
    if (!lowest.empty()) require_each(lowest, muscles, "lowest", "it must be 0 to 1", bound);
    if (!highest.empty()) require_each(highest, muscles, "highest", "it must be 0 to 1", bound);
    for (std::size_t i = 0; i < muscles && !lowest.empty() && !highest.empty(); ++i)
        require(lowest[i] < highest[i], "lowest[" + std::to_string(i) + "]", lowest[i],
                "it must be less than highest");
}

CurveFit fit_curves(const FitTargets& targets, const FitOptions& options) {
    targets.validate();
    const std::size_t n = targets.demands.front().muscles();
    options.validate(n);
    const auto m = static_cast<Index>(n);
    const auto given = [m](const std::vector<double>& bound, double otherwise) -> VectorXd {
        if (bound.empty()) return VectorXd::Constant(m, otherwise);
        return Eigen::Map<const VectorXd>(bound.data(), m);
    };
    const Bounds bounds{given(options.lowest, 0), given(options.highest, 1)};
    CurveFit out;
    out.curves.basis = basis_of(targets, options);
    const VectorXd start = 0.9 * bounds.lowest + 0.1 * bounds.highest;
    const Index columns = out.curves.basis.count();
    out.curves.coefficients = start.replicate(1, columns);
    const FitCost fit(targets, options, out.curves.basis);
    FitSummary& summary = out.summary;
    VectorXd x = start.replicate(columns, 1);
    summary.first_cost = fit.at(x, 0, false).value;
    const BoundsResult end = least_within_bounds(
        [&fit](const VectorXd& at, double barrier, bool with_derivatives) {
            return fit.at(at, barrier, with_derivatives);
        },
        bounds.lowest.replicate(columns, 1), bounds.highest.replicate(columns, 1),
        {.slope = 0.1 * kSlope, .iterations = options.iterations}, x);
    out.curves.coefficients.reshaped() = x;
    summary.iterations = end.iterations;
    summary.cost = end.cost;
    summary.slope = end.slope;
    for (Index j = 0; j < out.curves.coefficients.cols(); ++j)
        for (Index i = 0; i < m; ++i) {
            const double c = out.curves.coefficients(i, j);
            summary.held_by_bounds =
                summary.held_by_bounds || bounds.low(i, c) || bounds.high(i, c);
        }
    measure(targets, options, out.curves, summary);
    const bool flat = summary.slope <= kSlope * std::max(1.0, summary.first_cost);
    summary.status = flat ? Status::converged : Status::not_converged;
    std::ostringstream text;
    if (flat)
        text << "converged";
    else
        text << "the cost still falls by " << summary.slope << " a coefficient after "
             << summary.iterations << " iterations";
    summary.message = text.str();
    return out;
}

FitValue fit_value(const FitTargets& targets, const FitOptions& options,
                   const ActivationCurves& curves) {
    targets.validate();
    options.validate(targets.demands.front().muscles());
    const Cost cost =
        FitCost(targets, options, curves.basis).at(curves.coefficients.reshaped(), 0, true);
    return {cost.value,
            cost.slope.reshaped(curves.coefficients.rows(), curves.coefficients.cols())};
}

}  // namespace myotet::activation
