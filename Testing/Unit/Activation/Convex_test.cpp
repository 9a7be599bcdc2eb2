// SPDX-License-Identifier: Apache-2.0
#include "Activation/Convex.h"

#include <gtest/gtest.h>

#include <limits>

namespace myotet::activation {
namespace {

constexpr double kSame = 1e-10;

ConvexProgram program(Eigen::Index n, Eigen::Index rows) {
    ConvexProgram p;
    p.diagonal = true;
    p.cost = p.scale = p.highest = Eigen::VectorXd::Ones(n);
    p.offset = p.pull = p.towards = p.lowest = Eigen::VectorXd::Zero(n);
    p.balance = Eigen::MatrixXd::Ones(rows, n);
    p.goal = Eigen::VectorXd::Ones(rows);
    p.price = Eigen::VectorXd::Constant(rows, 1e6);
    return p;
}

TEST(Convex, OfNothingIsNothing) {
    const ConvexSolution found = solve_convex(program(0, 0), {});
    EXPECT_TRUE(found.converged);
    EXPECT_EQ(found.iterations, 0);
    EXPECT_EQ(found.x.size(), 0);
}

TEST(Convex, WithoutUnknownsAllIsMissing) {
    const ConvexSolution found = solve_convex(program(0, 2), {});
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.missing[0], 1, kSame);
    EXPECT_NEAR(found.missing[1], 1, kSame);
}

TEST(Convex, WithoutBalanceEachIsAtItsOwnBest) {
    ConvexProgram p = program(3, 0);
    p.offset << 0, -0.5, -7;  // least |x|^2, |x - 0.5|^2, |x - 7|^2
    const ConvexSolution found = solve_convex(p, {});
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.x[0], 0, kSame);
    EXPECT_NEAR(found.x[1], 0.5, kSame);
    EXPECT_NEAR(found.x[2], 1, kSame);
    EXPECT_NEAR(found.at_highest[2], 12, kSame);
}

TEST(Convex, SharesWithinBoundsAndTellsPrices) {
    // x0 may be 0.2 at most, so x1 is 0.8; multiplier 2 * 0.8, on the bound 1.6 - 0.4.
    ConvexProgram p = program(2, 1);
    p.highest[0] = 0.2;
    const ConvexSolution found = solve_convex(p, {});
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.x[1], 0.8, kSame);
    EXPECT_NEAR(found.multipliers[0], 1.6, kSame);
    EXPECT_NEAR(found.at_highest[0], 1.2, kSame);
    EXPECT_NEAR(found.missing[0], 0, kSame);
}

TEST(Convex, BuysWhatCostsLess) {
    // Twice the least x is the price of r: 2 x = 0.6.
    ConvexProgram p = program(1, 1);
    p.price[0] = 0.6;
    const ConvexSolution found = solve_convex(p, {});
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.x[0], 0.3, kSame);
    EXPECT_NEAR(found.missing[0], 0.7, kSame);
}

TEST(Convex, SharedUnknownsMayHaveNoUpperBound) {
    // y drives x0 and half x1: 1.5 y = 3, least y^2 + y^2 / 4.
    ConvexProgram p = program(2, 1);
    p.diagonal = false;
    p.shares = Eigen::MatrixXd{{1.0}, {0.5}};
    p.highest.setConstant(std::numeric_limits<double>::infinity());
    p.balance = Eigen::MatrixXd{{1.5}};
    p.goal[0] = 3;
    const ConvexSolution found = solve_convex(p, {});
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.y[0], 2, kSame);
    EXPECT_NEAR(found.x[1], 1, kSame);
    EXPECT_NEAR(found.multipliers[0], 2 * 2.5 / 1.5, kSame);
}

TEST(Convex, SaysWhenItHasNotConverged) {
    const ConvexSolution found = solve_convex(program(4, 1), {.iterations = 2});
    EXPECT_FALSE(found.converged);
    EXPECT_EQ(found.iterations, 2);
    EXPECT_GT(found.residual, 1e-6);
}

}  // namespace
}  // namespace myotet::activation
