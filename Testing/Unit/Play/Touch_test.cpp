// SPDX-License-Identifier: Apache-2.0
#include "Play/Touch.h"

#include <gtest/gtest.h>

#include "Support/PlayShapes.h"

namespace myotet::play {
namespace {

using dynamics::NodeVectors;

constexpr double kSlip = 0.01;

// A point between three nodes against a triangle of three others.
Touch six_nodes() {
    Touch touch;
    for (int i = 0; i < 3; ++i) touch.add(i, 1.0 / 3);
    touch.add(3, -0.2);
    touch.add(4, -0.3);
    touch.add(5, -0.5);
    touch.normal = Vec3(1, 2, 3).normalized();
    touch.gap = 2;
    touch.stiffness = 0.7;
    touch.friction = 0.4;
    touch.start = {0.1, -0.2, 0.3};
    return touch;
}

double energy(std::vector<Touch>& touches, const NodeVectors& x) { return move_to(touches, x); }

TEST(Touch, forces_are_minus_the_gradient_and_the_product_its_derivative) {
    std::vector<Touch> touches{six_nodes()};
    const NodeVectors x = test::shaken(NodeVectors(6, Vec3::Zero()), 0.5, 2);
    (void)energy(touches, x);
    lag_friction(touches, kSlip);
    ASSERT_GT(touches[0].press, 0);
    ASSERT_GT(touches[0].drag, 0);
    (void)energy(touches, x);
    NodeVectors f(6, Vec3::Zero()), Kd(6, Vec3::Zero());
    add_forces(touches, f);
    const NodeVectors d = test::shaken(NodeVectors(6, Vec3::Zero()), 1, 9);
    add_product(touches, d, Kd);
    constexpr double h = 1e-5;
    for (int n = 0; n < 6; ++n)
        for (int a = 0; a < 3; ++a) {
            NodeVectors low = x, high = x;
            low[n][a] -= h;
            high[n][a] += h;
            const double slope = (energy(touches, high) - energy(touches, low)) / (2 * h);
            EXPECT_NEAR(f[n][a], -slope, 1e-9);
        }
    NodeVectors ahead = x, back = x, g(6, Vec3::Zero()), b(6, Vec3::Zero());
    for (int n = 0; n < 6; ++n) {
        ahead[n] += h * d[n];
        back[n] -= h * d[n];
    }
    (void)energy(touches, ahead);
    add_forces(touches, g);
    (void)energy(touches, back);
    add_forces(touches, b);
    for (int n = 0; n < 6; ++n) EXPECT_LT(((b[n] - g[n]) / (2 * h) - Kd[n]).norm(), 1e-9);
}

TEST(Touch, neither_force_nor_product_is_left_over) {
    std::vector<Touch> touches{six_nodes()};
    const NodeVectors x = test::shaken(NodeVectors(6, Vec3::Zero()), 0.5, 4);
    (void)energy(touches, x);
    lag_friction(touches, kSlip);
    NodeVectors f(6, Vec3::Zero()), Kd(6, Vec3::Zero());
    add_forces(touches, f);
    add_product(touches, x, Kd);
    Vec3 force = Vec3::Zero(), product = Vec3::Zero();
    for (int n = 0; n < 6; ++n) {
        force += f[n];
        product += Kd[n];
    }
    EXPECT_LT(force.norm(), 1e-14);
    EXPECT_LT(product.norm(), 1e-14);
}

TEST(Touch, friction_opposes_sliding_by_no_more_than_coulomb_says) {
    for (const double by : {1e-4, 1e-2, 1.0}) {
        Touch touch;
        touch.add(0, 1);
        touch.gap = 1;
        touch.stiffness = 2;
        touch.friction = 0.5;
        std::vector<Touch> touches{touch};
        const NodeVectors x{{by, 0, 0.25}};
        (void)energy(touches, x);
        lag_friction(touches, kSlip);
        NodeVectors f(1, Vec3::Zero());
        add_forces(touches, f);
        const double press = 2 * 0.75;
        EXPECT_NEAR(f[0].z(), press, 1e-14);
        EXPECT_NEAR(f[0].x(), -0.5 * press * std::min(1.0, by / kSlip), 1e-14) << by;
    }
}

TEST(Touch, what_is_apart_feels_nothing) {
    Touch touch = six_nodes();
    touch.offset = -10;
    std::vector<Touch> touches{touch};
    const NodeVectors x = test::shaken(NodeVectors(6, Vec3::Zero()), 0.5, 4);
    EXPECT_EQ(energy(touches, x), 0);
    lag_friction(touches, kSlip);
    NodeVectors f(6, Vec3::Zero());
    add_forces(touches, f);
    for (const Vec3& force : f) EXPECT_EQ(force, Vec3(Vec3::Zero()));
}

TEST(Touch, the_diagonal_is_that_of_the_product) {
    std::vector<Touch> touches{six_nodes()};
    const NodeVectors x = test::shaken(NodeVectors(6, Vec3::Zero()), 0.5, 4);
    (void)energy(touches, x);
    lag_friction(touches, kSlip);
    std::vector<Mat3> diagonal(6, Mat3::Zero());
    add_diagonal(touches, diagonal);
    for (int n = 0; n < 6; ++n)
        for (int a = 0; a < 3; ++a) {
            NodeVectors unit(6, Vec3::Zero()), product = unit;
            unit[n] = Vec3::Unit(a);
            add_product(touches, unit, product);
            EXPECT_LT((product[n] - diagonal[n].col(a)).norm(), 1e-14);
        }
}

}  // namespace
}  // namespace myotet::play
