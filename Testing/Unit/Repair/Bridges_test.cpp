// SPDX-License-Identifier: Apache-2.0
#include "Repair/Bridges.h"

#include <gtest/gtest.h>

#include "RepairShapes.h"

namespace myotet::repair {
namespace {

TEST(Bridges, the_ball_near_the_end_of_a_bar_is_as_thick_as_the_bar) {
    const levelset::Band bar = test::bar(Vec3(30, 30, 30), Vec3(4, 4, 15));
    const Ball ball = ball_near(bar, Vec3(30, 30, 44), 5);
    // Distances on the ridge of a bar are rounded by a part of a sample.
    EXPECT_NEAR(ball.radius, 4, 0.4);
    EXPECT_LE((ball.centre - Vec3(30, 30, 44)).norm(), 5.3);
}

TEST(Bridges, the_ball_does_not_climb_farther_than_asked) {
    const levelset::Band body = test::ball(Vec3(40, 40, 40), 20);
    EXPECT_NEAR(ball_near(body, Vec3(40, 40, 59.5), 5).radius, 5.5, 0.5);
}

TEST(Bridges, a_middle_line_begins_in_the_ball_and_ends_deep) {
    std::vector<Vec3> path;
    for (int z = 0; z <= 20; ++z) path.emplace_back(0, 0, z);
    const MiddleLine line = middle_line(path, {Vec3(0, 0, -3), 2}, {2, 4}, 5);
    EXPECT_EQ(line.points.front(), Vec3(0, 0, -3));
    EXPECT_NEAR((line.points.back() - Vec3(0, 0, 25)).norm(), 0, 1e-12);
    EXPECT_NEAR(line.length, 28, 1e-12);
    EXPECT_EQ(line.radius.front(), 2);
    EXPECT_EQ(line.radius.back(), 4);
    ASSERT_EQ(line.radius.size(), line.points.size());
    EXPECT_NEAR(line.radius[line.radius.size() - 2], 4, 1e-12);  // at the goal's surface
    for (std::size_t i = 1; i < line.radius.size(); ++i)
        EXPECT_GE(line.radius[i], line.radius[i - 1]);
}

TEST(Bridges, a_swept_line_is_a_capsule) {
    MiddleLine line;
    for (int i = 0; i <= 10; ++i) {
        line.points.emplace_back(Vec3(10, 10, 10) + 2 * i * Vec3(1, 2, 2) / 3);
        line.radius.push_back(5);
    }
    const double wanted = std::numbers::pi * 25 * 20 + test::ball_volume(5);
    // Chords cut a cylinder as they do a ball, half as deep.
    EXPECT_NEAR(levelset::enclosed_volume(swept(line, {Vec3::Zero(), 1})), wanted,
                test::ball_tolerance(5) / test::ball_volume(5) * wanted);
}

TEST(Bridges, smoothing_straightens_a_staircase_and_keeps_out_of_walls) {
    Route stairs;
    for (int i = 0; i <= 20; ++i) {
        stairs.points.emplace_back(i, i / 4 * 2, 0);
        if (i) stairs.length += (stairs.points[i] - stairs.points[i - 1]).norm();
    }
    const levelset::Band here = test::ball(Vec3(0, 0, 0), 2),
                         there = test::ball(Vec3(20, 10, 0), 2);
    const Route free = smoothed(stairs, {.from = here, .to = there, .within = 30, .clearance = 3});
    const double straight = (stairs.points.back() - stairs.points.front()).norm();
    EXPECT_LT(free.length, 1.02 * straight);
    EXPECT_LT(free.length, stairs.length);
    EXPECT_EQ(free.points.front(), stairs.points.front());
    EXPECT_EQ(free.points.back(), stairs.points.back());
    const levelset::Band wall = test::ball(Vec3(10, 4.9, 4), 4.2);
    const Route kept = smoothed(
        stairs, {.from = here, .to = there, .walls = {&wall}, .within = 30, .clearance = 3});
    for (std::size_t i = 0; i < kept.points.size(); ++i)
        EXPECT_GE(sample(wall, kept.points[i]).value,
                  std::min(0.0, double(sample(wall, stairs.points[i]).value)));
}

}  // namespace
}  // namespace myotet::repair
