// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "Core/Parallel.h"
#include "RepairShapes.h"

namespace myotet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

double touch(const test::Scene& scene, const char* a, const char* b) {
    return levelset::contact(test::band_of(scene, a), test::band_of(scene, b)).area;
}

// A muscle that ends 20 mm short of a bone, and a third tissue beside the way.
test::Scene gap() {
    return test::make_scene({{"muscle", test::ball(Vec3(30, 30, 30), 9)},
                             {"bone", test::bar(Vec3(30, 30, 65), Vec3(15, 15, 6))},
                             {"nerve", test::bar(Vec3(38, 30, 48), Vec3(5, 15, 3))}});
}

const std::string kGrow = "  - grow: muscle\n    until_it_touches: bone\n    within: 30\n";

TEST(BridgeSteps, growth_reaches_the_bone_and_leaves_the_others_alone) {
    test::Scene scene = gap();
    const auto summary = test::repaired(scene, kGrow + "    radius: 3\n");
    ASSERT_EQ(summary.steps.size(), 1u);
    // A flat end of 3 mm radius; its rim is cut by cells.
    EXPECT_NEAR(touch(scene, "muscle", "bone"), 9 * std::numbers::pi, 7);
    EXPECT_EQ(test::tissue_of(scene, "muscle").regions.size(), 1u);
    EXPECT_FALSE(test::tissue_of(scene, "bone").changed);
    EXPECT_FALSE(test::tissue_of(scene, "nerve").changed);
    // Twenty mm of 3 mm radius, and a seam.
    EXPECT_NEAR(summary.steps[0].added, 20 * 9 * std::numbers::pi, 150);
    EXPECT_EQ(summary.steps[0].removed, 0);
    EXPECT_THAT(summary.steps[0].note, HasSubstr("touches bone over"));
}

TEST(BridgeSteps, growth_widens_its_end_until_it_touches_enough) {
    test::Scene scene = gap();
    test::repaired(scene, kGrow + "    radius: 2\n    over: 90\n");
    EXPECT_GE(touch(scene, "muscle", "bone"), 90);
}

TEST(BridgeSteps, the_thickness_is_the_muscle_s_own_where_none_is_given) {
    test::Scene scene = test::make_scene({{"muscle", test::bar(Vec3(30, 30, 30), Vec3(4, 4, 15))},
                                          {"bone", test::bar(Vec3(30, 30, 65), Vec3(15, 15, 6))}});
    test::repaired(scene, kGrow);
    EXPECT_NEAR(touch(scene, "muscle", "bone"), 16 * std::numbers::pi, 16);
}

TEST(BridgeSteps, growth_goes_where_it_is_sent) {
    test::Scene scene = gap();
    test::repaired(scene, kGrow + "    radius: 2\n    to: [20, 38, 59]\n");
    const levelset::Contact found =
        levelset::contact(test::band_of(scene, "muscle"), test::band_of(scene, "bone"));
    // Within the 3 mm that ends are chosen in.
    EXPECT_LT((found.centre - Vec3(20, 38, 59)).norm(), 4.5);
}

TEST(BridgeSteps, growth_can_be_a_tissue_of_its_own) {
    test::Scene scene = gap();
    const levelset::LevelSet before = scene.tissues[0].regions[0].phi;
    test::repaired(scene, kGrow + "    radius: 3\n    into: tendon\n    label: 77\n");
    EXPECT_EQ(test::tissue_of(scene, "tendon").label, 77);
    EXPECT_EQ(test::tissue_of(scene, "muscle").regions[0].phi.values, before.values);
    EXPECT_GT(touch(scene, "tendon", "bone"), 20);
    EXPECT_GT(touch(scene, "tendon", "muscle"), 20);
}

TEST(BridgeSteps, what_touches_already_is_left_alone_or_widened) {
    test::Scene scene = gap();
    const auto summary =
        test::repaired(scene, kGrow + "    radius: 2\n" + kGrow + kGrow + "    over: 60\n");
    ASSERT_EQ(summary.steps.size(), 3u);
    EXPECT_EQ(summary.steps[1].added, 0);
    EXPECT_THAT(summary.steps[1].note, HasSubstr("already"));
    EXPECT_GT(summary.steps[2].added, 0);
    EXPECT_GE(touch(scene, "muscle", "bone"), 60);
}

