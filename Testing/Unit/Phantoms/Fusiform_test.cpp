// SPDX-License-Identifier: Apache-2.0
#include "Phantoms/Fusiform.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "Phantoms/Phantoms.h"

namespace myotet::phantoms {
namespace {

// The midpoint rule on a smooth periodic profile; the tendons are exact.
constexpr double kQuadrature = 1e-9;
// Fourth-order steps of 0.1 mm along a fibre.
constexpr double kStreamline = 1e-6;
// Central differences of a distance that is exact to about 1e-9 mm.
constexpr double kDifference = 1e-4;

Vec3 gradient(double (*distance)(const Vec3&), const Vec3& p) {
    constexpr double kStep = 1e-3;
    Vec3 g;
    for (int a = 0; a < 3; ++a) {
        const Vec3 step = kStep * Vec3::Unit(a);
        g[a] = (distance(p + step) - distance(p - step)) / (2 * kStep);
    }
    return g;
}

TEST(Fusiform, VolumesAreTheIntegralsOfItsSections) {
    constexpr int kSlices = 6000;
    double belly = 0, tendon = 0;
    for (int n = 0; n < kSlices; ++n) {
        const double z = (n + 0.5) * kFusiformLength / kSlices, r = fusiform_radius(z);
        const bool in_belly = z > kFusiformTendon && z < kFusiformLength - kFusiformTendon;
        (in_belly ? belly : tendon) += std::numbers::pi * r * r * kFusiformLength / kSlices;
    }
    EXPECT_NEAR(belly / fusiform_belly_volume(), 1, kQuadrature);
    EXPECT_NEAR(tendon / fusiform_tendon_volume(), 1, kQuadrature);
}

TEST(Fusiform, FibresKeepTheirShareOfTheRadius) {
    constexpr double kStep = 0.1;
    Vec3 p(3, 2, 1);
    const double share = p.head<2>().norm() / fusiform_radius(p.z());
    while (p.z() < kFusiformLength - 1) {
        const Vec3 a = fusiform_fibre(p), b = fusiform_fibre(p + 0.5 * kStep * a);
        const Vec3 c = fusiform_fibre(p + 0.5 * kStep * b), d = fusiform_fibre(p + kStep * c);
        p += kStep / 6 * (a + 2 * b + 2 * c + d);
        EXPECT_NEAR(p.head<2>().norm() / fusiform_radius(p.z()), share, kStreamline);
        EXPECT_NEAR(fusiform_fibre(p).norm(), 1, 1e-15);
    }
}

TEST(Fusiform, FibresLieInItsSurface) {
    for (double z = 21; z < 79; z += 0.7) {
        const double r = fusiform_radius(z);
        const Vec3 p(r * std::cos(z), r * std::sin(z), z);
        EXPECT_NEAR(fusiform_belly_distance(p), 0, 1e-9);
        EXPECT_NEAR(fusiform_fibre(p).dot(gradient(fusiform_belly_distance, p)), 0, kDifference);
    }
}

TEST(Fusiform, DistancesAreSignedDistances) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> across(-14, 14), along(-5, 105);
    int tried = 0;
    for (const auto distance : {fusiform_belly_distance, fusiform_tendon_distance})
        for (int n = 0; n < 400; ++n) {
            const Vec3 p(across(random), across(random), along(random));
            const Vec3 g = gradient(distance, p);
            if (std::abs(g.norm() - 1) > 0.01) continue;  // near the medial axis
            ++tried;
            EXPECT_NEAR(distance(p - distance(p) * g), 0, 10 * kDifference);
        }
    EXPECT_GT(tried, 700);
}

TEST(Fusiform, FibresMoveWithTheBody) {
    PhantomOptions options;
    options.translation = Vec3(5, -4, 30);
    options.spacing = Vec3(4, 4, 4);
    const Phantom moved = make_phantom("fusiform", options);
    ASSERT_EQ(moved.fibre.size(), 2u);
    const Vec3 p(4, 3, 35);
    for (const auto& [label, fibre] : moved.fibre)
        EXPECT_EQ(fibre(p + options.translation), fusiform_fibre(p));
}

}  // namespace
}  // namespace myotet::phantoms
