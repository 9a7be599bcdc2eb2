// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Factor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Parallel.h"
#include "Dynamics/NodeAlgebra.h"
#include "HeldBlock.h"

namespace myotet::dynamics {
namespace {

using test::HeldBlock;
// The condition number, some thousands, times rounding.
constexpr double kExact = 1e-11;

TEST(Factor, SolvesExactly) {
    const HeldBlock block;
    Factor factor;
    EXPECT_FALSE(factor.ready());
    ASSERT_TRUE(factor.compute(block.K, block.held));
    EXPECT_TRUE(factor.ready());
    EXPECT_EQ(factor.shift(), 0);
    NodeVectors right = test::random_vectors(block.nodes(), 1, 1), z;
    factor.apply(right, z);
    ASSERT_EQ(z.size(), right.size());
    for (std::size_t n = 0; n < z.size(); ++n)
        if (block.held[n]) {
            EXPECT_EQ(z[n], Vec3(Vec3::Zero()));
        }
    EXPECT_LT(HeldBlock::miss(block.K, block.held, z, right),
              kExact * std::sqrt(dot(right, right)));
}

TEST(Factor, ServesOneMatrixAfterAnother) {
    const HeldBlock block;
    Factor factor;
    ASSERT_TRUE(factor.compute(block.K, block.held));
    const BlockMatrix stiffer = block.with_diagonal_times(1.5);
    ASSERT_TRUE(factor.compute(stiffer, block.held));
    const NodeVectors right = test::random_vectors(block.nodes(), 1, 1);
    NodeVectors z;
    factor.apply(right, z);
    EXPECT_LT(HeldBlock::miss(stiffer, block.held, z, right),
              kExact * std::sqrt(dot(right, right)));
}

TEST(Factor, ShiftsWhatIsNotPositiveUntilItIs) {
    const HeldBlock block;
    for (const double part : {0.99, 0.9}) {
        const BlockMatrix K = block.with_diagonal_times(part);
        Factor factor;
        ASSERT_TRUE(factor.compute(K, block.held));
        EXPECT_GT(factor.shift(), 0);
        EXPECT_LE(factor.shift(), 1);
        // It is the factor of K + s |diag(K)|.
        BlockMatrix shifted = K;
        for (std::int32_t n = 0; n < static_cast<std::int32_t>(block.nodes()); ++n) {
            Mat3& own = shifted.value[shifted.at(n, n)];
            own.diagonal() += factor.shift() * own.diagonal().cwiseAbs();
        }
        NodeVectors right = test::random_vectors(block.nodes(), 1, 1), z;
        factor.apply(right, z);
        EXPECT_LT(HeldBlock::miss(shifted, block.held, z, right), 1e-8 * std::sqrt(dot(z, z)));
        EXPECT_GT(dot(z, right), 0);  // so it is a preconditioner
    }
}

TEST(Factor, SaysWhenThereIsNone) {
    const HeldBlock block(2);
    BlockMatrix K = block.K;
    K.value[K.at(26, 26)].setConstant(std::nan(""));
    Factor factor;
    EXPECT_FALSE(factor.compute(K, block.held));
    EXPECT_FALSE(factor.ready());
    // ... nor where no shift is enough.
    EXPECT_FALSE(factor.compute(block.with_diagonal_times(0.1), block.held));
    EXPECT_FALSE(factor.ready());
    EXPECT_TRUE(factor.compute(block.K, block.held));  // and goes on afterwards
    EXPECT_TRUE(factor.ready());
    Factor nothing;
    EXPECT_FALSE(nothing.compute(block.K, std::vector<char>(block.nodes(), 1)));
}

TEST(Factor, TellsItsCostBeforehand) {
    const HeldBlock small(3), large(6);
    Factor one, another;
    const FactorCost cheap = one.analyze(small.K, small.held),
                     dear = another.analyze(large.K, large.held);
    EXPECT_FALSE(one.ready());
    EXPECT_GT(cheap.entries, 3.0 * 48);  // the diagonal at least
    EXPECT_GT(cheap.operations, cheap.entries);
    EXPECT_GT(dear.entries, 4 * cheap.entries);
    EXPECT_GT(dear.operations, 8 * cheap.operations);
    EXPECT_TRUE(one.compute(small.K, small.held));
}

TEST(Factor, SameBytesOnOneThreadOrMany) {
    const HeldBlock block(6);
    const NodeVectors right = test::random_vectors(block.nodes(), 1, 1);
    const auto on = [&](int threads) {
        const ThreadLimit limit(threads);
        Factor factor;
        EXPECT_TRUE(factor.compute(block.K, block.held));
        NodeVectors z;
        factor.apply(right, z);
        return z;
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::dynamics
