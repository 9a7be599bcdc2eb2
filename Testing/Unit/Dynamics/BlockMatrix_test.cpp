// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/BlockMatrix.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "DynamicsShapes.h"

namespace myotet::dynamics {
namespace {

BlockMatrix random_matrix(std::size_t nodes) {
    std::mt19937 random(3);
    std::uniform_int_distribution<std::int32_t> node(0, static_cast<std::int32_t>(nodes) - 1);
    Cliques cliques;
    for (std::size_t i = 0; i < 2 * nodes; ++i)
        cliques.add(std::array{node(random), node(random), node(random)});
    BlockMatrix K = block_pattern(nodes, cliques);
    std::uniform_real_distribution<double> entry(-1, 1);
    for (Mat3& block : K.value)
        for (int i = 0; i < 9; ++i) block.data()[i] = entry(random);
    return K;
}

TEST(BlockPattern, HasThePairsOfEachCliqueAndTheDiagonal) {
    Cliques cliques;
    cliques.add(std::array<std::int32_t, 3>{4, 0, 2});
    cliques.add(std::array<std::int32_t, 2>{2, 4});
    const BlockMatrix K = block_pattern(5, cliques);
    const std::vector<std::size_t> starts = {0, 3, 4, 7, 8, 11};
    const std::vector<std::int32_t> columns = {0, 2, 4, 1, 0, 2, 4, 3, 0, 2, 4};
    EXPECT_EQ(K.row_start, starts);
    EXPECT_EQ(K.column, columns);
    EXPECT_EQ(K.at(4, 2), 9u);
    EXPECT_THROW((void)K.at(1, 2), LogicError);
}

TEST(Multiply, IsThatOfTheDenseMatrix) {
    constexpr std::size_t nodes = 40;
    const BlockMatrix K = random_matrix(nodes);
    const NodeVectors x = test::random_vectors(nodes, 1, 5), y = multiply(K, x);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes);
    Eigen::VectorXd flat(3 * nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
        flat.segment<3>(3 * n) = x[n];
        for (std::size_t i = K.row_start[n]; i < K.row_start[n + 1]; ++i)
            dense.block<3, 3>(3 * n, 3 * K.column[i]) = K.value[i];
    }
    const Eigen::VectorXd product = dense * flat;
    for (std::size_t n = 0; n < nodes; ++n)
        EXPECT_LT((y[n] - product.segment<3>(3 * n)).norm(), 1e-13);
}

TEST(Multiply, SameBytesOnOneThreadOrMany) {
    const BlockMatrix K = random_matrix(3000);
    const NodeVectors x = test::random_vectors(3000, 1, 5);
    const auto on = [&](int threads) {
        const ThreadLimit limit(threads);
        return multiply(K, x);
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::dynamics
