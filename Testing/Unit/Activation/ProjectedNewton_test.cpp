// SPDX-License-Identifier: Apache-2.0
#include "Activation/ProjectedNewton.h"

#include <gtest/gtest.h>

#include <random>

namespace myotet::activation {
namespace {

constexpr double kSlope = 1e-9;

// Of 1/2 |A x - b|^2.
SquaresAt linear(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    return [A, b](const Eigen::VectorXd& x, bool) -> Squares {
        const Eigen::VectorXd r = A * x - b;
        return {0.5 * r.squaredNorm(), A.transpose() * r, A.sparseView()};
    };
}

TEST(ProjectedNewton, WithoutBoundsInReachIsOneStep) {
    const Eigen::MatrixXd A{{2, 1}, {0, 1}, {1, 1}};
    Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
    const Eigen::VectorXd far = Eigen::VectorXd::Constant(2, 100);
    const ProjectedResult found =
        least_within_bounds(linear(A, A * Eigen::Vector2d(3, -4)), -far, far, {}, x);
    EXPECT_EQ(found.iterations, 1);
    EXPECT_NEAR(x[0], 3, 1e-10);
    EXPECT_NEAR(x[1], -4, 1e-10);
}

TEST(ProjectedNewton, FindsWhichBoundsHold) {
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
        const ProjectedResult found = least_within_bounds(linear(A, b), low, high, {}, x);
        EXPECT_LE(found.slope, kSlope);
        EXPECT_LE(found.iterations, 30);
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

TEST(ProjectedNewton, EndsWhereNothingDepends) {
    Eigen::VectorXd x = Eigen::VectorXd::Constant(3, 0.3);
    const ProjectedResult found =
        least_within_bounds(linear(Eigen::MatrixXd::Zero(2, 3), Eigen::VectorXd::Ones(2)),
                            Eigen::VectorXd::Zero(3), Eigen::VectorXd::Ones(3), {}, x);
    EXPECT_EQ(found.iterations, 0);
    EXPECT_EQ(x, Eigen::VectorXd::Constant(3, 0.3));
}

}  // namespace
}  // namespace myotet::activation
