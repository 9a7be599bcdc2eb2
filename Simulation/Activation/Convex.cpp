// SPDX-License-Identifier: Apache-2.0
#include "Activation/Convex.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace myotet::activation {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Complementarity at the start, beside costs of size 1.
constexpr double kFirstMu = 1;
// And at the end: where slack and multiplier both vanish they are its root, 1e-11.
constexpr double kLastMu = 1e-22;
// Of the way to the nearest bound.
constexpr double kReach = 0.995;
// Residuals beside which rounding is seen; steps below are none.
constexpr double kFloor = 1e-13, kSmallestStep = 1e-10;
// |z|^p with p < 2 bends without limit at z = 0; nearer its slope is straight.
constexpr double kKink = 1e-9;

// Nothing is the largest of none.
template <class Array>
double largest(const Array& x) {
    return x.size() > 0 ? x.maxCoeff() : 0;
}

struct Derivatives {
    ArrayXd slope, bend;
};
Derivatives derivatives(const ConvexProgram& p, const VectorXd& x) {
    const ArrayXd z = p.offset.array() + p.scale.array() * x.array();
    const ArrayXd size = z.abs().max(p.exponent < 2 ? kKink : 0.0);
    const ArrayXd power = p.cost.array() * p.exponent * size.pow(p.exponent - 2);
    const ArrayXd bend = (z.abs() < size).select(power, power * (p.exponent - 1));
    const ArrayXd scale = p.scale.array(), pull = 2 * p.pull.array();
    return {power * z * scale + pull * (x - p.towards).array(), bend * scale.square() + pull};
}

// All unknowns; lower and upper are slacks of bounds, more and less the parts of r, on_more and
// on_less price -+ multipliers, kept apart because they vanish beside it.
struct Point {
    VectorXd y, multipliers;
    ArrayXd lower, upper, on_lower, on_upper, more, less, on_more, on_less;

    void move(const Point& d, double step) {
        y += step * d.y;
        multipliers += step * d.multipliers;
        lower += step * d.lower;
        upper += step * d.upper;
        on_lower += step * d.on_lower;
        on_upper += step * d.on_upper;
        more += step * d.more;
        less += step * d.less;
        on_more += step * d.on_more;
        on_less += step * d.on_less;
    }
};

// What the conditions lack, complementarity apart.
struct Lack {
    VectorXd slope, balance;
    ArrayXd lower, upper;
};

class Solver {
public:
    Solver(const ConvexProgram& program, const ConvexOptions& options)
        : p_(program), options_(options), bounded_(program.highest.array().isFinite()) {
        start();
    }

    ConvexSolution run() {
        ConvexSolution out;
        for (; out.iterations < options_.iterations; ++out.iterations) {
            if (mean_complementarity() <= kLastMu && residual() <= options_.tolerance) break;
            if (!iterate()) break;
        }
        out.x = spread(now_.y);
        out.y = now_.y;
        out.missing = (now_.more - now_.less).matrix();
        out.multipliers = now_.multipliers;
        out.at_lowest = now_.on_lower.matrix();
        out.at_highest = now_.on_upper.matrix();
        out.outside = std::max(largest(p_.lowest - out.x), largest(out.x - p_.highest));
        out.residual = residual();
        out.converged = out.residual <= options_.tolerance;
        return out;
    }

private:
    [[nodiscard]] VectorXd spread(const VectorXd& y) const {
        return p_.diagonal ? y : VectorXd(p_.shares * y);
    }
    [[nodiscard]] VectorXd gather(const ArrayXd& x) const {
        return p_.diagonal ? VectorXd(x.matrix()) : VectorXd(p_.shares.transpose() * x.matrix());
    }
    // Zero where there is no upper bound.
    [[nodiscard]] ArrayXd if_bounded(const ArrayXd& x) const { return bounded_.select(x, 0.0); }

