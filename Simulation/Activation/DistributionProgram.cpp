// SPDX-License-Identifier: Apache-2.0
#include "Activation/DistributionProgram.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Activation/Convex.h"

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of missing torque in parts of a coordinate's capacity, beside the dearest muscle at its most:
// more than muscles ever cost that can do it at all, little enough for double precision.
constexpr double kForbidden = 1e6;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
Index to_index(std::size_t i) { return static_cast<Index>(i); }

// A muscle's part of the cost: weight |offset + scale a|^exponent.
struct Term {
    double weight, offset, scale;
};
Term term(const Demand& demand, const DistributionOptions& options, std::size_t i) {
    const double weight = options.weights.empty() ? 1 : options.weights[i];
    if (options.criterion == Criterion::activation) return {weight, 0, 1};
    const double passive = demand.passive.empty() ? 0 : demand.passive[i];
    return {weight, passive / options.areas[i], demand.gains[i] / options.areas[i]};
}

// Builds the program, and reads its solution.
class Builder {
public:
    Builder(const Demand& demand, const DistributionOptions& options)
        : demand_(demand),
          options_(options),
          kinds_(kinds_of_balance(options, demand.coordinates())),
          torques_(
              demand.arms *
              Eigen::Map<const VectorXd>(demand.gains.data(), demand.arms.cols()).asDiagonal()),
          asked_(Eigen::Map<const VectorXd>(demand.torques.data(), demand.arms.rows())) {
        const std::size_t n = demand.muscles();
        shares_.lowest.assign(n, 0);
        shares_.highest.assign(n, 1);
        if (!demand.lowest.empty()) shares_.lowest = demand.lowest;
        if (!demand.highest.empty()) shares_.highest = demand.highest;
        shares_.activations = shares_.lowest;
        if (!demand.passive.empty())
            asked_ -= demand.arms * Eigen::Map<const VectorXd>(demand.passive.data(), to_index(n));
        scale();
        for (std::size_t c = 0; c < kinds_.size(); ++c)
            if (kinds_[c] != Balance::held) rows_.push_back(to_index(c));
    }

    Shares solve() {
        const bool driven_by_synergies = options_.synergies.size() > 0;
        ConvexProgram program = driven_by_synergies ? by_synergies() : by_muscles();
        program.exponent = options_.exponent;
        const ConvexSolution found = solve_convex(
            program, {.tolerance = options_.tolerance, .iterations = options_.iterations});
        read(found);
        return std::move(shares_);
    }

private:
    void scale() {
        double dearest = 0;
        for (std::size_t i = 0; i < demand_.muscles(); ++i) {
            const Term t = term(demand_, options_, i);
            dearest = std::max(
                dearest, t.weight * std::pow(std::abs(t.offset + t.scale * shares_.highest[i]),
                                             options_.exponent));
        }
        if (dearest > 0) dearest_ = dearest;
        const VectorXd most = Eigen::Map<const VectorXd>(shares_.highest.data(), torques_.cols());
        const VectorXd capacity = (torques_.cwiseAbs() * most).cwiseMax(asked_.cwiseAbs());
        for (Index c = 0; c < capacity.size(); ++c)
            shares_.capacity.push_back(capacity[c] > 0 ? capacity[c] : 1);
    }

    [[nodiscard]] bool matters(std::size_t i) const {
        const Term t = term(demand_, options_, i);
        return t.scale != 0 || demand_.gains[i] != 0 || tracked(i);
    }
    [[nodiscard]] bool tracked(std::size_t i) const {
        return options_.tracking > 0 && !demand_.measured.empty() &&
               !std::isnan(demand_.measured[i]);
    }
    void set_cost(ConvexProgram& program, Index x, std::size_t muscle) const {
        const Term t = term(demand_, options_, muscle);
        program.cost[x] = t.weight / dearest_;
        program.offset[x] = t.offset;
        program.scale[x] = t.scale;
        if (!tracked(muscle)) return;
        program.pull[x] = options_.tracking;
        program.towards[x] = demand_.measured[muscle];
    }
    [[nodiscard]] static ConvexProgram sized(Index x, Index rows, Index y) {
        ConvexProgram p;
        for (VectorXd* v : {&p.cost, &p.offset, &p.scale, &p.pull, &p.towards, &p.lowest})
            *v = VectorXd::Zero(x);
        p.highest = VectorXd::Constant(x, kInfinity);
        p.balance = MatrixXd::Zero(rows, y);
        p.goal = VectorXd::Zero(rows);
        p.price = VectorXd::Constant(rows, kForbidden);
        return p;
    }
    void set_row(ConvexProgram& program, Index row, double goal) const {
        const std::size_t c = at(rows_[at(row)]);
        program.goal[row] = goal / shares_.capacity[c];
        if (kinds_[c] == Balance::helped)
            program.price[row] = std::min(
                kForbidden, options_.reserve_price * shares_.capacity[c] / options_.reserves[c]);
    }

