// SPDX-License-Identifier: Apache-2.0
#include "Activation/Distribution.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "Activation/DistributionProgram.h"
#include "Activation/Require.h"
#include "Core/Parallel.h"
#include "Core/Progress.h"

namespace myotet::activation {
namespace {

// What a coordinate without reserve may lack, as a part of what its muscles can do.
constexpr double kMissing = 1e-7;
// A bound of an activation that is nearer than this and resists is active.
constexpr double kAtBound = 1e-7;
// By how much bounds may be broken by synergies that cannot keep them.
constexpr double kOutside = 1e-7;

std::string name_of(const std::vector<std::string>& names, std::size_t i, const char* kind) {
    return i < names.size() ? names[i] : std::string(kind) + " " + std::to_string(i);
}

// Forces, balance and what is left over, from the activations.
void account(const Demand& demand, const Shares& shares, const std::vector<Balance>& kinds,
             Distribution& out) {
    const auto m = static_cast<Eigen::Index>(demand.coordinates());
    Eigen::VectorXd pulled(static_cast<Eigen::Index>(demand.muscles()));
    for (std::size_t i = 0; i < demand.muscles(); ++i) {
        const double passive = demand.passive.empty() ? 0 : demand.passive[i];
        out.forces.push_back(passive + demand.gains[i] * out.activations[i]);
        pulled[static_cast<Eigen::Index>(i)] = out.forces.back();
    }
    const Eigen::VectorXd made = demand.arms * pulled;
    out.reserves.assign(demand.coordinates(), 0);
    out.missing.assign(demand.coordinates(), 0);
    for (Eigen::Index c = 0; c < m; ++c) {
        const auto at = static_cast<std::size_t>(c);
        const double left = demand.torques[at] - made[c], explained = shares.lack[at];
        double rest = left - explained;
        if (kinds[at] == Balance::held) {
            out.reserves[at] = left;
            rest = 0;
        } else if (kinds[at] == Balance::helped) {
            out.reserves[at] = explained;
        } else {
            const bool missing = std::abs(explained) > kMissing * shares.capacity[at];
            out.missing[at] = missing ? explained : 0;
            rest = left - out.missing[at];
        }
        out.torque_residual = std::max(out.torque_residual, std::abs(rest));
    }
}

void judge(const Shares& shares, const DistributionOptions& options, Distribution& out) {
    std::ostringstream text;
    if (shares.outside > kOutside) {
        out.status = Status::infeasible;
        text << "synergies cannot keep the bounds of "
             << name_of(options.muscle_names, shares.most_outside, "muscle") << "; widen them";
    } else if (out.residual > options.tolerance) {
        out.status = Status::not_converged;
        text << "residual " << out.residual << " after " << out.iterations << " iterations";
    } else {
        out.status = Status::converged;
        for (std::size_t c = 0; c < out.missing.size(); ++c) {
            if (out.missing[c] == 0) continue;
            text << (out.status == Status::converged ? "muscles cannot balance " : ", ")
                 << name_of(options.coordinate_names, c, "coordinate") << ", where "
                 << out.missing[c] << " is missing";
            out.status = Status::infeasible;
        }
        text << (out.status == Status::converged ? "converged" : "; allow a reserve there");
    }
    out.message = text.str();
}

Distribution distribute_valid(const Demand& demand, const DistributionOptions& options) {
    const Shares shares = solve_shares(demand, options);
    Distribution out;
    out.activations = shares.activations;
    out.amounts = shares.amounts;
    out.iterations = shares.iterations;
    out.residual = shares.residual;
    out.prices = shares.prices;
    for (std::size_t i = 0; i < demand.muscles(); ++i) {
        const double below = out.activations[i] - shares.lowest[i];
        const double above = shares.highest[i] - out.activations[i];
        out.bounds.push_back(below <= kAtBound ? -1 : above <= kAtBound ? 1 : 0);
    }
    out.cost = cost_of(demand, options, out.activations);
    account(demand, shares, kinds_of_balance(options, demand.coordinates()), out);
    judge(shares, options, out);
    return out;
}

}  // namespace

void DistributionOptions::validate(std::size_t muscles, std::size_t coordinates) const {
    const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
    const auto strength = [](double x) { return x >= 0; };
    require(exponent > 1 && exponent <= 20, "exponent", exponent,
            "it must be more than 1 and at most 20 (2 and 3 are usual)");
    if (!weights.empty())
        require_each(weights, muscles, "weights", "it must be positive", positive);
    if (criterion == Criterion::stress)
        require_each(areas, muscles, "areas", "it must be positive, mm^2", positive);
    if (!reserves.empty())
        require_each(reserves, coordinates, "reserves", "it must not be negative", strength);
    require(reserve_price > 0 && reserve_price <= 1e5, "reserve_price", reserve_price,
            "it must be positive and at most 1e5 (1000 is usual)");
    require(tracking >= 0 && std::isfinite(tracking), "tracking", tracking,
            "it must not be negative");
    require(tolerance > 0, "tolerance", tolerance, "it must be positive (1e-9 is usual)");
    require(iterations > 0, "iterations", iterations, "it must be positive (100 is usual)");
    if (synergies.size() == 0) return;
    require(synergies.rows() == static_cast<Eigen::Index>(muscles), "synergies.rows()",
            static_cast<double>(synergies.rows()), "it must be the number of muscles");
    require(synergies.allFinite() && synergies.minCoeff() >= 0, "synergies", synergies.minCoeff(),
            "none may be negative");
    require(synergies.colwise().sum().minCoeff() > 0, "synergies",
            synergies.colwise().sum().minCoeff(), "each must have a muscle");
}

Distribution distribute(const Demand& demand, const DistributionOptions& options) {
    demand.validate();
    options.validate(demand.muscles(), demand.coordinates());
    return distribute_valid(demand, options);
}

std::vector<Distribution> distribute(std::span<const Demand> demands,
                                     const DistributionOptions& options, ProgressSink& progress) {
    for (const Demand& demand : demands) {
        demand.validate();
        options.validate(demand.muscles(), demand.coordinates());
    }
    std::vector<Distribution> all(demands.size());
    progress.report("muscle forces", 0);
    parallel_for(0, demands.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) all[i] = distribute_valid(demands[i], options);
        progress.check();
    });
    progress.report("muscle forces", 1);
    return all;
}

