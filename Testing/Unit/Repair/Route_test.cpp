// SPDX-License-Identifier: Apache-2.0
#include "Repair/Route.h"

#include <gmock/gmock.h>

#include "Core/Errors.h"
#include "RepairShapes.h"

namespace myotet::repair {
namespace {

const levelset::Band kStart = test::ball(Vec3(20, 20, 20), 6);
const levelset::Band kGoal = test::ball(Vec3(20, 20, 50), 6);

TEST(Route, the_free_way_is_straight_and_as_long_as_the_gap) {
    const Route route =
        find_route({.from = kStart, .to = kGoal, .within = 30, .clearance = 3}, SilentProgress());
    // From sample to sample: up to one more at either end.
    EXPECT_NEAR(route.length, 18, 2);
    for (const Vec3& p : route.points) EXPECT_LT((p - Vec3(20, 20, p.z())).norm(), 1.5);
    EXPECT_LT(sample(kStart, route.points.front()).value, 0);
    EXPECT_LT(sample(kGoal, route.points.back()).value, 0);
}

TEST(Route, a_wall_is_gone_around_at_a_distance) {
    const levelset::Band wall = test::bar(Vec3(20, 20, 35), Vec3(8, 8, 2));
    const Route route =
        find_route({.from = kStart, .to = kGoal, .walls = {&wall}, .within = 40, .clearance = 3},
                   SilentProgress());
    ASSERT_FALSE(route.points.empty());
    EXPECT_GT(route.length, 20);
    for (const Vec3& p : route.points) EXPECT_GT(sample(wall, p).value, 0);
}

TEST(Route, a_closed_shell_blocks_and_is_named) {
    const levelset::Band other = test::ball(Vec3(60, 20, 20), 3);
    const levelset::Band shell =
        levelset::subtract(test::ball(Vec3(20, 20, 50), 12), test::ball(Vec3(20, 20, 50), 9));
    const Route blocked = find_route(
        {.from = kStart, .to = kGoal, .walls = {&other, &shell}, .within = 40, .clearance = 3},
        SilentProgress());
    EXPECT_TRUE(blocked.points.empty());
    EXPECT_EQ(blocked.blocked_by, std::vector<int>{1});
    const Route open = find_route({.from = kStart,
                                   .to = kGoal,
                                   .walls = {&other},
                                   .passables = {&shell},
                                   .within = 40,
                                   .clearance = 3},
                                  SilentProgress());
    EXPECT_FALSE(open.points.empty());
}

TEST(Route, solids_out_of_reach_have_none) {
    const Route route =
        find_route({.from = kStart, .to = kGoal, .within = 5, .clearance = 3}, SilentProgress());
    EXPECT_TRUE(route.points.empty());
    EXPECT_TRUE(route.blocked_by.empty());
}

TEST(Route, gaps_are_measured_between_surfaces) {
    EXPECT_NEAR(gap_between(kStart, kGoal), 18, 0.5);
    EXPECT_EQ(gap_between(kStart, test::ball(Vec3(20, 20, 31), 6)), 0);
}

TEST(Route, too_large_a_search_is_a_matter_of_resources) {
    const levelset::Band far = test::ball(Vec3(20, 20, 900), 6);
    const levelset::Band wide = levelset::unite(far, test::ball(Vec3(900, 900, 20), 6));
    EXPECT_THROW((void)find_route({.from = wide, .to = kGoal, .within = 2000, .clearance = 3},
                                  SilentProgress()),
                 ResourceError);
}

}  // namespace
}  // namespace myotet::repair