    // Unknowns are the activations that are not given.
    ConvexProgram by_muscles() {
        VectorXd rest = asked_;
        for (std::size_t i = 0; i < demand_.muscles(); ++i) {
            if (shares_.lowest[i] < shares_.highest[i] && matters(i))
                free_.push_back(i);
            else
                rest -= torques_.col(to_index(i)) * shares_.lowest[i];
        }
        const Index n = to_index(free_.size()), m = to_index(rows_.size());
        ConvexProgram program = sized(n, m, n);
        program.diagonal = true;
        for (Index x = 0; x < n; ++x) {
            const std::size_t i = free_[at(x)];
            set_cost(program, x, i);
            program.lowest[x] = shares_.lowest[i];
            program.highest[x] = shares_.highest[i];
        }
        for (Index row = 0; row < m; ++row) {
            const Index c = rows_[at(row)];
            set_row(program, row, rest[c]);
            for (Index x = 0; x < n; ++x)
                program.balance(row, x) =
                    torques_(c, to_index(free_[at(x)])) / shares_.capacity[at(c)];
        }
        return program;
    }

    // Unknowns are the amounts of synergies; x are activations, then amounts. Activations that
    // are given are further rows to balance.
    ConvexProgram by_synergies() {
        std::vector<Index> given;
        const Index n = torques_.cols(), k = options_.synergies.cols(), m = to_index(rows_.size());
        for (Index i = 0; i < n; ++i)
            if (!(shares_.lowest[at(i)] < shares_.highest[at(i)])) given.push_back(i);
        ConvexProgram program = sized(n + k, m + to_index(given.size()), k);
        program.shares.resize(n + k, k);
        program.shares << options_.synergies, MatrixXd::Identity(k, k);
        for (Index i = 0; i < n; ++i) {
            set_cost(program, i, at(i));
            const bool is_given = !(shares_.lowest[at(i)] < shares_.highest[at(i)]);
            program.lowest[i] = is_given ? -1 : shares_.lowest[at(i)];
            if (!is_given) program.highest[i] = shares_.highest[at(i)];
        }
        for (Index row = 0; row < m; ++row) {
            const Index c = rows_[at(row)];
            set_row(program, row, asked_[c]);
            program.balance.row(row) =
                torques_.row(c) * options_.synergies / shares_.capacity[at(c)];
        }
        for (Index j = 0; j < to_index(given.size()); ++j) {
            program.balance.row(m + j) = options_.synergies.row(given[at(j)]);
            program.goal[m + j] = shares_.lowest[at(given[at(j)])];
        }
        return program;
    }

    void read(const ConvexSolution& found) {
        const Index n = torques_.cols();
        if (options_.synergies.size() > 0) {
            shares_.amounts.assign(found.y.data(), found.y.data() + found.y.size());
            for (double& amount : shares_.amounts) amount = std::max(amount, 0.0);
            for (Index i = 0; i < n; ++i) shares_.activations[at(i)] = found.x[i];
        } else {
            for (std::size_t x = 0; x < free_.size(); ++x)
                shares_.activations[free_[x]] = found.x[to_index(x)];
        }
        for (std::size_t i = 0; i < at(n); ++i) {
            double& a = shares_.activations[i];
            const double kept = std::clamp(a, shares_.lowest[i], shares_.highest[i]);
            if (std::abs(a - kept) > shares_.outside) {
                shares_.outside = std::abs(a - kept);
                shares_.most_outside = i;
            }
            a = kept;
        }
        shares_.lack.assign(kinds_.size(), 0);
        shares_.prices.assign(kinds_.size(), 0);
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            const std::size_t c = at(rows_[row]);
            shares_.lack[c] = found.missing[to_index(row)] * shares_.capacity[c];
            shares_.prices[c] = found.multipliers[to_index(row)] * dearest_ / shares_.capacity[c];
        }
        shares_.residual = found.residual;
        shares_.iterations = found.iterations;
    }

    const Demand& demand_;
    const DistributionOptions& options_;
    std::vector<Balance> kinds_;
    MatrixXd torques_;         // (coordinate, muscle): at full activation
    VectorXd asked_;           // of active pulls
    std::vector<Index> rows_;  // coordinates to balance
    std::vector<std::size_t> free_;
    double dearest_ = 1;
    Shares shares_;
};

}  // namespace

std::vector<Balance> kinds_of_balance(const DistributionOptions& options, std::size_t coordinates) {
    std::vector<Balance> kinds(coordinates, Balance::strict);
    for (std::size_t c = 0; c < options.reserves.size(); ++c)
        if (options.reserves[c] > 0)
            kinds[c] = std::isfinite(options.reserves[c]) ? Balance::helped : Balance::held;
    return kinds;
}

Shares solve_shares(const Demand& demand, const DistributionOptions& options) {
    return Builder(demand, options).solve();
}

double cost_of(const Demand& demand, const DistributionOptions& options,
               const std::vector<double>& activations) {
    double sum = 0;
    for (std::size_t i = 0; i < activations.size(); ++i) {
        const Term t = term(demand, options, i);
        sum += t.weight * std::pow(std::abs(t.offset + t.scale * activations[i]), options.exponent);
    }
    return sum;
}

}  // namespace myotet::activation
