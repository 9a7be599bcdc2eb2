// SPDX-License-Identifier: Apache-2.0
#include "Play/Obstacle.h"

#include <gtest/gtest.h>

#include "Support/PlayShapes.h"

namespace myotet::play {
namespace {

constexpr double kRounding = 1e-12;

std::vector<Obstacle> all_forms() {
    Obstacle plane, box, sphere;
    plane.point = {1, 2, 3};
    plane.normal = Vec3(1, 2, -2) / 3;
    box.form = Form::box;
    box.box = {{-1, -2, -3}, {4, 2, 1}};
    sphere.form = Form::sphere;
    sphere.point = {1, 1, 1};
    sphere.radius = 2.5;
    return {plane, box, sphere};
}

TEST(Obstacle, away_is_the_gradient_of_the_distance_and_leads_out) {
    const std::vector<Vec3> points = test::shaken(std::vector<Vec3>(300, Vec3::Zero()), 6, 3);
    for (const Obstacle& obstacle : all_forms())
        for (const Vec3& p : points) {
            const Apart at = apart(obstacle, p);
            EXPECT_NEAR(at.away.norm(), 1, kRounding);
            constexpr double h = 1e-6;
            for (int a = 0; a < 3; ++a) {
                const double slope = (apart(obstacle, p + h * Vec3::Unit(a)).distance -
                                      apart(obstacle, p - h * Vec3::Unit(a)).distance) /
                                     (2 * h);
                EXPECT_NEAR(slope, at.away[a], 1e-5);
            }
            EXPECT_NEAR(apart(obstacle, p - at.distance * at.away).distance, 0, kRounding);
        }
}

TEST(Obstacle, a_straight_way_meets_a_sphere_where_the_distance_is_its_radius) {
    const std::vector<Vec3> from = test::shaken(std::vector<Vec3>(500, Vec3::Zero()), 5, 4);
    const std::vector<Vec3> by = test::shaken(std::vector<Vec3>(500, Vec3::Zero()), 8, 5);
    int met = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double s = first_reach(from[i], by[i], 2);
        double least = 1e9;
        for (int k = 0; k <= 1000; ++k)
            least = std::min(least, (from[i] + k / 1000.0 * by[i]).norm());
        if (from[i].norm() <= 2) {
            EXPECT_EQ(s, 0);
        } else if (s < 0) {
            EXPECT_GT(least, 2 - 1e-3);
        } else {
            ++met;
            EXPECT_NEAR((from[i] + s * by[i]).norm(), 2, kRounding);
            EXPECT_LE(from[i].dot(by[i]) + s * by[i].squaredNorm(), kRounding)
                << "the first of two";
        }
    }
    EXPECT_GT(met, 30);
}

}  // namespace
}  // namespace myotet::play
