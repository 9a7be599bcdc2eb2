// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Nearest.h"

#include <gtest/gtest.h>

#include <random>

using namespace myotet;
using namespace myotet::membrane;

TEST(Nearest, IsNearerThanAnySampleOfTheTriangle) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> part(-1, 1);
    const auto point = [&] { return Vec3(part(random), part(random), part(random)); };
    for (int trial = 0; trial < 300; ++trial) {
        const Vec3 a = point(), b = point(), c = point(), to = 2 * point();
        const auto [nearest, weights] = nearest_of(a, b, c, to);
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
        EXPECT_LE((nearest - to).norm(), least + 1e-12);
        EXPECT_GT((nearest - to).norm(), least - 4.0 / kSteps);
    }
}
