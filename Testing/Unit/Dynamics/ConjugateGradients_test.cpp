// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/ConjugateGradients.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Parallel.h"
#include "Dynamics/ElasticBody.h"
#include "Dynamics/NodeAlgebra.h"
#include "DynamicsShapes.h"
#include "Elasticity/Materials.h"
#include "Elasticity/PointLaw.h"

namespace myotet::dynamics {
namespace {

// The stiffness of a block at rest; one end held.
struct Held {
    TetMesh mesh;
    BlockMatrix K;
    std::vector<char> held;

    explicit Held(int cubes = 4) : mesh(test::block(cubes, 1)) {
        using elasticity::NeoHookean;
        ElasticBody body(mesh, std::make_shared<elasticity::OneLaw<NeoHookean>>(
                                   NeoHookean{elasticity::lame_from(1, 0.4)}));
        (void)body.move_to(mesh.points);
        K = block_pattern(mesh.points.size(), body.cliques());
        body.add_stiffness(K);
        for (const Vec3& p : mesh.points) held.push_back(p.z() == 0);
    }
};

TEST(Solve, SatisfiesTheEquationAtFreeNodesAndLeavesHeldOnesAlone) {
    const Held block;
    const NodeVectors right = test::random_vectors(block.held.size(), 1, 1),
                      start = test::random_vectors(block.held.size(), 1, 2);
    NodeVectors x = start;
    const LinearSummary summary = solve(block.K, block.held, right, {1e-12, 1000}, x);
    EXPECT_TRUE(summary.converged);
    EXPECT_TRUE(summary.downward.empty());
    EXPECT_LT(summary.iterations, 200);
    const NodeVectors product = multiply(block.K, x);
    for (std::size_t n = 0; n < x.size(); ++n) {
        if (block.held[n]) {
            EXPECT_EQ(x[n], start[n]);
        } else {
            EXPECT_LT((product[n] - right[n]).norm(), 1e-10);
        }
    }
}

TEST(Solve, SaysWhenItIsOutOfIterations) {
    const Held block;
    const NodeVectors right = test::random_vectors(block.held.size(), 1, 1);
    NodeVectors x(right.size(), Vec3::Zero());
    const LinearSummary summary = solve(block.K, block.held, right, {1e-12, 3}, x);
    EXPECT_FALSE(summary.converged);
    EXPECT_TRUE(summary.downward.empty());
    EXPECT_EQ(summary.iterations, 3);
    EXPECT_GT(summary.residual, 1e-12);
}

TEST(Solve, GivesAWayDownWhereTheMatrixIsNotPositive) {
    const Held block;
    const NodeVectors right = test::random_vectors(block.held.size(), 1, 1);
    for (const double shift : {0.9, 10.0}) {  // of the diagonal: inside the spectrum, above it
        BlockMatrix K = block.K;
        for (std::int32_t n = 0; n < static_cast<std::int32_t>(right.size()); ++n)
            K.value[K.at(n, n)] *= 1 - shift;
        NodeVectors x(right.size(), Vec3::Zero());
        const LinearSummary summary = solve(K, block.held, right, {1e-12, 1000}, x);
        EXPECT_FALSE(summary.converged);
        const NodeVectors& p = summary.downward;
        ASSERT_EQ(p.size(), right.size());
        EXPECT_LE(dot(p, multiply(K, p)), 0);
        EXPECT_GT(dot(p, right), 0);
        EXPECT_GE(dot(x, right), 0);
        for (std::size_t n = 0; n < p.size(); ++n)
            if (block.held[n]) {
                EXPECT_EQ(p[n], Vec3(Vec3::Zero()));
            }
    }
}

TEST(Solve, SinglePrecisionServesALooseTolerance) {
    const Held block;
    const NodeVectors right = test::random_vectors(block.held.size(), 1, 1);
    NodeVectors loose(right.size(), Vec3::Zero()), tight = loose;
    // From 1e-5 on K is read in single precision.
    const LinearSummary single = solve(block.K, block.held, right, {1e-5, 1000}, loose),
                        twice = solve(block.K, block.held, right, {0.99e-5, 1000}, tight);
    EXPECT_TRUE(single.converged);
    EXPECT_TRUE(twice.converged);
    EXPECT_NEAR(single.iterations, twice.iterations, 2);
    // What it promises holds of K itself: the residual that is left beside the right side, up
    // to the ratio of the norms, that of the preconditioner and this one.
    for (const NodeVectors& x : {loose, tight}) {
        const NodeVectors product = multiply(block.K, x);
        double left = 0, all = 0;
        for (std::size_t n = 0; n < x.size(); ++n) {
            if (block.held[n]) continue;
            left += (product[n] - right[n]).squaredNorm();
            all += right[n].squaredNorm();
        }
        EXPECT_LT(std::sqrt(left / all), 3e-5);
    }
}

TEST(Solve, GoesOnWhileIterationsAreCheap) {
    const Held block;
    const NodeVectors right = test::random_vectors(block.held.size(), 1, 1);
    const auto residual = [&](int cheap) {
        NodeVectors x(right.size(), Vec3::Zero());
        const LinearSummary summary = solve(block.K, block.held, right, {0.1, 1000, cheap}, x);
        EXPECT_TRUE(summary.converged);
        return std::pair(summary.iterations, summary.residual);
    };
    const auto [few, loose] = residual(0);
    const auto [some, tighter] = residual(few + 5);
    const auto [many, tight] = residual(1000);
    EXPECT_EQ(some, few + 5);
    EXPECT_LT(tighter, loose);
    EXPECT_LE(tight, 1e-3);
    EXPECT_LT(many, 200);
}

TEST(Solve, WhatIsNoNumberDoesNotConverge) {
    const Held block;
    BlockMatrix K = block.K;
    K.value.back()(0, 0) = std::nan("");
    NodeVectors x(block.held.size(), Vec3::Zero());
    const LinearSummary summary =
        solve(K, block.held, test::random_vectors(x.size(), 1, 1), {1e-8, 100}, x);
    EXPECT_FALSE(summary.converged);
    EXPECT_TRUE(summary.downward.empty());
}

TEST(Solve, SameBytesOnOneThreadOrMany) {
    const Held block(16);  // more nodes than one thread takes
    const NodeVectors right = test::random_vectors(block.held.size(), 1, 1);
    const auto on = [&](int threads) {
        const ThreadLimit limit(threads);
        NodeVectors x(right.size(), Vec3::Zero());
        EXPECT_TRUE(solve(block.K, block.held, right, {1e-10, 1000}, x).converged);
        return x;
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::dynamics
