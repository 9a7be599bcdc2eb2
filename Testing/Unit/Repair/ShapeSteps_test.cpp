// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "RepairShapes.h"

namespace myotet {
namespace {

using test::ball_tolerance;
using test::ball_volume;
using ::testing::HasSubstr;

// A ball with a hollow, and two islands.
test::Scene torn() {
    using test::ball;
    const test::Band hollow =
        levelset::subtract(ball(Vec3(30, 30, 30), 14), ball(Vec3(31, 30, 30), 6));
    return test::make_scene(
        {{"muscle", levelset::unite(levelset::unite(hollow, ball(Vec3(55, 30, 30), 5)),
                                    ball(Vec3(80, 30, 30), 3))},
         {"marrow", ball(Vec3(31, 30, 30), 3)}});
}

TEST(ShapeSteps, keep_largest_keeps_the_count) {
    test::Scene scene = torn();
    const auto one = test::repaired(scene, "  - keep_largest: muscle\n");
    EXPECT_NEAR(one.steps[0].removed, ball_volume(5) + ball_volume(3),
                ball_tolerance(5) + ball_tolerance(3));
    EXPECT_EQ(test::tissue_of(scene, "muscle").regions.size(), 1u);
    test::Scene again = torn();
    test::repaired(again, "  - keep_largest: muscle\n    count: 2\n");
    EXPECT_EQ(test::tissue_of(again, "muscle").regions.size(), 2u);
}

TEST(ShapeSteps, islands_under_a_volume_go) {
    test::Scene scene = torn();
    const auto summary = test::repaired(scene, "  - drop_islands: muscle\n    under: 200\n");
    EXPECT_NEAR(summary.steps[0].removed, ball_volume(3), ball_tolerance(3));
    EXPECT_THAT(summary.steps[0].note, HasSubstr("1 island dropped"));
    EXPECT_EQ(test::tissue_of(scene, "muscle").regions.size(), 2u);
}

TEST(ShapeSteps, dropping_all_islands_is_refused) {
    EXPECT_THAT(test::refusal(torn(), "  - drop_islands: muscle\n    under: 1e6\n"),
                HasSubstr("nothing would be left of 'muscle'"));
}

TEST(ShapeSteps, hollows_fill_but_for_what_lies_in_them) {
    test::Scene scene = torn();
    const auto summary = test::repaired(scene, "  - fill_cavities: muscle\n");
    const double wanted = ball_volume(6) - ball_volume(3);
    EXPECT_NEAR(summary.steps[0].added, wanted, ball_tolerance(6) + ball_tolerance(3));
    EXPECT_FALSE(test::tissue_of(scene, "marrow").changed);
}

TEST(ShapeSteps, hollows_over_a_volume_stay) {
    test::Scene scene = torn();
    const auto summary = test::repaired(scene, "  - fill_cavities: muscle\n    under: 500\n");
    EXPECT_EQ(summary.steps[0].added, 0);
    EXPECT_FALSE(test::tissue_of(scene, "muscle").changed);
}

TEST(ShapeSteps, offset_stops_at_the_neighbour) {
    test::Scene scene = test::make_scene(
        {{"muscle", test::ball(Vec3(30, 30, 30), 10)}, {"bone", test::ball(Vec3(30, 30, 50), 8)}});
    test::repaired(scene, "  - offset: muscle\n    by: 4\n");
    EXPECT_FALSE(test::tissue_of(scene, "bone").changed);
    EXPECT_EQ(levelset::enclosed_volume(levelset::intersect(test::band_of(scene, "muscle"),
                                                            test::band_of(scene, "bone"))),
              0);
    EXPECT_GT(levelset::contact(test::band_of(scene, "muscle"), test::band_of(scene, "bone")).area,
              20);
}

TEST(ShapeSteps, an_offset_that_leaves_nothing_is_refused) {
    EXPECT_THAT(
        test::refusal(torn(), "  - open: muscle\n    by: 1\n  - offset: marrow\n    by: -4\n"),
        HasSubstr("step 2 (line 5): nothing would be left of 'marrow'"));
}

TEST(ShapeSteps, all_tissues_are_named_by_all) {
    test::Scene scene = torn();
    const auto summary = test::repaired(scene, "  - offset: all\n    by: -0.5\n");
    EXPECT_EQ(summary.steps.size(), 2u);
}

TEST(ShapeSteps, of_all_tissues_only_changed_ones_are_logged) {
    test::Scene scene = torn();
    const auto some = test::repaired(scene, "  - keep_largest: all\n");
    ASSERT_EQ(some.steps.size(), 1u);
    EXPECT_EQ(some.steps[0].tissue, "muscle");
    const auto none = test::repaired(scene, "  - keep_largest: all\n");
    ASSERT_EQ(none.steps.size(), 1u);
    EXPECT_EQ(none.steps[0].note, "nothing changed");
}

TEST(ShapeSteps, opening_and_closing_go_through) {
    test::Scene scene = torn();
    const auto summary =
        test::repaired(scene, "  - open: muscle\n    by: 3.5\n  - close: muscle\n    by: 7\n");
    // Opening takes the island of 3 mm, closing the hollow of 6 but for the marrow.
    EXPECT_GE(summary.steps[0].removed, ball_volume(3) - ball_tolerance(3));
    EXPECT_GE(summary.steps[1].added,
              ball_volume(6) - ball_volume(3) - ball_tolerance(6) - ball_tolerance(3));
}

}  // namespace
}  // namespace myotet
