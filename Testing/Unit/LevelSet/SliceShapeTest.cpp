// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "LabelShapes.h"
#include "LevelSet/SliceShape.h"

namespace myotet::levelset {
namespace {

constexpr double kThickness = 5;

SliceShape shape_of(const LabelVolume& volume, const Vec3& spacing) {
    const RegionMap map = map_regions(volume, std::vector<std::int32_t>{1});
    return slice_shape(map, 1, 2, spacing);
}

SliceShape shape_of(const std::function<bool(const Vec3&)>& inside, int slices) {
    const Vec3 spacing(1, 1, kThickness);
    return shape_of(test::sample_volume({60, 40, slices}, spacing,
                                        [&](const Vec3& p) { return inside(p) ? 1 : 0; }),
                    spacing);
}

// Height at which the shape ends above (x, y), in slices.
double top(const SliceShape& shape, double x, double y, double from, double to) {
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (from + to);
        (shape.value({x, y, middle}) < 0 ? from : to) = middle;
    }
    return from;
}

TEST(SliceShape, thick_slices_are_those_above_twice_the_pixels) {
    EXPECT_EQ(thick_axis({1, 1, 4}), 2);
    EXPECT_EQ(thick_axis({5, 0.5, 1}), 0);
    EXPECT_EQ(thick_axis({1, 1, 3.6}), -1);
    EXPECT_EQ(thick_axis({0.4, 1, 1}), -1);
    EXPECT_DOUBLE_EQ(larger_pixel_side({0.4, 5, 0.6}, 1), 0.6);
}

TEST(SliceShape, a_cone_is_straight_between_slices) {
    // Radius from 14 at the lowest slice by 1.5 a slice.
    const auto radius = [](double slice) { return 15.3 - 1.5 * slice; };
    const SliceShape shape = shape_of(
        [&](const Vec3& p) {
            return (p - Vec3(20, 20, p.z())).norm() < radius(p.z() / kThickness);
        },
        8);
    for (double slice = 1; slice < 6; slice += 0.125)
        for (const double angle : {0.1, 1.3, 2.9, 4.4}) {
            const double r = radius(slice);
            // Pixels tell a circle to a quarter of a pixel or so.
            EXPECT_NEAR(shape.value({20 + r * std::cos(angle), 20 + r * std::sin(angle), slice}), 0,
                        0.4);
        }
}

TEST(SliceShape, pixel_centres_keep_their_side) {
    const SliceShape shape = shape_of(
        [](const Vec3& p) {
            return (p - Vec3(25, 20, 24)).cwiseQuotient(Vec3(18, 9, 20)).norm() < 1;
        },
        11);
    for (int k = 0; k < 11; ++k)
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 60; ++i) {
                const Vec3 off(i - 25, j - 20, k * kThickness - 24);
                EXPECT_EQ(shape.value(Vec3(i, j, k)) < 0,
                          off.cwiseQuotient(Vec3(18, 9, 20)).norm() < 1);
            }
}

TEST(SliceShape, a_slanted_tube_stays_one_tube) {
    // Moves by 5 pixels a slice, its radius being 4: sections share a third.
    const SliceShape shape = shape_of(
        [](const Vec3& p) {
            const double x = 8.2 + p.z();
            return (Vec3(p.x() - x, p.y() - 20.3, 0)).norm() < 4;
        },
        9);
    for (double slice = 1; slice < 7; slice += 0.125) {
        const double x = 8.2 + kThickness * slice;
        EXPECT_LT(shape.value({x, 20.3, slice}), -2.5) << slice;
        for (const double side : {-4.0, 4.0}) {
            EXPECT_NEAR(shape.value({x + side, 20.3, slice}), 0, 0.5) << slice;
            EXPECT_NEAR(shape.value({x, 20.3 + side, slice}), 0, 0.5) << slice;
        }
    }
}

TEST(SliceShape, caps_follow_an_ellipsoid_to_its_pole) {
    // In slices: half axis 8, centre at 10.3; the last slice inside is 18.
    const auto squared = [](double slice) { return 1 - std::pow((slice - 10.3) / 8, 2); };
    const SliceCap cap = cap_of(squared(18), squared(17), squared(16));
    EXPECT_NEAR(18 + cap.end(), 18.3, 0.01);
    EXPECT_NEAR(1 - cap.shrunk(0.15), std::sqrt(squared(18.15) / squared(18)), 0.03);
}

TEST(SliceShape, a_blunt_end_takes_half_a_slice_of_volume) {
    const SliceCap cap = cap_of(1, 1, 1);
    double volume = 0;
    constexpr int kSteps = 10000;
    for (int n = 0; n < kSteps; ++n)
        volume += std::pow(1 - cap.shrunk((n + 0.5) / kSteps), 2) / kSteps;
    EXPECT_NEAR(volume, 0.5, 1e-3);
    EXPECT_NEAR(cap.end(), 0.75, 1e-9);
    // However sudden, the end is never at the section itself nor beyond the next slice.
    for (const double before : {0.0, 0.5, 1.0, 1.5, 2.0, 5.0, 1e6}) {
        EXPECT_LE(cap_of(1, before, 0).end(), 1 + 1e-12);
        EXPECT_GT(cap_of(1, before, 0).end(), 0);
    }
}

TEST(SliceShape, what_the_scan_cuts_ends_flat_half_a_slice_on) {
    const SliceShape shape =
        shape_of([](const Vec3& p) { return (p - Vec3(30, 20, p.z())).norm() < 10; }, 6);
    for (const double x : {22.0, 30.0, 37.0}) EXPECT_NEAR(top(shape, x, 20, 5, 6), 5.5, 1e-6);
}

TEST(SliceShape, a_branch_that_ends_does_not_end_its_neighbour) {
    const SliceShape shape = shape_of(
        [](const Vec3& p) {
            const bool left = (p - Vec3(15, 20, p.z())).norm() < 7;
            const bool right = (p - Vec3(40, 20, p.z())).norm() < 7;
            const bool bridge = std::abs(p.y() - 20) < 3 && p.x() > 15 && p.x() < 40;
            return p.z() < 12 ? left || right || bridge : p.z() < 22 ? left || right : left;
        },
        8);
    EXPECT_LT(shape.value({15, 20, 5.5}), -5);
    EXPECT_GT(top(shape, 40, 20, 4, 5), 4.5);
    EXPECT_GT(shape.value({40, 20, 5.2}), 0);
}

}  // namespace
}  // namespace myotet::levelset