    void start() {
        const Index rows = p_.goal.size(), count = p_.lowest.size();
        const ArrayXd range =
            bounded_.select(p_.highest - p_.lowest, VectorXd::Ones(count)).array();
        if (p_.diagonal) {
            now_.y = p_.lowest + 0.5 * range.matrix();
        } else {
            const double most = largest(p_.shares.rowwise().sum());
            now_.y = VectorXd::Constant(p_.shares.cols(), 0.5 / std::max(most, 1.0));
        }
        const ArrayXd x = spread(now_.y).array();
        now_.lower = (x - p_.lowest.array()).max(0.1 * range);
        now_.upper =
            if_bounded((p_.highest.array() - x).max(0.1 * range)) + (!bounded_).cast<double>();
        const double mu = std::max(largest(p_.price), kFirstMu);
        now_.on_lower = mu / now_.lower;
        now_.on_upper = if_bounded(mu / now_.upper);
        now_.multipliers = VectorXd::Zero(rows);
        now_.more = now_.less = mu / p_.price.array();
        now_.on_more = now_.on_less = p_.price.array();
    }

    [[nodiscard]] Lack lack() const {
        const VectorXd x = spread(now_.y);
        const Derivatives f = derivatives(p_, x);
        return {gather(f.slope - now_.on_lower + now_.on_upper) -
                    p_.balance.transpose() * now_.multipliers,
                p_.balance * now_.y + (now_.more - now_.less).matrix() - p_.goal,
                x.array() - p_.lowest.array() - now_.lower,
                if_bounded(p_.highest.array() - x.array() - now_.upper)};
    }

    [[nodiscard]] double mean_complementarity() const {
        const double sum = (now_.lower * now_.on_lower).sum() + (now_.upper * now_.on_upper).sum() +
                           (now_.more * now_.on_more).sum() + (now_.less * now_.on_less).sum();
        const Index pairs = now_.lower.size() + bounded_.count() + 2 * now_.more.size();
        return pairs > 0 ? sum / static_cast<double>(pairs) : 0;
    }

    // Squared, of the conditions relaxed to mu.
    [[nodiscard]] double merit(double mu) const {
        const Lack l = lack();
        const ArrayXd upper = if_bounded(now_.upper * now_.on_upper - mu);
        return l.slope.squaredNorm() + l.balance.squaredNorm() + l.lower.matrix().squaredNorm() +
               l.upper.matrix().squaredNorm() + (now_.lower * now_.on_lower - mu).square().sum() +
               upper.square().sum() + (now_.more * now_.on_more - mu).square().sum() +
               (now_.less * now_.on_less - mu).square().sum();
    }

    [[nodiscard]] double largest_multiplier() const {
        return std::max(1.0, largest(now_.multipliers.cwiseAbs()));
    }

    // See ConvexSolution::residual.
    [[nodiscard]] double residual() const {
        const Lack l = lack();
        const double large = largest_multiplier();
        const ArrayXd price = p_.price.array();
        return std::max({largest(l.slope.cwiseAbs()) / large, largest(l.balance.cwiseAbs()),
                         largest(l.lower.abs()), largest(l.upper.abs()),
                         largest(now_.lower.min(now_.on_lower / large)),
                         largest(if_bounded(now_.upper.min(now_.on_upper / large))),
                         largest(now_.more.min(now_.on_more / price)),
                         largest(now_.less.min(now_.on_less / price))});
    }

    struct Factors {
        Derivatives f;
        ArrayXd inverse;              // of H when diagonal
        Eigen::LDLT<MatrixXd> whole;  // of H else
        MatrixXd solved;              // H^-1 balance^T
        Eigen::LDLT<MatrixXd> schur;
    };
    [[nodiscard]] Factors factor() const {
        Factors out{.f = derivatives(p_, spread(now_.y))};
        const ArrayXd D = out.f.bend + now_.on_lower / now_.lower + now_.on_upper / now_.upper;
        if (p_.diagonal) {
            out.inverse = 1 / D;
            out.solved = out.inverse.matrix().asDiagonal() * p_.balance.transpose();
        } else {
            out.whole.compute(p_.shares.transpose() * D.matrix().asDiagonal() * p_.shares);
            out.solved = out.whole.solve(p_.balance.transpose());
        }
        MatrixXd schur = p_.balance * out.solved;
        schur.diagonal() += (now_.more / now_.on_more + now_.less / now_.on_less).matrix();
        out.schur.compute(schur);
        return out;
    }

