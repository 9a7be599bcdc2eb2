// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "BandShapes.h"
#include "LevelSet/LevelSet.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

const Vec3 kCentre(16.2, 15.9, 16.4);

TEST(LevelSet, interpolates_a_linear_field_exactly) {
    const Vec3 normal = Vec3(1, -2, 3).normalized();
    const auto plane = [&](const Vec3& p) { return (p - Vec3(16, 16, 16)).dot(normal); };
    const LevelSet phi = assemble(test::make_band(plane, 4, 1));
    for (const Vec3& u : test::directions(50)) {
        const Vec3 p = Vec3(16, 16, 16) + 1.2 * u;
        const Sample s = phi.sample(p);
        EXPECT_NEAR(s.value, plane(p), 1e-5);
        EXPECT_LT((s.gradient - normal).norm(), 1e-5);
    }
}

TEST(LevelSet, gradient_is_that_of_the_value) {
    const LevelSet phi = assemble(test::make_band(test::sphere_field(kCentre, 9), 4, 1));
    const double step = 1e-4;
    for (const Vec3& u : test::directions(40)) {
        const Vec3 p = kCentre + 8.7 * u;
        Vec3 slope;
        for (int a = 0; a < 3; ++a)
            slope[a] = (phi.value(p + step * Vec3::Unit(a)) - phi.value(p - step * Vec3::Unit(a))) /
                       (2 * step);
        // Values are floats: their rounding over twice the step.
        EXPECT_LT((phi.sample(p).gradient - slope).norm(), 0.02);
    }
}

TEST(LevelSet, outside_the_box_the_distance_to_it_is_added) {
    const LevelSet phi = assemble(test::make_band(test::sphere_field(kCentre, 9), 4, 1));
    const Vec3 edge(32, 16, 16);
    EXPECT_NEAR(phi.value(edge + Vec3(5, 0, 0)), phi.value(edge) + 5, 1e-9);
    EXPECT_LT((phi.sample(edge + Vec3(5, 0, 0)).gradient - Vec3::UnitX()).norm(), 1e-9);
}

TEST(LevelSet, principal_curvatures_of_sphere_and_cylinder) {
    const double tolerance = 0.02;  // 1/mm; second differences of float distances
    const LevelSet sphere = assemble(test::make_band(test::sphere_field(kCentre, 8), 4, 1));
    const auto bar = [](const Vec3& p) { return std::hypot(p.y() - 16, p.z() - 16) - 8; };
    const LevelSet cylinder = assemble(test::make_band(bar, 4, 1));
    const auto k = principal_curvatures(sphere, kCentre + 8 * Vec3(1, 1, 1).normalized(), 2);
    EXPECT_NEAR(k[0], 1.0 / 8, tolerance);
    EXPECT_NEAR(k[1], 1.0 / 8, tolerance);
    const auto c = principal_curvatures(cylinder, {16, 24, 16}, 2);
    EXPECT_NEAR(c[0], 1.0 / 8, tolerance);
    EXPECT_NEAR(c[1], 0, tolerance);
}

}  // namespace
}  // namespace myotet::levelset
