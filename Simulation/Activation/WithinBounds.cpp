// SPDX-License-Identifier: Apache-2.0
#include "Activation/WithinBounds.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace myotet::activation {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

// Of the range, that a start keeps from bounds.
constexpr double kInside = 0.01;
// Barriers from the first to the last, for costs and ranges of size 1.
constexpr double kFirstBarrier = 1, kLastBarrier = 1e-11;
// The next barrier: at most so much of this one, or its power; and how near to the least of
// this one is enough, in parts of it [Nocedal 2006, sec. 19.3].
constexpr double kLower = 0.1, kPower = 1.5, kNear = 10;
// Of the slope that is sought at the end.
constexpr double kNearEnd = 0.1;
// Of the way to the nearest bound.
constexpr double kReach = 0.995;
// Multipliers of bounds keep to the barrier's own but for so large a factor.
constexpr double kFarMultiplier = 1e10;
// Of what the slope promises [Armijo 1966], and the shortest step.
constexpr double kEnough = 1e-4, kShortest = 1e-12;
// What makes a matrix positive, beside its largest stiffness: the first try, and how fast it
// grows and is forgotten.
constexpr double kFirstShift = 1e-10, kShiftGrows = 8, kShiftShrinks = 1.0 / 3;
constexpr double kLastShift = 1e4;
// Costs are known to so much of themselves, and what falls by less than the second does not.
constexpr double kRounding = 1e-14, kNoFall = 1e-17;

// Of the curvature, that is tried to count.
constexpr double kCurvature[] = {1, 0.9, 0.75, 0.5, 0.25, 0};

// A factor of what is positive, or made so.
class PositiveFactor {
public:
    // Of bend and curvature, of so much more on the diagonal, for unknowns that are not held;
    // false when nothing helps: some number is none.
    bool make(const Cost& now, const VectorXd& more, const std::vector<char>& held) {
        const double scale = std::max(now.bend.diagonal().cwiseAbs().maxCoeff(), 1e-300);
        const auto works = [&](double curvature, double shift) {
            factor_ = now.bend;
            if (curvature > 0 && now.curvature.rows() > 0) factor_.add(curvature, now.curvature);
            factor_.add_diagonal(more.array() + (shift + kSmallestShift) * scale);
            if (!held.empty()) factor_.hold(held);
            return factor_.factor();
        };
        for (const double curvature : kCurvature)
            if (works(curvature, 0)) return true;
        double shift = std::max(kFirstShift, kShiftShrinks * last_);
        for (; shift < kLastShift; shift *= kShiftGrows)
            if (works(0, shift)) {
                last_ = shift;
                return true;
            }
        return false;
    }
    [[nodiscard]] VectorXd solve(const VectorXd& right) const { return factor_.solve(right); }

private:
    // Keeps the factor from directions that cost nothing.
    static constexpr double kSmallestShift = 1e-15;
    BlockBand factor_;
    double last_ = 0;
};

class Search {
public:
    Search(const CostAt& cost, const VectorXd& lowest, const VectorXd& highest,
           const BoundsOptions& options, VectorXd& x)
        : cost_(cost), lowest_(lowest), highest_(highest), options_(options), x_(x) {}

    BoundsResult run() {
        come_near();
        end();
        return out_;
    }

private:
    void come_near() {
        const VectorXd inside = kInside * (highest_ - lowest_);
        x_ = x_.cwiseMax(lowest_ + inside).cwiseMin(highest_ - inside);
        barrier_ = kFirstBarrier;
        on_lowest_ = barrier_ / (x_ - lowest_).array();
        on_highest_ = barrier_ / (highest_ - x_).array();
        Cost now = cost_(x_, barrier_, true);
        for (; out_.iterations < options_.iterations; ++out_.iterations) {
            bool lowered = false;
            while (barrier_ > kLastBarrier && is_near(now)) {
                barrier_ =
                    std::max(kLastBarrier, std::min(kLower * barrier_, std::pow(barrier_, kPower)));
                now = cost_(x_, barrier_, true);
                lowered = true;
            }
            if (!lowered && barrier_ <= kLastBarrier && is_near(now)) break;
            if (!step_inside(now)) {
                if (barrier_ <= kLastBarrier) break;
                barrier_ = std::max(kLastBarrier, kLower * barrier_);
                now = cost_(x_, barrier_, true);
            }
        }
        // A bound whose multiplier is more than its distance holds.
        for (Index i = 0; i < x_.size(); ++i) {
            if (on_lowest_[i] > x_[i] - lowest_[i]) x_[i] = lowest_[i];
            if (on_highest_[i] > highest_[i] - x_[i]) x_[i] = highest_[i];
        }
    }

    [[nodiscard]] bool is_near(const Cost& now) const {
        return lack(now) <= std::max(kNear * barrier_, kNearEnd * options_.slope);
    }

    // Of the conditions that barriers relax.
    [[nodiscard]] double lack(const Cost& now) const {
        const ArrayXd slope = now.slope.array() - on_lowest_ + on_highest_;
        const ArrayXd low = (x_ - lowest_).array() * on_lowest_ - barrier_,
                      high = (highest_ - x_).array() * on_highest_ - barrier_;
        return std::max({slope.abs().maxCoeff(), low.abs().maxCoeff(), high.abs().maxCoeff()});
    }

    [[nodiscard]] double with_barriers(double value, const VectorXd& x) const {
        return value -
               barrier_ * ((x - lowest_).array().log().sum() + (highest_ - x).array().log().sum());
    }

