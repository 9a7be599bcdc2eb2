// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "BandShapes.h"
#include "LevelSet/Measure.h"

namespace myotet::levelset {
namespace {

TEST(Measure, plane_through_a_cell_cuts_its_true_part) {
    // A linear function is linear in every tetrahedron: exact up to rounding.
    std::array<float, 8> corner;
    const auto fill = [&](const Vec3& n, double d) {
        for (int c = 0; c < 8; ++c)
            corner[c] = static_cast<float>(n.dot(Vec3(c & 1, c >> 1 & 1, c >> 2)) - d);
        return inside_fraction(corner);
    };
    EXPECT_NEAR(fill({1, 0, 0}, 0.3), 0.3, 1e-6);
    EXPECT_NEAR(fill({0, 0, -1}, -0.3), 0.7, 1e-6);
    EXPECT_NEAR(fill({1, 1, 0}, 0.5), 0.125, 1e-6);
    EXPECT_NEAR(fill({1, 1, 1}, 1.0), 1.0 / 6, 1e-6);
    EXPECT_NEAR(fill({1, 1, 1}, 1.5), 0.5, 1e-6);
    EXPECT_NEAR(fill({1, 1, 1}, 3.5), 1, 1e-6);
    EXPECT_NEAR(fill({1, 1, 1}, -0.5), 0, 1e-6);
}

TEST(Measure, inside_and_outside_make_the_whole) {
    std::array<float, 8> corner{-1, 2, 0.5f, -0.25f, 3, -2, 1, -0.5f}, opposite;
    for (int c = 0; c < 8; ++c) opposite[c] = -corner[c];
    EXPECT_NEAR(inside_fraction(corner) + inside_fraction(opposite), 1, 1e-6);
}

TEST(Measure, error_of_a_sphere_s_volume_falls_with_the_square_of_the_spacing) {
    const double radius = 10, volume = 4.0 / 3 * std::numbers::pi * 1000;
    const auto error = [&](double spacing, int blocks) {
        const Band band =
            test::make_band(test::sphere_field({16.3, 15.8, 16.1}, radius), blocks, spacing);
        return std::abs(enclosed_volume(assemble(band)) / volume - 1);
    };
    const double coarse = error(1, 4), fine = error(0.5, 8);
    EXPECT_LT(coarse, 0.01);
    EXPECT_GT(coarse / fine, 3.5);  // 4 in the limit
}

TEST(Measure, deepest_sample_of_a_box_is_half_its_side) {
    const auto box = [](const Vec3& p) {
        return (p - Vec3(24, 24, 24)).cwiseAbs().maxCoeff() - 14;
    };
    const Band band = test::make_band(box, 6, 1);
    // The ridge is met by a sample, whose foot is exact on a flat face.
    EXPECT_NEAR(inscribed_radius(assemble(band)), 14, 0.2);
}

}  // namespace
}  // namespace myotet::levelset