    // Newton's step towards complementarity mu.
    [[nodiscard]] Point newton(const Factors& factors, const Lack& l, double mu) const {
        const ArrayXd for_lower = mu / now_.lower - now_.on_lower;
        const ArrayXd for_upper = if_bounded(mu / now_.upper - now_.on_upper);
        const VectorXd right = -l.slope + gather(for_lower - now_.on_lower / now_.lower * l.lower -
                                                 for_upper + now_.on_upper / now_.upper * l.upper);
        const ArrayXd for_more = mu / now_.on_more - now_.more,
                      for_less = mu / now_.on_less - now_.less;
        const VectorXd free = factors.solved.transpose() * right;
        Point d;
        d.multipliers =
            factors.schur.solve(VectorXd(-l.balance - (for_more - for_less).matrix() - free));
        d.y = (p_.diagonal ? VectorXd((factors.inverse * right.array()).matrix())
                           : VectorXd(factors.whole.solve(right))) +
              factors.solved * d.multipliers;
        const ArrayXd dx = spread(d.y).array(), dm = d.multipliers.array();
        d.lower = dx + l.lower;
        d.upper = if_bounded(-dx + l.upper);
        d.on_lower = for_lower - now_.on_lower / now_.lower * d.lower;
        d.on_upper = if_bounded(for_upper - now_.on_upper / now_.upper * d.upper);
        d.more = for_more + now_.more / now_.on_more * dm;
        d.less = for_less - now_.less / now_.on_less * dm;
        d.on_more = -dm;
        d.on_less = dm;
        return d;
    }

    // How far all that must stay positive does, at most 1.
    [[nodiscard]] double longest(const Point& d, double reach) const {
        double step = 1;
        const auto shorten = [&](const ArrayXd& x, const ArrayXd& dx) {
            for (Index i = 0; i < x.size(); ++i)
                if (dx[i] < 0) step = std::min(step, -reach * x[i] / dx[i]);
        };
        shorten(now_.lower, d.lower);
        shorten(now_.upper, d.upper);
        shorten(now_.on_lower, d.on_lower);
        shorten(now_.on_upper, d.on_upper);
        shorten(now_.more, d.more);
        shorten(now_.less, d.less);
        shorten(now_.on_more, d.on_more);
        shorten(now_.on_less, d.on_less);
        return step;
    }

    // False when no step leads further.
    bool iterate() {
        const Factors factors = factor();
        const Lack l = lack();
        const double mu = mean_complementarity();
        const double ahead = longest(newton(factors, l, 0), 1);
        const double goal = std::max(std::pow(1 - ahead, 3) * mu, 1e-3 * kLastMu);
        const Point d = newton(factors, l, goal);
        const Point before = now_;
        const double merit_before = merit(goal);
        // Beside it nothing is seen but rounding.
        const double noise = std::pow(kFloor * largest_multiplier(), 2);
        double step = longest(d, kReach);
        for (; step > kSmallestStep; step *= 0.5) {
            now_ = before;
            now_.move(d, step);
            const double after = merit(goal);
            if (after <= std::max((1 - 0.02 * step) * merit_before, noise)) return true;
        }
        now_ = before;
        return false;
    }

    const ConvexProgram& p_;
    const ConvexOptions options_;
    const Eigen::Array<bool, Eigen::Dynamic, 1> bounded_;
    Point now_;
};

}  // namespace

ConvexSolution solve_convex(const ConvexProgram& program, const ConvexOptions& options) {
    return Solver(program, options).run();
}

}  // namespace myotet::activation
