// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "Activation/Distribution.h"

namespace myotet::activation {

// Conditions hold to 1e-10, so activations of a strongly convex cost too, times its condition.
inline constexpr double kSame = 1e-7, kResidual = 1e-9;
// Torques are sums of some 1e4 N mm.
inline constexpr double kTorque = 1e-5;

inline void expect_solved(const Distribution& found) {
    EXPECT_EQ(found.status, Status::converged) << found.message;
    EXPECT_LE(found.residual, kResidual);
    EXPECT_LE(found.torque_residual, kTorque);
}
inline void expect_same(const std::vector<double>& a, const std::vector<double>& b,
                        double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

/// Muscles on both sides of each coordinate, and torques that activations somewhere between
/// the bounds make. mm, N.
inline Demand random_demand(std::mt19937& random, int coordinates, int muscles) {
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    Demand demand;
    demand.arms.resize(coordinates, muscles);
    for (int i = 0; i < muscles; ++i) {
        demand.gains.push_back(100 + 900 * unit(random));
        demand.passive.push_back(20 * unit(random));
        for (int c = 0; c < coordinates; ++c) demand.arms(c, i) = 40 * both(random);
    }
    const auto count = static_cast<std::size_t>(coordinates);
    demand.torques.assign(count, 0);
    for (int i = 0; i < muscles; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const double force = demand.passive[at] + demand.gains[at] * unit(random);
        for (int c = 0; c < coordinates; ++c)
            demand.torques[static_cast<std::size_t>(c)] += demand.arms(c, i) * force;
    }
    return demand;
}

}  // namespace myotet::activation
