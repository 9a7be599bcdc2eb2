// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/NodeAlgebra.h"

#include <gtest/gtest.h>

#include "Core/Parallel.h"
#include "DynamicsShapes.h"

namespace myotet::dynamics {
namespace {

constexpr std::size_t kMany = 20000;  // more than one thread takes at once

TEST(Dot, AddsUpAllProducts) {
    const NodeVectors ones(kMany, Vec3::Ones()), twos(kMany, Vec3::Constant(2));
    EXPECT_EQ(dot(ones, twos), 6.0 * kMany);
    EXPECT_EQ(dot({}, {}), 0);
}

TEST(AddScaled, AddsEverywhere) {
    NodeVectors to(kMany, Vec3::Ones());
    add_scaled(-2, NodeVectors(kMany, Vec3(1, 2, 3)), to);
    EXPECT_EQ(to, NodeVectors(kMany, Vec3(-1, -3, -5)));
}

TEST(Dot, SameBytesOnOneThreadOrMany) {
    const NodeVectors a = test::random_vectors(kMany, 1, 1), b = test::random_vectors(kMany, 1, 2);
    const auto on = [&](int threads) {
        const ThreadLimit limit(threads);
        return dot(a, b);
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::dynamics