TEST(BridgeSteps, a_gap_too_wide_is_refused_with_its_width) {
    const std::string sentence =
        test::refusal(gap(), "  - grow: muscle\n    until_it_touches: bone\n    within: 10\n");
    EXPECT_THAT(sentence, AllOf(HasSubstr("step 1"), HasSubstr("within"), HasSubstr("10")));
    // 59 - 39 mm.
    EXPECT_THAT(sentence, ::testing::ContainsRegex("gap is (19.[5-9]|20)"));
}

TEST(BridgeSteps, a_blocked_way_is_refused_by_the_blocker_s_name_and_opens_when_it_gives_way) {
    const auto blocked = [] {
        return test::make_scene({{"muscle", test::ball(Vec3(30, 30, 30), 9)},
                                 {"bone", test::ball(Vec3(30, 30, 60), 7)},
                                 {"fascia", levelset::subtract(test::ball(Vec3(30, 30, 60), 13),
                                                               test::ball(Vec3(30, 30, 60), 10))}});
    };
    EXPECT_THAT(test::refusal(blocked(), kGrow),
                AllOf(HasSubstr("fascia"), HasSubstr("takes_from")));
    test::Scene scene = blocked();
    const auto summary = test::repaired(scene, kGrow + "    radius: 2.5\n    takes_from: fascia\n");
    ASSERT_EQ(summary.steps.size(), 2u);
    EXPECT_EQ(summary.steps[1].tissue, "fascia");
    EXPECT_GT(touch(scene, "muscle", "bone"), 8);
    EXPECT_EQ(levelset::enclosed_volume(levelset::intersect(test::band_of(scene, "muscle"),
                                                            test::band_of(scene, "fascia"))),
              0);
}

TEST(BridgeSteps, pieces_are_joined_across_their_gaps) {
    test::Scene scene = test::make_scene(
        {{"muscle", levelset::unite(levelset::unite(test::ball(Vec3(30, 30, 30), 9),
                                                    test::ball(Vec3(30, 30, 54), 6)),
                                    test::ball(Vec3(50, 30, 30), 5))}});
    const auto summary = test::repaired(scene, "  - join: muscle\n    within: 12\n    radius: 2\n");
    ASSERT_EQ(summary.steps.size(), 1u);
    EXPECT_EQ(test::tissue_of(scene, "muscle").regions.size(), 1u);
    EXPECT_GT(summary.steps[0].added, 50);
    EXPECT_LT(summary.steps[0].added, 400);
    EXPECT_EQ(summary.steps[0].removed, 0);
}

TEST(BridgeSteps, pieces_too_far_apart_are_refused) {
    const test::Scene scene =
        test::make_scene({{"muscle", levelset::unite(test::ball(Vec3(30, 30, 30), 9),
                                                     test::ball(Vec3(30, 30, 60), 6))}});
    EXPECT_THAT(test::refusal(scene, "  - join: muscle\n    within: 5\n"),
                AllOf(HasSubstr("step 1"), HasSubstr("gap is")));
}

TEST(BridgeSteps, same_bytes_for_any_number_of_threads) {
    const auto make = [](int threads) {
        const ThreadLimit limit(threads);
        test::Scene scene = gap();
        test::repaired(scene, kGrow + "    over: 40\n");
        return test::tissue_of(scene, "muscle").regions[0].phi.values;
    };
    EXPECT_EQ(make(1), make(2));
}

TEST(BridgeSteps, a_turned_patient_is_repaired_alike) {
    Frame frame;
    frame.rotation = Mat3(Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()));
    frame.origin = Vec3(-120, 40, 900);
    test::Scene plain = gap(), turned = gap();
    turned.frame = frame;
    const auto point = [](const Vec3& p) {
        return "[" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " +
               std::to_string(p.z()) + "]";
    };
    const Vec3 end(22, 36, 59);
    test::repaired(plain, kGrow + "    radius: 3\n    to: " + point(end) + "\n");
    test::repaired(turned, kGrow + "    radius: 3\n    to: " + point(frame.to_lps(end)) + "\n");
    EXPECT_EQ(test::tissue_of(plain, "muscle").regions[0].phi.values,
              test::tissue_of(turned, "muscle").regions[0].phi.values);
}

}  // namespace
}  // namespace myotet
