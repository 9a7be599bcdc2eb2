// SPDX-License-Identifier: Apache-2.0
#include "Activation/FitCost.h"

#include <array>
#include <cmath>
#include <utility>

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Gauss's points of an interval, exact for the square of a bend, which is straight there.
constexpr double kGauss[] = {0.5 - 0.28867513459481287, 0.5 + 0.28867513459481287};

using Shares = std::array<double, 4>;

// A cost that is being summed up.
class Sum {
    template <class Vector>
    [[nodiscard]] auto column(Vector& all, int spline) const {
        return all.segment(spline * muscles_, muscles_);
    }

public:
    Sum(const VectorXd& x, Index muscles, int splines, bool slopes)
        : with_derivatives(slopes), x_(x), muscles_(muscles) {
        if (!slopes) return;
        cost.slope = VectorXd::Zero(x.size());
        cost.bend = cost.curvature = BlockBand(splines, muscles, 3);
    }

    // What the coefficients of four splines make.
    [[nodiscard]] VectorXd of(int first, const Shares& shares) const {
        VectorXd sum = VectorXd::Zero(muscles_);
        for (int j = 0; j < 4; ++j)
            sum += shares[static_cast<std::size_t>(j)] * column(x_, first + j);
        return sum;
    }

    void add(int first, const Shares& p, const VectorXd& slope, const MatrixXd& bend,
             const VectorXd& curvature) {
        for (int j = 0; j < 4; ++j) {
            const double share = p[static_cast<std::size_t>(j)];
            column(cost.slope, first + j) += share * slope;
            for (int i = 0; i <= j; ++i) {
                const double both = share * p[static_cast<std::size_t>(i)];
                cost.bend.at(first + j, first + i) += both * bend;
                cost.curvature.at(first + j, first + i).diagonal() += both * curvature;
            }
        }
    }

    // Of what each muscle costs on its own by two numbers, made with shares p and q.
    struct Own {
        explicit Own(Index n)
            : by_p(VectorXd::Zero(n)), by_q(by_p), by_pp(by_p), by_pq(by_p), by_qq(by_p) {}
        VectorXd by_p, by_q, by_pp, by_pq, by_qq;
        VectorXd curvature_pp = by_p, curvature_pq = by_p;
    };
    void add(int first, const Shares& p, const Shares& q, const Own& own) {
        for (std::size_t j = 0; j < 4; ++j) {
            const int row = first + static_cast<int>(j);
            column(cost.slope, row) += p[j] * own.by_p + q[j] * own.by_q;
            for (std::size_t i = 0; i <= j; ++i) {
                const int column_of = first + static_cast<int>(i);
                const double pp = p[i] * p[j], pq = p[i] * q[j] + q[i] * p[j];
                cost.bend.at(row, column_of).diagonal() +=
                    pp * own.by_pp + pq * own.by_pq + q[i] * q[j] * own.by_qq;
                cost.curvature.at(row, column_of).diagonal() +=
                    pp * own.curvature_pp + pq * own.curvature_pq;
            }
        }
    }

    Cost cost;
    const bool with_derivatives;

private:
    const VectorXd& x_;
    Index muscles_;
};

void add_target(const TargetTerm& term, const SplineBasis::Local& local, Sum& sum) {
    const TermValues now = term.evaluate(sum.of(local.first, local.value));
    sum.cost.value += 0.5 * now.residuals.squaredNorm();
    if (!sum.with_derivatives) return;
    sum.add(local.first, local.value, now.by_activation.transpose() * now.residuals,
            now.by_activation.transpose() * now.by_activation, now.curvature);
}

void add_bending(double weight, const SplineBasis::Local& local, Sum& sum) {
    const VectorXd bend = sum.of(local.first, local.bend);
    sum.cost.value += 0.5 * weight * bend.squaredNorm();
    if (!sum.with_derivatives) return;
    Sum::Own own(bend.size());
    own.by_p = weight * bend;
    own.by_pp.setConstant(weight);
    sum.add(local.first, local.bend, local.bend, own);
}

// A hinge of an excitation or, where the sign is negative, of what it lacks.
double add_hinge(const Hinge& h, const Excitation& u, double sign, Index i, Sum::Own& own) {
    const double slope = sign * h.slope;
    own.by_p[i] += slope * u.by_activation;
    own.by_q[i] += slope * u.by_rate;
    own.by_pp[i] += h.bend * u.by_activation * u.by_activation;
    own.by_pq[i] += h.bend * u.by_activation * u.by_rate;
    own.by_qq[i] += h.bend * u.by_rate * u.by_rate;
    own.curvature_pp[i] += slope * u.by_activation_twice;
    own.curvature_pq[i] += slope * u.by_both;
    return h.value;
}

}  // namespace

FitCost::FitCost(const FitTargets& targets, const FitOptions& options, const SplineBasis& basis)
    : targets_(targets),
      options_(options),
      basis_(basis),
      muscles_(static_cast<Index>(targets.demands.front().muscles())) {
    for (std::size_t k = 0; k < targets.times.size(); ++k) terms_.emplace_back(targets, options, k);
}

Cost FitCost::at(const VectorXd& x, double barrier, bool with_derivatives) const {
    Sum sum(x, muscles_, basis_.count(), with_derivatives);
    for (std::size_t k = 0; k < terms_.size(); ++k)
        add_target(terms_[k], basis_.at(targets_.times[k]), sum);
    const auto place = [this](double interval) {
        return basis_.at(basis_.begin + interval * basis_.spacing());
    };
    for (int interval = 0; interval < basis_.intervals; ++interval)
        for (const double u : kGauss)
            add_bending(options_.smoothness / basis_.intervals, place(interval + u), sum);
    if (options_.dynamics.empty()) return std::move(sum.cost);

    const int looks = basis_.intervals * kExcitationLooks;
    const double weight = 1 / (looks * options_.excitation_error * options_.excitation_error);
    const double round = std::sqrt(barrier / weight);
    for (int look = 0; look < looks; ++look) {
        const SplineBasis::Local local = place((look + 0.5) / kExcitationLooks);
        const VectorXd a = sum.of(local.first, local.value),
                       rate = sum.of(local.first, local.slope);
        Sum::Own own(muscles_);
        for (Index i = 0; i < muscles_; ++i) {
            const auto& dynamics = options_.dynamics[static_cast<std::size_t>(i)];
            const Excitation low = falling(dynamics, a[i], rate[i]),
                             high = rising(dynamics, a[i], rate[i]);
            sum.cost.value += weight * (add_hinge(hinge(-low.value, round), low, -1, i, own) +
                                        add_hinge(hinge(high.value - 1, round), high, 1, i, own));
        }
        if (!with_derivatives) continue;
        for (VectorXd* part : {&own.by_p, &own.by_q, &own.by_pp, &own.by_pq, &own.by_qq,
                               &own.curvature_pp, &own.curvature_pq})
            *part *= weight;
        sum.add(local.first, local.value, local.slope, own);
    }
    return std::move(sum.cost);
}

}  // namespace myotet::activation
