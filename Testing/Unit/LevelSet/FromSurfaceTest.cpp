// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "LevelSet/FromSurface.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

SilentProgress silent;

LevelSet sphere_level_set(double radius, double spacing) {
    return from_surface(test::sphere_surface({1, 2, 3}, radius, 160), {.spacing = spacing}, silent);
}

TEST(FromSurface, sphere_is_exact_near_its_surface) {
    const double radius = 10;
    const LevelSet phi = sphere_level_set(radius, 0.5);
    // The polyhedron lies up to its sagitta inside; trilinear interpolation of
    // a distance errs by about spacing^2 / (4 radius).
    const double tolerance = 0.5 * 0.5 / (4 * radius) + 0.009;
    double worst = 0, worst_slope = 0;
    for (const Vec3& u : test::directions(400))
        for (const double d : {-1.2, -0.7, 0.0, 0.3, 1.1}) {
            const Vec3 p = Vec3(1, 2, 3) + (radius + d) * u;
            const Sample s = phi.sample(p);
            worst = std::max(worst, std::abs(s.value - d));
            worst_slope = std::max(worst_slope, (s.gradient - u).norm());
        }
    EXPECT_LT(worst, tolerance);
    // Slopes of a trilinear interpolant err by about spacing / radius.
    EXPECT_LT(worst_slope, 0.1);
}

TEST(FromSurface, error_at_the_surface_falls_with_the_square_of_the_spacing) {
    // Against the torus itself, its polyhedron being ten times finer.
    const auto error = [](double spacing) {
        const TriMesh surface = test::torus_surface(10, 4, 300, 150);
        const LevelSet phi = from_surface(surface, {.spacing = spacing}, silent);
        double sum = 0;
        int count = 0;
        for (int i = 0; i < 60; ++i)
            for (int j = 0; j < 30; ++j, ++count) {
                const double value =
                    phi.value(test::torus_point(10, 4, 0.1 + i * 0.1047, j * 0.2094));
                sum += value * value;
            }
        return std::sqrt(sum / count);
    };
    const double coarse = error(0.8), fine = error(0.4);
    EXPECT_GT(coarse / fine, 3.0) << coarse << " " << fine;  // 4 in the limit
}

TEST(FromSurface, values_deep_inside_are_within_three_percent) {
    const double radius = 10;
    const LevelSet phi = sphere_level_set(radius, 0.25);
    for (const Vec3& u : test::directions(200))
        for (const double depth : {2.0, 4.0, 6.0, 8.0}) {
            const double value = phi.value(Vec3(1, 2, 3) + (radius - depth) * u);
            EXPECT_NEAR(value, -depth, 0.03 * depth) << "depth " << depth;
        }
    // The cone's tip lies between coarse samples.
    EXPECT_NEAR(phi.value({1, 2, 3}), -radius, 0.5 * std::sqrt(3.0) * phi.coarse_spacing);
}

TEST(FromSurface, bricks_and_coarse_field_join_without_a_jump) {
    const LevelSet phi = sphere_level_set(10, 0.4);
    // Along a line, steps of a hundredth of the spacing change phi by no more
    // than the slope allows.
    const double step = 0.004;
    double last = phi.value(Vec3(-14, 2.3, 3.1));
    for (double x = -14 + step; x < 14; x += step) {
        const double now = phi.value(Vec3(x, 2.3, 3.1));
        EXPECT_LT(std::abs(now - last), 2 * step) << "x " << x;
        last = now;
    }
}

TEST(FromSurface, same_bytes_for_any_number_of_threads) {
    const auto make = [](int threads) {
        const ThreadLimit limit(threads);
        return from_surface(test::torus_surface(10, 4, 120, 60), {.spacing = 0.4}, silent);
    };
    const LevelSet one = make(1), two = make(2);
    EXPECT_EQ(one.brick_of, two.brick_of);
    EXPECT_EQ(one.values, two.values);
    EXPECT_EQ(one.coarse_values, two.coarse_values);
}

TEST(FromSurface, open_surface_is_refused_with_the_place) {
    TriMesh surface = test::sphere_surface(Vec3::Zero(), 5, 20);
    surface.triangles.pop_back();
    try {
        (void)from_surface(surface, {.spacing = 0.5}, silent);
        FAIL() << "an open surface was accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("3 edges"));
        EXPECT_THAT(error.what(), testing::HasSubstr("at ("));
    }
}

TEST(FromSurface, empty_surface_and_bad_options_are_refused) {
    const TriMesh surface = test::sphere_surface(Vec3::Zero(), 5, 20);
    EXPECT_THROW((void)from_surface({}, {.spacing = 1}, silent), InputError);
    EXPECT_THROW((void)from_surface(surface, {.spacing = 0}, silent), InputError);
    EXPECT_THROW((void)from_surface(surface, {.spacing = std::nan("")}, silent), InputError);
    EXPECT_THROW((void)from_surface(surface, {.spacing = 1e-4}, silent), ResourceError);
}

}  // namespace
}  // namespace myotet::levelset
