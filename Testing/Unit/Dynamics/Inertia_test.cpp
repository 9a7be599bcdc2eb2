// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Inertia.h"

#include <gtest/gtest.h>

#include "Dynamics/NodeAlgebra.h"
#include "DynamicsShapes.h"

namespace myotet::dynamics {
namespace {

TEST(Inertia, IsASpringForEachNode) {
    const NodeVectors from = test::random_vectors(3, 1, 1), way = test::random_vectors(3, 1, 2),
                      x = test::random_vectors(3, 1, 3);
    Inertia inertia({2, 3, 0});
    inertia.pull(5, from, way);
    EXPECT_EQ(inertia.move_to(from), 0);
    // A spring to where the way ends, but for a constant.
    const auto spring = [&](int n, double m) {
        return 2.5 * m * ((x[n] - from[n] - way[n]).squaredNorm() - way[n].squaredNorm());
    };
    const double energy = inertia.move_to(x);
    EXPECT_NEAR(energy, spring(0, 2) + spring(1, 3), 1e-13);
    EXPECT_EQ(inertia.energy(), energy);
    NodeVectors f(3, Vec3(1, 1, 1));
    inertia.add_forces(f);
    EXPECT_LT((f[1] - Vec3(1, 1, 1) + 15 * (x[1] - from[1] - way[1])).norm(), 1e-13);
    EXPECT_EQ(f[2], Vec3(1, 1, 1));  // of no mass
    BlockMatrix K = block_pattern(3, inertia.cliques());
    inertia.add_stiffness(K);
    EXPECT_EQ(K.value[0], Mat3(10 * Mat3::Identity()));
    EXPECT_EQ(K.value[1], Mat3(15 * Mat3::Identity()));
    EXPECT_EQ(K.value[2], Mat3(Mat3::Zero()));
    EXPECT_EQ(inertia.largest_step(x, way), 1);
}

}  // namespace
}  // namespace myotet::dynamics
