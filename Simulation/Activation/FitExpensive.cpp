// SPDX-License-Identifier: Apache-2.0
#include "Activation/FitExpensive.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "Activation/Require.h"
#include "Core/Progress.h"

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the damping after a step that failed, and after one that did well.
constexpr double kMore = 4, kLess = 0.2;
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-12, kMostDamping = 1e12;
// Of the decrease that the model promised: less has failed, more has done well.
constexpr double kPoor = 1e-3, kWell = 0.7;
// Attempts to shorten a step before the next evaluation.
constexpr int kAttempts = 60;

double rms(const VectorXd& residuals) {
    return residuals.size() > 0
               ? residuals.norm() / std::sqrt(static_cast<double>(residuals.size()))
               : 0;
}

// Unknowns are x = (coefficient - lowest) / step, so that they are of one size.
class Search {
public:
    Search(const Evaluate& evaluate, const ExpensiveOptions& options, ProgressSink& progress)
        : evaluate_(evaluate), options_(options), progress_(progress) {
        const auto n = static_cast<Index>(options.lowest.size());
        const VectorXd lowest = Eigen::Map<const VectorXd>(options.lowest.data(), n);
        const VectorXd highest = Eigen::Map<const VectorXd>(options.highest.data(), n);
        low_ = lowest;
        step_ = options.steps.empty()
                    ? VectorXd(0.05 * (highest - lowest))
                    : VectorXd(Eigen::Map<const VectorXd>(options.steps.data(), n));
        top_ = (highest - lowest).cwiseQuotient(step_);
    }

    ExpensiveFit run(const std::vector<double>& start) {
        x_ = (Eigen::Map<const VectorXd>(start.data(), low_.size()) - low_).cwiseQuotient(step_);
        x_ = x_.cwiseMax(0).cwiseMin(top_);
        const std::optional<VectorXd> first = at(x_, true);
        if (!first) {
            out_.status = Status::infeasible;
            out_.message = "the simulation fails at the start: " + failure_;
            return finish();
        }
        r_ = *first;
        out_.first_rms = out_.history.back() = rms(r_);
        while (!ended()) {
            if (!known_ && !find_derivatives()) break;
            if (!step()) break;
        }
        return finish();
    }

private:
    // The simulation's residuals; best results are noted by the caller. keep: its sensitivities
    // are those of the place where the search is.
    std::optional<VectorXd> at(const VectorXd& x, bool keep) {
        progress_.check();
        const VectorXd c = low_ + step_.cwiseProduct(x);
        const Evaluation now = evaluate_({c.data(), c.data() + c.size()});
        ++out_.evaluations;
        const auto size = static_cast<Index>(now.residuals.size());
        const VectorXd residuals = Eigen::Map<const VectorXd>(now.residuals.data(), size);
        if (size == 0 || !residuals.allFinite()) {
            ++out_.failures;
            failure_ = now.message.empty() ? "no residuals" : now.message;
            tell("failed: " + failure_);
            return {};
        }
        require(r_.size() == 0 || size == r_.size(), "residuals.size()", static_cast<double>(size),
                "it must be the same at each evaluation, " + std::to_string(r_.size()));
        sensitivities_ = now.sensitivities;
        if (sensitivities_.size() > 0)
            require(sensitivities_.rows() == size && sensitivities_.cols() == x.size() &&
                        sensitivities_.allFinite(),
                    "sensitivities.size()", static_cast<double>(sensitivities_.size()),
                    "it must be finite, a row a residual and a column a coefficient");
        if (keep) adopt();
        std::ostringstream text;
        text << "root mean square " << rms(residuals);
        tell(text.str());
        return residuals;
    }

    void adopt() {
        if (sensitivities_.size() == 0) return;
        J_ = sensitivities_ * step_.asDiagonal();
        known_ = fresh_ = true;
    }

