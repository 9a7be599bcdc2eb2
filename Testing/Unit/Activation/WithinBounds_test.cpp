// SPDX-License-Identifier: Apache-2.0
#include "Activation/WithinBounds.h"

#include <gtest/gtest.h>

#include <random>

namespace myotet::activation {
namespace {

constexpr double kSlope = 1e-9;

// A dense matrix as one block.
BlockBand whole(const Eigen::MatrixXd& dense) {
    BlockBand band(1, dense.rows(), 0);
    band.at(0, 0) = dense;
    return band;
}

// Of 1/2 |A x - b|^2.
CostAt linear(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    return [A, b](const Eigen::VectorXd& x, double, bool) -> Cost {
        const Eigen::VectorXd r = A * x - b;
        return {0.5 * r.squaredNorm(), A.transpose() * r, whole(A.transpose() * A)};
    };
}

TEST(WithinBounds, WithoutBoundsInReachIsTheLeastOfAll) {
    const Eigen::MatrixXd A{{2, 1}, {0, 1}, {1, 1}};
    Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
    const Eigen::VectorXd far = Eigen::VectorXd::Constant(2, 100);
    const BoundsResult found =
        least_within_bounds(linear(A, A * Eigen::Vector2d(3, -4)), -far, far, {}, x);
    EXPECT_LE(found.slope, kSlope);
    EXPECT_NEAR(x[0], 3, 1e-8);
    EXPECT_NEAR(x[1], -4, 1e-8);
}

TEST(WithinBounds, BendsDownwardsWhereTheCostDoes) {
    // Two wells in x and a ridge between them, on which it starts; y drags along.
    const CostAt wells = [](const Eigen::VectorXd& v, double, bool) -> Cost {
        const double x = v[0], y = v[1], d = y - x;
        return {0.25 * x * x * x * x - 0.5 * x * x - 0.01 * x + 5 * d * d,
                Eigen::Vector2d(x * x * x - x - 0.01 - 10 * d, 10 * d),
                whole(Eigen::Matrix2d{{3 * x * x - 1 + 10, -10}, {-10, 10}})};
    };
    const Eigen::VectorXd most = Eigen::VectorXd::Constant(2, 2);
    for (const double start : {0.0, 0.01, 1.9}) {
        Eigen::VectorXd x = Eigen::VectorXd::Constant(2, start);
        const BoundsResult found = least_within_bounds(wells, -most, most, {}, x);
        EXPECT_LE(found.slope, kSlope);
        EXPECT_NEAR(x[0], 1.005, 1e-3);
        EXPECT_NEAR(x[1], x[0], 1e-8);
    }
}

TEST(WithinBounds, FindsWhichBoundsHold) {
    // The slope must push outwards at bounds and be nothing elsewhere: enough, since convex.
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    int held = 0;
    for (int trial = 0; trial < 30; ++trial) {
        Eigen::MatrixXd A(30, 20);
        Eigen::VectorXd b(30), x = Eigen::VectorXd::Constant(20, 0.5);
        for (double& a : A.reshaped()) a = normal(random);
        for (double& a : b.reshaped()) a = 4 * normal(random);
        const Eigen::VectorXd low = Eigen::VectorXd::Zero(20), high = Eigen::VectorXd::Ones(20);
        const BoundsResult found = least_within_bounds(linear(A, b), low, high, {}, x);
        EXPECT_LE(found.slope, kSlope);
        EXPECT_LE(found.iterations, 40);
        const Eigen::VectorXd slope = A.transpose() * (A * x - b);
        for (int i = 0; i < 20; ++i) {
            held += x[i] == 0 || x[i] == 1;
            if (x[i] == 0)
                EXPECT_GE(slope[i], -kSlope);
            else if (x[i] == 1)
                EXPECT_LE(slope[i], kSlope);
            else
                EXPECT_NEAR(slope[i], 0, kSlope);
        }
    }
    EXPECT_GT(held, 150) << "the case tests bounds";
}

TEST(WithinBounds, EndsWhereNothingDepends) {
    Eigen::VectorXd x = Eigen::VectorXd::Constant(3, 0.3);
    const BoundsResult found =
        least_within_bounds(linear(Eigen::MatrixXd::Zero(2, 3), Eigen::VectorXd::Ones(2)),
                            Eigen::VectorXd::Zero(3), Eigen::VectorXd::Ones(3), {}, x);
    EXPECT_EQ(found.slope, 0);
    EXPECT_TRUE((x.array() >= 0).all() && (x.array() <= 1).all());
}

}  // namespace
}  // namespace myotet::activation
