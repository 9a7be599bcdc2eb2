// SPDX-License-Identifier: Apache-2.0
#include "Activation/BlockBand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rounding of sums of some 20 numbers of size 1.
constexpr double kRounding = 1e-11;
constexpr Index kBlocks = 7, kSize = 3, kBelow = 2;

MatrixXd dense(const BlockBand& band) {
    MatrixXd all = MatrixXd::Zero(band.rows(), band.rows());
    for (Index j = 0; j < band.blocks(); ++j)
        for (Index k = j; k <= std::min(j + band.below(), band.blocks() - 1); ++k) {
            all.block(k * kSize, j * kSize, kSize, kSize) = band.at(k, j);
            all.block(j * kSize, k * kSize, kSize, kSize) = band.at(k, j).transpose();
        }
    return all;
}

BlockBand random_band(double diagonal) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> both(-1, 1);
    BlockBand band(kBlocks, kSize, kBelow);
    for (Index j = 0; j < kBlocks; ++j)
        for (Index k = j; k <= std::min(j + kBelow, kBlocks - 1); ++k) {
            for (double& x : band.at(k, j).reshaped()) x = both(random);
            if (k == j) band.at(j, j) += band.at(j, j).transpose().eval();
        }
    band.add_diagonal(VectorXd::Constant(band.rows(), diagonal));
    return band;
}

TEST(BlockBand, SolvesAsTheDenseMatrixDoes) {
    BlockBand band = random_band(10);
    const MatrixXd all = dense(band);
    EXPECT_EQ(band.diagonal(), all.diagonal());
    const VectorXd x = VectorXd::LinSpaced(band.rows(), -1, 2);
    ASSERT_TRUE(band.factor());
    EXPECT_LE((band.solve(all * x) - x).cwiseAbs().maxCoeff(), kRounding);
}

TEST(BlockBand, HeldUnknownsStay) {
    BlockBand band = random_band(10);
    std::vector<char> held(static_cast<std::size_t>(band.rows()), 0);
    held[2] = held[9] = held[10] = 1;
    const MatrixXd all = dense(band);
    band.hold(held);
    VectorXd right = VectorXd::LinSpaced(band.rows(), -1, 2);
    right[2] = right[9] = right[10] = 0;
    ASSERT_TRUE(band.factor());
    const VectorXd x = band.solve(right), wrong = all * x - right;
    for (Index i = 0; i < x.size(); ++i) {
        if (held[static_cast<std::size_t>(i)])
            EXPECT_EQ(x[i], 0);
        else
            EXPECT_NEAR(wrong[i], 0, kRounding);
    }
}

TEST(BlockBand, TellsThatItIsNotPositive) {
    EXPECT_FALSE(random_band(0).factor());
    EXPECT_TRUE(random_band(10).factor());
}

}  // namespace
}  // namespace myotet::activation