    void tell(const std::string& what) {
        progress_.note("evaluation " + std::to_string(out_.evaluations) + ": " + what);
        progress_.report(
            "fit", std::min(1.0, static_cast<double>(out_.evaluations) / options_.evaluations));
        out_.history.push_back(r_.size() > 0 ? rms(r_) : std::numeric_limits<double>::quiet_NaN());
    }

    [[nodiscard]] bool ended() {
        if (rms(r_) <= options_.goal) {
            out_.status = Status::converged;
            out_.message = "the goal is reached";
        } else if (out_.evaluations >= options_.evaluations) {
            out_.message = "ended after " + std::to_string(out_.evaluations) + " evaluations";
        } else {
            return false;
        }
        return true;
    }

    // Forward differences, or backward where a bound is near. False when evaluations run out or
    // the simulation fails on both sides.
    bool find_derivatives() {
        J_ = MatrixXd::Zero(r_.size(), x_.size());
        for (Index i = 0; i < x_.size(); ++i) {
            double to = x_[i] + 1 <= top_[i] ? 1 : -std::min(1.0, x_[i]);
            if (to == 0) to = top_[i] - x_[i];
            std::optional<VectorXd> there;
            for (int attempt = 0; attempt < 2 && !there; ++attempt, to *= -0.5) {
                if (out_.evaluations >= options_.evaluations) {
                    out_.message = "ended after " + std::to_string(out_.evaluations) +
                                   " evaluations, while derivatives were sought";
                    return false;
                }
                VectorXd x = x_;
                x[i] = std::clamp(x_[i] + to, 0.0, top_[i]);
                if (x[i] == x_[i]) continue;
                there = at(x, false);
                if (there) J_.col(i) = (*there - r_) / (x[i] - x_[i]);
            }
            if (!there) {
                out_.message = "the simulation fails on both sides of coefficient " +
                               std::to_string(i) + ": " + failure_;
                return false;
            }
        }
        known_ = fresh_ = true;
        return true;
    }

    // Of the model within the bounds: coefficients at bounds that the slope pushes outwards stay,
    // the rest is a damped step of Gauss and Newton's, cut off at the bounds.
    [[nodiscard]] VectorXd propose() const {
        const VectorXd slope = J_.transpose() * r_;
        std::vector<Index> free;
        for (Index i = 0; i < x_.size(); ++i)
            if (!((x_[i] <= 0 && slope[i] > 0) || (x_[i] >= top_[i] && slope[i] < 0)))
                free.push_back(i);
        VectorXd x = x_;
        while (!free.empty()) {
            const MatrixXd J = J_(Eigen::all, free);
            MatrixXd H = J.transpose() * J;
            const double size = std::max(H.diagonal().maxCoeff(), 1e-300);
            H.diagonal().array() += damping_ * size;
            // Those already cut off shift the right side.
            const VectorXd right = -J.transpose() * (r_ + J_ * (x - x_));
            const VectorXd d = H.ldlt().solve(right);
            std::vector<Index> inside;
            for (std::size_t k = 0; k < free.size(); ++k) {
                const Index i = free[k];
                const double to = x_[i] + d[static_cast<Index>(k)];
                x[i] = std::clamp(to, 0.0, top_[i]);
                if (to == x[i]) inside.push_back(i);
            }
            if (inside.size() == free.size()) break;
            for (const Index i : inside) x[i] = x_[i];
            free = inside;
        }
        return x;
    }

    void learn(const VectorXd& d, const VectorXd& change) {
        J_ += (change - J_ * d) * d.transpose() / d.squaredNorm();
        fresh_ = false;
    }

