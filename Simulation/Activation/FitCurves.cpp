// SPDX-License-Identifier: Apache-2.0
#include "Activation/FitCurves.h"

#include <ceres/cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "Activation/FitTerms.h"
#include "Activation/ProjectedNewton.h"
#include "Activation/Require.h"

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Excitation is looked at so often in an interval.
constexpr int kLooks = 4;
// Gauss's points of an interval, exact for the square of a bend, which is straight there.
constexpr double kGauss[] = {0.5 - 0.28867513459481287, 0.5 + 0.28867513459481287};
// Nearer to a bound than this is at it.
constexpr double kAtBound = 1e-9;
// Of the slope at the end, beside the first cost; sought is a tenth.
constexpr double kSlope = 1e-6;
// Of the trust region, before projected steps end it.
constexpr int kFirstIterations = 20;

// A term at a time as a function of the four columns of coefficients that matter there.
class LocalCost final : public ceres::CostFunction {
public:
    using Evaluation = std::function<TermValues(const VectorXd& value, const VectorXd& rate,
                                                const VectorXd& bend)>;

    LocalCost(const SplineBasis::Local& local, int muscles, int residuals, Evaluation evaluate)
        : local_(local), muscles_(muscles), evaluate_(std::move(evaluate)) {
        set_num_residuals(residuals);
        mutable_parameter_block_sizes()->assign(4, muscles);
    }

    bool Evaluate(double const* const* columns, double* residuals,
                  double** jacobians) const override {
        VectorXd value = VectorXd::Zero(muscles_), rate = value, bend = value;
        for (std::size_t j = 0; j < 4; ++j) {
            const Eigen::Map<const VectorXd> column(columns[j], muscles_);
            value += local_.value[j] * column;
            rate += local_.slope[j] * column;
            bend += local_.bend[j] * column;
        }
        const TermValues now = evaluate_(value, rate, bend);
        Eigen::Map<VectorXd>(residuals, num_residuals()) = now.residuals;
        for (std::size_t j = 0; jacobians != nullptr && j < 4; ++j) {
            if (jacobians[j] == nullptr) continue;
            using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
            Eigen::Map<RowMajor> jacobian(jacobians[j], num_residuals(), muscles_);
            jacobian.setZero();
            if (now.by_activation.size() > 0) jacobian += local_.value[j] * now.by_activation;
            if (now.by_rate.size() > 0) jacobian += local_.slope[j] * now.by_rate;
            if (now.by_bend.size() > 0) jacobian += local_.bend[j] * now.by_bend;
        }
        return now.residuals.allFinite();
    }

private:
    SplineBasis::Local local_;
    int muscles_;
    Evaluation evaluate_;
};

struct Bounds {
    VectorXd lowest, highest;  ///< a muscle

    [[nodiscard]] bool low(Index i, double c) const { return c <= lowest[i] + kAtBound; }
    [[nodiscard]] bool high(Index i, double c) const { return c >= highest[i] - kAtBound; }
};

// All terms over the coefficients of some curves, which must outlive it.
class Fit {
public:
    Fit(const FitTargets& targets, const FitOptions& options, ActivationCurves& curves)
        : options_(options),
          curves_(curves),
          muscles_(static_cast<int>(curves.coefficients.rows())) {
        for (Index j = 0; j < curves.coefficients.cols(); ++j)
            problem_.AddParameterBlock(curves.coefficients.col(j).data(), muscles_);
        for (std::size_t k = 0; k < targets.times.size(); ++k) {
            const TargetTerm term(targets, options, k);
            add(targets.times[k], term.residuals(),
                [term](const VectorXd& a, const VectorXd&, const VectorXd&) {
                    return term.evaluate(a);
                });
        }
        add_limits();
    }

    void set_bounds(const Bounds& bounds) {
        for (Index j = 0; j < curves_.coefficients.cols(); ++j)
            for (int i = 0; i < muscles_; ++i) {
                double* column = curves_.coefficients.col(j).data();
                problem_.SetParameterLowerBound(column, i, bounds.lowest[i]);
                problem_.SetParameterUpperBound(column, i, bounds.highest[i]);
            }
    }

