// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "CsgShapes.h"
#include "LevelSet/CsgMeasure.h"

namespace myotet::levelset {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(CsgMeasure, volume_of_a_ball) {
    EXPECT_NEAR(enclosed_volume(test::ball(Vec3(3, 4, 5), 10)), test::ball_volume(10),
                test::ball_tolerance(10));
}

TEST(CsgMeasure, volume_beyond_is_zero_for_itself) {
    const Band a = test::ball(Vec3(3, 4, 5), 10);
    EXPECT_EQ(volume_beyond(a, a), 0);
    const Band far = test::ball(Vec3(100, 4, 5), 10);
    EXPECT_EQ(volume_beyond(a, far), enclosed_volume(a));
}

TEST(CsgMeasure, principal_axes_of_a_turned_ellipsoid) {
    const Mat3 turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()));
    const Vec3 centre(11.3, -4.1, 6.2), semi(14, 9, 6);
    Box box;
    box.include(centre - Vec3::Constant(14));
    box.include(centre + Vec3::Constant(14));
    const Band band = sample_solid(
        [&](const Vec3& p) { return ellipsoid_distance(turn.transpose() * (p - centre), semi); },
        box, test::kLattice);
    const PrincipalAxes found = principal_axes(band);
    // Samples at the surface count by linear parts: a hundredth of a sample.
    EXPECT_LT((found.centroid - centre).norm(), 0.02);
    for (int a = 0; a < 3; ++a) {
        EXPECT_GT(std::abs(found.axes.col(a).dot(turn.col(a))), 0.9999);
        // An ellipsoid's standard deviation is semi / sqrt(5).
        EXPECT_NEAR(found.deviation[a], semi[a] / std::sqrt(5.0), 0.01 * semi[a]);
    }
    EXPECT_NEAR(found.axes.determinant(), 1, 1e-9);
}

TEST(CsgMeasure, contact_of_a_ball_and_what_it_lies_in) {
    const Band inner = test::ball(Vec3(20, 20, 20), 10);
    const Band shell = subtract(test::ball(Vec3(20, 20, 20), 15), inner);
    const Contact touch = contact(inner, shell);
    EXPECT_NEAR(touch.area, 4 * kPi * 100, 0.02 * 4 * kPi * 100);
    EXPECT_LT((touch.centre - Vec3(20, 20, 20)).norm(), 0.1);
    EXPECT_NEAR(contact(shell, inner).area, touch.area, 1e-6 * touch.area);  // another order
}

TEST(CsgMeasure, contact_of_walls_along_and_across_the_lattice) {
    Box box;
    box.include(Vec3(4, 4, 4));
    box.include(Vec3(36, 36, 36));
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(1, 2, 2), Vec3(1, -1, 0)}) {
        const Vec3 outward = n.normalized(), on(20, 20, 20);
        const Band disc = sample_solid(
            [&](const Vec3& p) {
                return cone_distance(p, {on - 9 * outward, on + 9 * outward, 10, 10});
            },
            box, test::kLattice);
        const Band half =
            sample_solid([&](const Vec3& p) { return half_space_distance(p, on, outward); }, box,
                         test::kLattice);
        const double area = contact(intersect(disc, half), subtract(disc, half)).area;
        // Half a sample of the rim, where the normals lean.
        EXPECT_NEAR(area, kPi * 100, 0.5 * 20 * kPi) << n.transpose();
    }
}

TEST(CsgMeasure, solids_apart_do_not_touch) {
    EXPECT_EQ(contact(test::ball(Vec3(0, 0, 0), 5), test::ball(Vec3(13, 0, 0), 5)).area, 0);
}

}  // namespace
}  // namespace myotet::levelset