Distribution distribute(const Demand& demand, const PullOf& pull,
                        const DistributionOptions& options) {
    constexpr double kChange = 1e-10;
    demand.validate();
    options.validate(demand.muscles(), demand.coordinates());
    Demand tangent = demand;
    tangent.passive.assign(demand.muscles(), 0);
    std::vector<double> a(demand.muscles(), 0.1);
    for (std::size_t i = 0; i < a.size(); ++i)
        a[i] = std::clamp(a[i], demand.lowest.empty() ? 0 : demand.lowest[i],
                          demand.highest.empty() ? 1 : demand.highest[i]);
    Distribution found;
    double before = 1, step = 1;
    int iterations = 0;
    for (int outer = 0; outer < options.iterations; ++outer) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            const Pull now = pull(i, a[i]);
            tangent.gains[i] = std::max(now.slope, 0.0);
            tangent.passive[i] = now.force - tangent.gains[i] * a[i];
        }
        found = distribute_valid(tangent, options);
        found.iterations = iterations += found.iterations;
        double change = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            change = std::max(change, std::abs(found.activations[i] - a[i]));
        if (change <= kChange) return found;
        // Steps that do not become shorter swing to and fro: halved.
        if (change > 0.9 * before) step = std::max(0.5 * step, 0.05);
        before = change;
        for (std::size_t i = 0; i < a.size(); ++i) a[i] += step * (found.activations[i] - a[i]);
    }
    if (found.status == Status::converged) {
        found.status = Status::not_converged;
        found.message = "activations still change by " + std::to_string(before) + " after " +
                        std::to_string(options.iterations) + " linearisations";
    }
    return found;
}

}  // namespace myotet::activation
