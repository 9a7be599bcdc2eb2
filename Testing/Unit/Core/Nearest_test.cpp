// SPDX-License-Identifier: Apache-2.0
#include "Core/Nearest.h"

#include <gtest/gtest.h>

#include <random>

using namespace myotet;

TEST(Nearest, IsNearerThanAnySampleOfTheTriangle) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> part(-1, 1);
    const auto point = [&] { return Vec3(part(random), part(random), part(random)); };
    for (int trial = 0; trial < 300; ++trial) {
        const Vec3 a = point(), b = point(), c = point(), to = 2 * point();
        const auto [nearest, weights] = nearest_on_triangle(to, a, b, c);
        EXPECT_LT((weights[0] * a + weights[1] * b + weights[2] * c - nearest).norm(), 1e-12);
        for (const double weight : weights) EXPECT_GE(weight, -1e-12);
        const Vec3 n = (b - a).cross(c - a).normalized();
        EXPECT_NEAR(n.dot(nearest - a), 0, 1e-12);
        double least = 1e9;
        constexpr int kSteps = 40;
        for (int i = 0; i <= kSteps; ++i)
            for (int j = 0; i + j <= kSteps; ++j) {
                const double u = 1.0 * i / kSteps, v = 1.0 * j / kSteps;
                least = std::min(least, (a + u * (b - a) + v * (c - a) - to).norm());
            }
        // It is of the triangle: no area is added; and every direction into it leads away.
        const auto area = [](const Vec3& u, const Vec3& v, const Vec3& w) {
            return (v - u).cross(w - u).norm();
        };
        EXPECT_NEAR(area(nearest, b, c) + area(a, nearest, c) + area(a, b, nearest), area(a, b, c),
                    1e-12);
        for (const Vec3& corner : {a, b, c}) EXPECT_LE((corner - nearest).dot(to - nearest), 1e-12);
        EXPECT_LE((nearest - to).norm(), least + 1e-12);
        EXPECT_GT((nearest - to).norm(), least - 4.0 / kSteps);
    }
}

TEST(Nearest, WeightsAreExactlyZeroOnEdgesAndAtCorners) {
    const Vec3 a(0.1, 0.2, 0.3), b(1.7, 0.1, 0.4), c(0.3, 1.9, 0.2);
    using Weights = std::array<double, 3>;
    const auto weights = [&](const Vec3& p) { return nearest_on_triangle(p, a, b, c).weights; };
    EXPECT_EQ(weights(a - Vec3(1, 1, 0)), (Weights{1, 0, 0}));
    EXPECT_EQ(weights(b + Vec3(3, -1, 0)), (Weights{0, 1, 0}));
    EXPECT_EQ(weights(c + Vec3(-1, 3, 0)), (Weights{0, 0, 1}));
    EXPECT_EQ(weights(0.5 * (a + b) - Vec3(0, 1, 0))[2], 0);
    EXPECT_EQ(weights(0.5 * (a + c) - Vec3(1, 0, 0))[1], 0);
    EXPECT_EQ(weights(0.5 * (b + c) + Vec3(1, 1, 0))[0], 0);
    EXPECT_EQ(nearest_on_triangle(b + Vec3(3, -1, 0), a, b, c).point, b);
}

TEST(Nearest, OfATriangleWithoutAreaIsOneOfItsPoints) {
    const Vec3 a(1, 2, 3), p(4, 4, 4);
    EXPECT_EQ(nearest_on_triangle(p, a, a, a).point, a);
    const Vec3 on = nearest_on_triangle(p, a, Vec3(2, 2, 3), Vec3(9, 2, 3)).point;
    EXPECT_EQ(on.y(), 2);
    EXPECT_EQ(on.z(), 3);
    EXPECT_TRUE(on.x() >= 1 && on.x() <= 9);
}