    // One evaluation further; false when the search ends.
    bool step() {
        VectorXd to;
        double promised = 0, longest = 0;
        for (int attempt = 0; attempt < kAttempts; ++attempt) {
            to = propose();
            longest = (to - x_).cwiseAbs().maxCoeff();
            promised = r_.squaredNorm() - (r_ + J_ * (to - x_)).squaredNorm();
            if (promised > 0 || longest == 0) break;
            damping_ *= kMore;
        }
        const bool little = promised <= options_.tolerance * r_.squaredNorm();
        if (little || longest <= options_.least_step) {
            if (!fresh_) {
                known_ = false;
                return true;
            }
            out_.status = Status::converged;
            out_.message = little ? "no step promises to lessen the residuals"
                                  : "steps are smaller than asked for";
            return false;
        }
        const std::optional<VectorXd> there = at(to, false);
        if (!there) {
            damping_ = std::min(damping_ * kMore * kMore, kMostDamping);
            // A failed simulation is far away: at most half as far next time.
            shorten(longest);
            return true;
        }
        judge(to, *there, promised);
        return true;
    }

    void shorten(double longest) {
        for (int attempt = 0; attempt < kAttempts; ++attempt) {
            if ((propose() - x_).cwiseAbs().maxCoeff() <= 0.5 * longest) return;
            damping_ *= kMore;
        }
    }

    void judge(const VectorXd& to, const VectorXd& there, double promised) {
        const double decrease = r_.squaredNorm() - there.squaredNorm();
        const VectorXd d = to - x_, change = there - r_;
        const bool was_fresh = fresh_;
        learn(d, change);
        if (decrease > kPoor * promised) {
            x_ = to;
            r_ = there;
            out_.history.back() = rms(r_);
            adopt();
            if (decrease > kWell * promised) damping_ = std::max(damping_ * kLess, kLeastDamping);
            return;
        }
        if (was_fresh) {
            damping_ = std::min(damping_ * kMore, kMostDamping);
            shorten(d.cwiseAbs().maxCoeff());
            // What was learned there is of a place that is left.
            fresh_ = sensitivities_.size() > 0;
        } else {
            known_ = false;
        }
    }

    ExpensiveFit finish() {
        const VectorXd c = low_ + step_.cwiseProduct(x_);
        out_.coefficients.assign(c.data(), c.data() + c.size());
        out_.residuals.assign(r_.data(), r_.data() + r_.size());
        if (J_.size() > 0) out_.sensitivities = J_ * step_.cwiseInverse().asDiagonal();
        out_.rms = rms(r_);
        return std::move(out_);
    }

    const Evaluate& evaluate_;
    const ExpensiveOptions& options_;
    ProgressSink& progress_;
    VectorXd low_, step_, top_, x_, r_;
    MatrixXd J_, sensitivities_;
    bool known_ = false, fresh_ = false;
    double damping_ = kFirstDamping;
    std::string failure_;
    ExpensiveFit out_;
};

}  // namespace

void ExpensiveOptions::validate(std::size_t coefficients) const {
    const auto finite = [](double x) { return std::isfinite(x); };
    require(coefficients > 0, "coefficients", 0, "there must be one to fit");
    require_each(lowest, coefficients, "lowest", "it must be finite", finite);
    require_each(highest, coefficients, "highest", "it must be finite", finite);
    for (std::size_t i = 0; i < coefficients; ++i)
        require(lowest[i] < highest[i], "lowest[" + std::to_string(i) + "]", lowest[i],
                "it must be less than highest");
    if (!steps.empty())
        require_each(steps, coefficients, "steps", "it must be positive",
                     [](double x) { return x > 0 && std::isfinite(x); });
    require(evaluations > 0, "evaluations", evaluations, "it must be positive");
    require(goal >= 0, "goal", goal, "it must not be negative");
    require(tolerance > 0, "tolerance", tolerance, "it must be positive");
    require(least_step > 0, "least_step", least_step, "it must be positive");
}

ExpensiveFit fit_expensive(const Evaluate& evaluate, const std::vector<double>& start,
                           const ExpensiveOptions& options, ProgressSink& progress) {
    options.validate(start.size());
    for (std::size_t i = 0; i < start.size(); ++i)
        require(start[i] >= options.lowest[i] && start[i] <= options.highest[i],
                "start[" + std::to_string(i) + "]", start[i], "it must lie within its bounds");
    return Search(evaluate, options, progress).run(start);
}

}  // namespace myotet::activation