    // Levenberg and Marquardt's steps, cut off at the bounds, come near but crawl where many
    // bounds hold; projected ones of Newton's end it.
    void solve(const Bounds& bounds, FitSummary& out) {
        ceres::Solver::Options how;
        how.max_num_iterations = std::min(options_.iterations, kFirstIterations);
        how.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
        how.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
        how.logging_type = ceres::SILENT;
        how.num_threads = 1;
        // Almost linear: little damping, so that directions that hardly cost are found too.
        how.initial_trust_region_radius = 1e14;
        how.max_trust_region_radius = 1e20;
        how.function_tolerance = 1e-3;
        ceres::Solver::Summary summary;
        ceres::Solve(how, &problem_, &summary);
        out.first_cost = summary.initial_cost;
        const Index columns = curves_.coefficients.cols();
        VectorXd x = curves_.coefficients.reshaped();
        const ProjectedResult end = least_within_bounds(
            [this](const VectorXd& at, bool with_derivatives) {
                return squares(at, with_derivatives);
            },
            bounds.lowest.replicate(columns, 1), bounds.highest.replicate(columns, 1),
            {.slope = 0.1 * kSlope, .iterations = options_.iterations}, x);
        curves_.coefficients.reshaped() = x;
        out.iterations = static_cast<int>(summary.iterations.size()) + end.iterations;
        out.cost = end.cost;
        out.slope = end.slope;
    }

    [[nodiscard]] FitValue value() {
        FitValue out;
        std::vector<double> slope;
        problem_.Evaluate({}, &out.cost, nullptr, &slope, nullptr);
        out.slope = Eigen::Map<const MatrixXd>(slope.data(), muscles_, curves_.coefficients.cols());
        return out;
    }

private:
    Squares squares(const VectorXd& x, bool with_derivatives) {
        curves_.coefficients.reshaped() = x;
        Squares out;
        if (!with_derivatives) {
            problem_.Evaluate({}, &out.cost, nullptr, nullptr, nullptr);
            return out;
        }
        std::vector<double> slope;
        ceres::CRSMatrix J;
        problem_.Evaluate({}, &out.cost, nullptr, &slope, &J);
        out.slope = Eigen::Map<const VectorXd>(slope.data(), x.size());
        out.jacobian = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
            J.num_rows, J.num_cols, static_cast<Index>(J.values.size()), J.rows.data(),
            J.cols.data(), J.values.data());
        return out;
    }

    void add(double time, int residuals, LocalCost::Evaluation evaluate) {
        const SplineBasis::Local local = curves_.basis.at(time);
        std::vector<double*> columns;
        for (int j = 0; j < 4; ++j)
            columns.push_back(curves_.coefficients.col(local.first + j).data());
        problem_.AddResidualBlock(new LocalCost(local, muscles_, residuals, std::move(evaluate)),
                                  nullptr, columns);
    }

    void add_limits() {
        const SplineBasis& basis = curves_.basis;
        const double bend_share = std::sqrt(0.5 / basis.intervals);
        const double look_share = std::sqrt(1.0 / (basis.intervals * kLooks));
        const FitOptions& options = options_;
        for (int interval = 0; interval < basis.intervals; ++interval) {
            for (const double u : kGauss)
                add(basis.begin + (interval + u) * basis.spacing(), muscles_,
                    [&options, bend_share](const VectorXd&, const VectorXd&, const VectorXd& bend) {
                        return bending(options, bend, bend_share);
                    });
            for (int look = 0; look < kLooks && !options.dynamics.empty(); ++look)
                add(basis.begin + (interval + (look + 0.5) / kLooks) * basis.spacing(), muscles_,
                    [&options, look_share](const VectorXd& a, const VectorXd& rate,
                                           const VectorXd&) {
                        return excitation_out(options, a, rate, look_share);
                    });
        }
    }

    const FitOptions& options_;
    ActivationCurves& curves_;
    int muscles_;
    ceres::Problem problem_;
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
    for (int look = 0; look <= basis.intervals * kLooks && !options.dynamics.empty(); ++look) {
        const double time = basis.begin + look * basis.spacing() / kLooks;
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
    out.curves.coefficients = start.replicate(1, out.curves.basis.count());
    Fit fit(targets, options, out.curves);
    fit.set_bounds(bounds);
    FitSummary& summary = out.summary;
    fit.solve(bounds, summary);
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
    ActivationCurves copy = curves;
    return Fit(targets, options, copy).value();
}

}  // namespace myotet::activation
