// SPDX-License-Identifier: Apache-2.0
#include "Activation/DistributionProgram.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "ActivationCase.h"
#include "Core/Parallel.h"
#include "Core/Progress.h"

namespace myotet::activation {
namespace {

// The least sum of squares by trying each set of active bounds.
std::optional<std::vector<double>> by_all_sets(const Demand& demand) {
    const auto n = static_cast<int>(demand.muscles());
    const Eigen::Index m = demand.arms.rows();
    int sets = 1;
    for (int i = 0; i < n; ++i) sets *= 3;
    for (int set = 0; set < sets; ++set) {
        // Unknowns: activations and multipliers.
        Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + m, n + m);
        Eigen::VectorXd right = Eigen::VectorXd::Zero(n + m);
        std::vector<int> state;
        for (int i = 0, rest = set; i < n; ++i, rest /= 3) {
            const auto at = static_cast<std::size_t>(i);
            state.push_back(rest % 3);
            K(i, i) = state.back() == 0 ? 2 : 1;
            right[i] = state.back() == 2 ? 1 : 0;
            for (Eigen::Index c = 0; c < m; ++c) {
                const double torque = demand.arms(c, i) * demand.gains[at] * 1e-4;
                if (state.back() == 0) K(i, n + c) = -torque;
                K(n + c, i) = torque;
                right[n + c] -= demand.arms(c, i) * demand.passive[at] * 1e-4;
            }
        }
        for (Eigen::Index c = 0; c < m; ++c)
            right[n + c] += demand.torques[static_cast<std::size_t>(c)] * 1e-4;
        const Eigen::FullPivLU<Eigen::MatrixXd> lu(K);
        if (!lu.isInvertible()) continue;
        const Eigen::VectorXd x = lu.solve(right);
        bool optimal = true;
        for (int i = 0; i < n; ++i) {
            double slope = 2 * x[i];
            for (Eigen::Index c = 0; c < m; ++c)
                slope -=
                    demand.arms(c, i) * demand.gains[static_cast<std::size_t>(i)] * 1e-4 * x[n + c];
            const int s = state[static_cast<std::size_t>(i)];
            optimal = optimal && (s == 0   ? x[i] >= 0 && x[i] <= 1
                                  : s == 1 ? slope >= 0
                                           : slope <= 0);
        }
        if (optimal) return std::vector<double>(x.data(), x.data() + n);
    }
    return {};
}

// Of two coordinates, by the dual: a_i = (lambda . torque_i / p)^(1 / (p - 1)) within bounds,
// where each balance grows with its own multiplier. Nested bisection.
std::vector<double> by_bisection(const Demand& demand, double p) {
    const auto n = static_cast<Eigen::Index>(demand.muscles());
    Eigen::Vector2d asked(demand.torques[0], demand.torques[1]), lambda(0, 0);
    for (Eigen::Index i = 0; i < n; ++i)
        asked -= demand.arms.col(i) * demand.passive[static_cast<std::size_t>(i)];
    std::vector<double> a(demand.muscles());
    const auto excess = [&](int c) {
        double sum = -asked[c];
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const double slope = lambda.dot(demand.arms.col(i)) * demand.gains[at] / p;
            a[at] = slope <= 0 ? 0 : std::min(1.0, std::pow(slope, 1 / (p - 1)));
            sum += demand.arms(c, i) * demand.gains[at] * a[at];
        }
        return sum;
    };
    const auto bisect = [&](int c, const auto& value) {
        double low = -1, high = 1;
        for (int i = 0; i < 110; ++i) {
            lambda[c] = 0.5 * (low + high);
            (value() < 0 ? low : high) = lambda[c];
        }
    };
    bisect(1, [&] {
        bisect(0, [&] { return excess(0); });
        return excess(1);
    });
    bisect(0, [&] { return excess(0); });
    (void)excess(0);
    return a;
}

TEST(DistributionProgram, IsTheBestOfAllActiveSets) {
    std::mt19937 random(1);
    int at_bounds = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const Demand demand = random_demand(random, 1 + trial % 3, 4 + trial % 3);
        const auto expected = by_all_sets(demand);
        ASSERT_TRUE(expected);
        const Distribution found = distribute(demand, {});
        expect_solved(found);
        expect_same(found.activations, *expected, kSame);
        for (const int bound : found.bounds) at_bounds += bound != 0;
    }
    EXPECT_GT(at_bounds, 30) << "the case tests bounds";
}

TEST(DistributionProgram, IsTheDualsForAnyExponent) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 40; ++trial)
        for (const double p : {1.5, 2.0, 3.0, 5.0}) {
            const Demand demand = random_demand(random, 2, 6);
            const Distribution found = distribute(demand, {.exponent = p});
            expect_solved(found);
            // Of high powers small activations hardly cost: 1e-10 in cost is more in them.
            expect_same(found.activations, by_bisection(demand, p), p > 3 ? 2e-3 : 2e-5);
        }
}

TEST(DistributionProgram, OfManyTimesTakesLittleAndTheSameEach) {
    std::mt19937 random(8);
    std::vector<Demand> demands;
    for (int i = 0; i < 100; ++i) demands.push_back(random_demand(random, 2, 6));
    SilentProgress silent;
    const ThreadLimit one(1);
    std::vector<Distribution> all;
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 5; ++run) {
        const auto begin = std::chrono::steady_clock::now();
        all = distribute(demands, {}, silent);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        least = std::min(least, taken.count());
    }
    // 8 ms were measured; the rest is for busy machines.
    EXPECT_LT(least, 0.05);
    RecordProperty("seconds", std::to_string(least));
    for (std::size_t i = 0; i < all.size(); ++i) {
        expect_solved(all[i]);
        EXPECT_EQ(all[i].activations, distribute(demands[i], {}).activations);
    }
}

}  // namespace
}  // namespace myotet::activation