    // False when no step leads down.
    bool step_inside(Cost& now) {
        const ArrayXd below = (x_ - lowest_).array(), above = (highest_ - x_).array();
        const VectorXd slope = now.slope.array() - barrier_ / below + barrier_ / above;
        if (!factor_.make(now, (on_lowest_ / below + on_highest_ / above).matrix(), {}))
            return false;
        const VectorXd d = factor_.solve(-slope);
        const ArrayXd d_low = barrier_ / below - on_lowest_ - on_lowest_ / below * d.array(),
                      d_high = barrier_ / above - on_highest_ + on_highest_ / above * d.array();
        double longest = 1, longest_dual = 1;
        const auto shorten = [](double& step, const ArrayXd& from, const ArrayXd& by) {
            for (Index i = 0; i < from.size(); ++i)
                if (by[i] < 0) step = std::min(step, -kReach * from[i] / by[i]);
        };
        shorten(longest, below, d.array());
        shorten(longest, above, -d.array());
        shorten(longest_dual, on_lowest_, d_low);
        shorten(longest_dual, on_highest_, d_high);
        const double value = with_barriers(now.value, x_), promised = slope.dot(d);
        const double rounding = kRounding * std::abs(value);
        if (!(-promised > kNoFall * std::abs(value))) return false;
        for (double step = longest; step > kShortest; step *= 0.5) {
            const VectorXd to = x_ + step * d;
            const double there = with_barriers(cost_(to, barrier_, false).value, to);
            if (!(there <= value + kEnough * step * promised + rounding)) continue;
            x_ = to;
            now = cost_(x_, barrier_, true);
            move_multipliers(d_low, d_high, longest_dual);
            return true;
        }
        return false;
    }

    void move_multipliers(const ArrayXd& d_low, const ArrayXd& d_high, double step) {
        const auto keep = [this](ArrayXd& on, const ArrayXd& distance) {
            const ArrayXd own = barrier_ / distance;
            on = on.max(own / kFarMultiplier).min(own * kFarMultiplier);
        };
        on_lowest_ += step * d_low;
        on_highest_ += step * d_high;
        keep(on_lowest_, (x_ - lowest_).array());
        keep(on_highest_, (highest_ - x_).array());
    }

    // First the least of the unknowns that no bound holds, then of the held ones that which most
    // wants away from its bound joins them, and so on.
    void end() {
        for (Index i = 0; i < x_.size(); ++i) held_.push_back(at_bound(i, -1) || at_bound(i, 1));
        for (;; ++out_.iterations) {
            const Cost now = cost_(x_, 0, true);
            VectorXd slope = now.slope;
            Index worst = -1;
            double of_free = 0, of_held = 0;
            for (Index i = 0; i < x_.size(); ++i) {
                if (!held_[static_cast<std::size_t>(i)]) {
                    of_free = std::max(of_free, std::abs(slope[i]));
                    continue;
                }
                if (!at_bound(i, -slope[i]) && std::abs(slope[i]) > of_held) {
                    of_held = std::abs(slope[i]);
                    worst = i;
                }
                slope[i] = 0;
            }
            out_.cost = now.value;
            out_.slope = std::max(of_free, of_held);
            if (out_.slope <= options_.slope || out_.iterations >= options_.iterations) return;
            if (of_free <= options_.slope) {
                held_[static_cast<std::size_t>(worst)] = 0;
                slope[worst] = now.slope[worst];
            }
            if (!step_of_free(now, slope)) return;
        }
    }

    // Whether an unknown stands at the bound towards which it would go.
    [[nodiscard]] bool at_bound(Index i, double direction) const {
        return direction < 0 ? x_[i] <= lowest_[i] : direction > 0 && x_[i] >= highest_[i];
    }

    // Unknowns that Newton's step would take beyond the bound where they stand are held, lest
    // its path ends where it begins.
    bool step_of_free(const Cost& now, VectorXd& slope) {
        for (;;) {
            if (!factor_.make(now, VectorXd::Zero(x_.size()), held_)) return false;
            const VectorXd d = factor_.solve(-slope);
            bool stays = true;
            for (Index i = 0; i < x_.size(); ++i) {
                if (held_[static_cast<std::size_t>(i)] || !at_bound(i, d[i])) continue;
                held_[static_cast<std::size_t>(i)] = 1;
                slope[i] = 0;
                stays = false;
            }
            if (stays) return step_along(now, d);
        }
    }

    // Along the path that is bent at bounds.
    bool step_along(const Cost& now, const VectorXd& d) {
        for (double step = 1; step > kShortest; step *= 0.5) {
            const VectorXd to = (x_ + step * d).cwiseMax(lowest_).cwiseMin(highest_);
            const double promised = now.slope.dot(to - x_);
            if (!(promised < 0)) continue;
            if (!(cost_(to, 0, false).value <=
                  now.value + kEnough * promised + kRounding * std::abs(now.value)))
                continue;
            x_ = to;
            for (Index i = 0; i < x_.size(); ++i)
                if (at_bound(i, d[i])) held_[static_cast<std::size_t>(i)] = 1;
            return true;
        }
        return false;
    }

    const CostAt& cost_;
    const VectorXd &lowest_, &highest_;
    const BoundsOptions& options_;
    VectorXd& x_;
    BoundsResult out_;
    double barrier_ = 0;
    ArrayXd on_lowest_, on_highest_;  // multipliers
    std::vector<char> held_;
    PositiveFactor factor_;
};

}  // namespace

BoundsResult least_within_bounds(const CostAt& cost, const VectorXd& lowest,
                                 const VectorXd& highest, const BoundsOptions& options,
                                 VectorXd& x) {
    return Search(cost, lowest, highest, options, x).run();
}

}  // namespace myotet::activation
