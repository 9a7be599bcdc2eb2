// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/LinearSolver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Parallel.h"
#include "Dynamics/NodeAlgebra.h"
#include "HeldBlock.h"

namespace myotet::dynamics {
namespace {

using test::HeldBlock;
constexpr LinearOptions kOptions{1e-10, 5000};

struct Answer {
    LinearSummary summary;
    NodeVectors x;
};
Answer answer(LinearSolver& solver, const HeldBlock& block, const BlockMatrix& K,
              const LinearOptions& options = kOptions) {
    Answer a{{}, NodeVectors(block.nodes(), Vec3::Zero())};
    a.summary =
        solver.solve(K, block.held, test::random_vectors(block.nodes(), 1, 1), options, a.x);
    return a;
}
double distance(NodeVectors a, const NodeVectors& b) {
    add_scaled(-1, b, a);
    return std::sqrt(dot(a, a) / dot(b, b));
}

TEST(LinearSolver, AllMethodsFindTheSameAnswer) {
    const HeldBlock block;
    LinearSolver iterative(LinearMethod::iterative), factored(LinearMethod::factored), automatic;
    const Answer by_iterations = answer(iterative, block, block.K),
                 by_factor = answer(factored, block, block.K),
                 by_itself = answer(automatic, block, block.K);
    EXPECT_TRUE(by_iterations.summary.converged);
    EXPECT_TRUE(by_factor.summary.converged);
    EXPECT_TRUE(by_itself.summary.converged);
    EXPECT_LT(distance(by_factor.x, by_iterations.x), 1e-8);
    EXPECT_LT(distance(by_itself.x, by_iterations.x), 1e-8);
    EXPECT_EQ(iterative.factors(), 0);
    EXPECT_EQ(factored.factors(), 1);
    EXPECT_LE(by_factor.summary.iterations, 2);
}

TEST(LinearSolver, HeldNodesKeepTheirValues) {
    const HeldBlock block;
    for (const LinearMethod method : {LinearMethod::iterative, LinearMethod::factored}) {
        LinearSolver solver(method);
        const NodeVectors start = test::random_vectors(block.nodes(), 1, 2),
                          right = test::random_vectors(block.nodes(), 1, 1);
        NodeVectors x = start;
        EXPECT_TRUE(solver.solve(block.K, block.held, right, kOptions, x).converged);
        for (std::size_t n = 0; n < x.size(); ++n)
            if (block.held[n]) {
                EXPECT_EQ(x[n], start[n]);
            }
        EXPECT_LT(HeldBlock::miss(block.K, block.held, x, right), 1e-8);
    }
}

TEST(LinearSolver, TurnsToAFactorWhereThatPays) {
    // Nearly incompressible: more iterations than a factor of so small a matrix is worth.
    const HeldBlock hard(5, 0.4999);
    LinearSolver solver;
    const Answer first = answer(solver, hard, hard.K);
    EXPECT_GT(first.summary.iterations, 100);
    EXPECT_EQ(solver.factors(), 0);
    const Answer second = answer(solver, hard, hard.K);
    EXPECT_EQ(solver.factors(), 1);
    EXPECT_LT(second.summary.iterations, 5);
    EXPECT_LT(distance(second.x, first.x), 1e-6);
}

TEST(LinearSolver, StaysWithIterationsWhereTheyAreFew) {
    // As a short time step makes it.
    const HeldBlock block;
    const BlockMatrix easy = block.with_diagonal_times(2);
    LinearSolver solver;
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(answer(solver, block, easy).summary.converged);
    EXPECT_EQ(solver.factors(), 0);
}

TEST(LinearSolver, AFactorServesUntilItIsStale) {
    const HeldBlock block;
    LinearSolver solver(LinearMethod::factored);
    ASSERT_TRUE(answer(solver, block, block.K).summary.converged);
    const Answer near = answer(solver, block, block.with_diagonal_times(1.01));
    EXPECT_TRUE(near.summary.converged);
    EXPECT_EQ(solver.factors(), 1);
    EXPECT_GT(near.summary.iterations, 1);
    const Answer far = answer(solver, block, block.with_diagonal_times(30));
    EXPECT_TRUE(far.summary.converged);
    EXPECT_EQ(solver.factors(), 2);
    const Answer back = answer(solver, block, block.K);
    EXPECT_TRUE(back.summary.converged);
    LinearSolver fresh(LinearMethod::iterative);
    EXPECT_LT(distance(back.x, answer(fresh, block, block.K).x), 1e-8);
}

TEST(LinearSolver, GivesAWayDownWhereTheMatrixIsNotPositive) {
    const HeldBlock block;
    for (const double tolerance : {0.1, 1e-8}) {
        const BlockMatrix K = block.with_diagonal_times(0.9);
        LinearSolver solver(LinearMethod::factored);
        const Answer a = answer(solver, block, K, {tolerance, 1000});
        if (tolerance < 0.01) {
            ASSERT_EQ(a.summary.downward.size(), block.nodes());
        }
        if (!a.summary.downward.empty()) {
            EXPECT_LE(dot(a.summary.downward, multiply(K, a.summary.downward)), 0);
        }
    }
}

TEST(LinearSolver, GoesOnWithoutAFactorWhereThereIsNone) {
    const HeldBlock block(2);
    BlockMatrix K = block.K;
    K.value[K.at(26, 26)](0, 0) = std::nan("");
    LinearSolver solver(LinearMethod::factored);
    EXPECT_FALSE(answer(solver, block, K).summary.converged);
    EXPECT_TRUE(answer(solver, block, block.K).summary.converged);
}

TEST(LinearSolver, SameBytesOnOneThreadOrMany) {
    const HeldBlock hard(6, 0.4999);
    const auto on = [&](int threads) {
        const ThreadLimit limit(threads);
        LinearSolver solver;
        (void)answer(solver, hard, hard.K);
        return answer(solver, hard, hard.K).x;
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::dynamics
