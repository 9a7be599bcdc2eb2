// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <numbers>

#include "RepairShapes.h"

namespace myotet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
using test::ball_tolerance;
using test::ball_volume;
using test::kEdge;

// Two balls that touch nothing, one of them small.
test::Scene two() {
    return test::make_scene(
        {{"muscle", test::ball(Vec3(30, 30, 30), 10)}, {"bone", test::ball(Vec3(30, 30, 60), 8)}});
}

TEST(CombineSteps, a_sphere_is_added_and_the_volume_logged) {
    test::Scene scene = two();
    const double before = test::volume_of(scene, "muscle");
    const auto summary = test::repaired(
        scene, "  - union: muscle\n    with: {sphere: {centre: [70, 30, 30], radius: 6}}\n");
    ASSERT_EQ(summary.steps.size(), 1u);
    EXPECT_NEAR(summary.steps[0].added, ball_volume(6), ball_tolerance(6));
    EXPECT_EQ(summary.steps[0].removed, 0);
    EXPECT_EQ(summary.steps[0].tissue, "muscle");
    EXPECT_NEAR(test::volume_of(scene, "muscle"), before + summary.steps[0].added, 1e-6 * before);
    EXPECT_EQ(test::tissue_of(scene, "muscle").regions.size(), 2u);
}

TEST(CombineSteps, tissues_that_no_step_names_stay_bit_for_bit) {
    test::Scene scene = two();
    const levelset::LevelSet before = scene.tissues[1].regions[0].phi;
    test::repaired(scene, "  - offset: muscle\n    by: 1\n");
    EXPECT_FALSE(scene.tissues[1].changed);
    EXPECT_EQ(scene.tissues[1].regions[0].phi.values, before.values);
    EXPECT_EQ(scene.tissues[1].regions[0].phi.coarse_values, before.coarse_values);
}

TEST(CombineSteps, what_is_added_leaves_other_tissues_their_own) {
    test::Scene scene = two();
    const auto summary = test::repaired(
        scene,
        "  - union: muscle\n    with: {capsule: {from: [30, 30, 30], to: [30, 30, 60], "
        "radius: 4}}\n");
    EXPECT_EQ(summary.steps.size(), 1u);
    EXPECT_FALSE(test::tissue_of(scene, "bone").changed);
    const test::Band muscle = test::band_of(scene, "muscle"), bone = test::band_of(scene, "bone");
    EXPECT_EQ(levelset::enclosed_volume(levelset::intersect(muscle, bone)), 0);
    // A capsule of 4 mm ends on the ball.
    EXPECT_NEAR(levelset::contact(muscle, bone).area, kPi * 16, 0.15 * kPi * 16);
}

TEST(CombineSteps, takes_from_moves_volume) {
    test::Scene scene = two();
    const auto summary = test::repaired(
        scene,
        "  - union: muscle\n    with: {capsule: {from: [30, 30, 30], to: [30, 30, 60], "
        "radius: 4}}\n    takes_from: bone\n");
    ASSERT_EQ(summary.steps.size(), 2u);
    EXPECT_EQ(summary.steps[1].tissue, "bone");
    EXPECT_GT(summary.steps[1].removed, 300);
    const test::Band muscle = test::band_of(scene, "muscle"), bone = test::band_of(scene, "bone");
    EXPECT_EQ(levelset::enclosed_volume(levelset::intersect(muscle, bone)), 0);
    EXPECT_NEAR(levelset::enclosed_volume(bone), ball_volume(8) - summary.steps[1].removed,
                ball_tolerance(8) + kEdge * 2 * kPi * 4);
}

TEST(CombineSteps, a_part_moves_into_a_new_tissue) {
    test::Scene scene = two();
    const auto summary = test::repaired(
        scene,
        "  - intersection: muscle\n    with: {half_space: {point: [0, 0, 30], outward: "
        "[0, 0, 1]}}\n    into: tendon\n    label: 40\n");
    ASSERT_EQ(summary.steps.size(), 2u);
    EXPECT_EQ(test::tissue_of(scene, "tendon").label, 40);
    EXPECT_TRUE(test::tissue_of(scene, "tendon").made);
    const double half = ball_volume(10) / 2;
    EXPECT_NEAR(test::volume_of(scene, "tendon"), half, ball_tolerance(10) + kEdge * 20 * kPi);
    EXPECT_NEAR(test::volume_of(scene, "muscle"), half, ball_tolerance(10) + kEdge * 20 * kPi);
    EXPECT_NEAR(
        levelset::contact(test::band_of(scene, "tendon"), test::band_of(scene, "muscle")).area,
        kPi * 100, 0.05 * kPi * 100);
}

TEST(CombineSteps, a_new_tissue_gets_the_next_free_label) {
    test::Scene scene = two();
    test::repaired(scene,
                   "  - create: cuff\n    from: {torus: {centre: [30, 30, 60], axis: [0, 0, 1], "
                   "ring: 14, tube: 3}}\n");
    EXPECT_EQ(test::tissue_of(scene, "cuff").label, 3);
    const double wanted = 2 * kPi * kPi * 14 * 9;
    EXPECT_NEAR(test::volume_of(scene, "cuff"), wanted, 0.02 * wanted);
}

TEST(CombineSteps, union_with_a_tissue_absorbs_it) {
    test::Scene scene = test::make_scene({{"a", test::ball(Vec3(30, 30, 30), 10)},
                                          {"b", test::ball(Vec3(42, 30, 30), 8)},
                                          {"c", test::ball(Vec3(90, 30, 30), 8)}});
    test::repaired(scene, "  - priority: [a, b]\n  - union: a\n    with: b\n    blend: 2\n");
    ASSERT_EQ(scene.tissues.size(), 2u);
    EXPECT_EQ(scene.tissues[1].name, "c");
    EXPECT_EQ(test::tissue_of(scene, "a").regions.size(), 1u);
}

TEST(CombineSteps, priority_decides_where_tissues_overlap) {
    const auto overlapping = [] {
        return test::make_scene(
            {{"a", test::ball(Vec3(30, 30, 30), 10)}, {"b", test::ball(Vec3(40, 30, 30), 10)}});
    };
    // A lens of two balls of radius r, d apart.
    const double lens = kPi * (40 + 10) * 10 * 10 / 12;
    test::Scene scene = overlapping();
    const auto summary = test::repaired(scene, "  - priority: [b, a]\n");
    ASSERT_EQ(summary.steps.size(), 1u);
    EXPECT_EQ(summary.steps[0].tissue, "a");
    EXPECT_NEAR(summary.steps[0].removed, lens, 0.02 * lens);
    EXPECT_FALSE(test::tissue_of(scene, "b").changed);
    EXPECT_EQ(levelset::enclosed_volume(
                  levelset::intersect(test::band_of(scene, "a"), test::band_of(scene, "b"))),
              0);
}

TEST(CombineSteps, clip_ends_at_the_field_of_view) {
    test::Scene scene = two();
    LabelVolume volume;
    volume.size = {100, 100, 30};  // voxels from -0.5 to 29.5 in z
    scene.field_of_view = repair::field_of_view(volume);
    const auto summary =
        test::repaired(scene, "  - clip: muscle\n  - clip: muscle\n    margin: 1\n");
    ASSERT_EQ(summary.steps.size(), 2u);
    EXPECT_LT(levelset::inside_box(test::band_of(scene, "muscle")).max.z(), 28.5);
    // Slices of a ball of radius 10 near its equator: pi r^2 a mm.
    EXPECT_NEAR(summary.steps[1].removed, kPi * 100, kEdge * 20 * kPi);
}

TEST(CombineSteps, clip_needs_a_field_of_view) {
    EXPECT_THAT(test::refusal(two(), "  - clip: muscle\n"), HasSubstr("no field of view"));
}

TriMesh cube(const Vec3& middle, double half) {
    TriMesh mesh;
    for (int c = 0; c < 8; ++c)
        mesh.points.push_back(middle + half * Vec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1));
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

TEST(CombineSteps, a_surface_is_placed_in_the_patient_s_frame) {
    Frame frame;
    frame.rotation = Mat3(Eigen::AngleAxisd(0.4, Vec3(1, 1, 0).normalized()));
    frame.origin = Vec3(100, -50, 20);
    test::Scene scene = test::make_scene({{"muscle", test::ball(Vec3(30, 30, 30), 10)}}, frame);
    const Vec3 middle = frame.to_lps(Vec3(30, 30, 34));
    scene.read_surface = [&](const std::filesystem::path& file) {
        EXPECT_EQ(file.filename(), "cube.stl");
        return cube(middle, 4);
    };
    const auto summary =
        test::repaired(scene, "  - difference: muscle\n    with: {surface: cube.stl}\n");
    // Turned, all of the cube of 8 mm but tips lies in the ball.
    EXPECT_NEAR(summary.steps[0].removed, 512, kEdge * 12 * 8);
}

TEST(CombineSteps, a_cracked_surface_needs_heal) {
    test::Scene scene = two();
    scene.read_surface = [&](const std::filesystem::path&) {
        TriMesh open = cube(Vec3(30, 30, 30), 5);
        open.triangles.pop_back();
        return open;
    };
    const std::string step = "  - intersection: muscle\n    with: {surface: cube.stl";
    EXPECT_THAT(test::refusal(scene, step + "}\n"),
                AllOf(HasSubstr("step 1"), HasSubstr("cube.stl"), HasSubstr("'heal: true'")));
    test::repaired(scene, step + ", heal: true}\n");
    // The hole, half a side, is closed by a surface that bulges: a tenth of the cube.
    EXPECT_NEAR(test::volume_of(scene, "muscle"), 1000, 100);
}

TEST(CombineSteps, a_surface_without_a_reader_is_refused) {
    EXPECT_THAT(test::refusal(two(), "  - union: muscle\n    with: {surface: a.stl}\n"),
                HasSubstr("surface"));
}

TEST(CombineSteps, refusals_name_the_step) {
    const std::string good = "  - open: muscle\n    by: 1\n";
    EXPECT_THAT(test::refusal(two(), good + "  - difference: muscle\n    with: bones\n"),
                AllOf(HasSubstr("step 2 (line 5)"), HasSubstr("'bones'"), HasSubstr("'bone'")));
    EXPECT_THAT(test::refusal(two(), good + "  - intersection: muscle\n    with: bone\n"),
                AllOf(HasSubstr("step 2"), HasSubstr("nothing would be left of 'muscle'")));
    EXPECT_THAT(test::refusal(two(),
                              "  - union: muscle\n    with: {sphere: {centre: [30, 30, 60], "
                              "radius: 20}}\n    takes_from: bone\n"),
                AllOf(HasSubstr("step 1"), HasSubstr("all of 'bone'")));
    EXPECT_THAT(test::refusal(two(), "  - create: muscle\n    from: bone\n"),
                HasSubstr("is a tissue already"));
    EXPECT_THAT(test::refusal(two(),
                              "  - create: new\n    label: 2\n    from: {sphere: {centre: "
                              "[90, 0, 0], radius: 5}}\n"),
                HasSubstr("label 2 is 'bone'"));
    EXPECT_THAT(
        test::refusal(two(), "  - union: muscle\n    with: bone\n  - open: bone\n    by: 1\n"),
        AllOf(HasSubstr("step 2"), HasSubstr("'bone'")));
    EXPECT_THAT(test::refusal(two(),
                              "  - union: muscle\n    with: {half_space: {point: [0, 0, 0], "
                              "outward: [0, 0, 1]}}\n"),
                HasSubstr("no end"));
    EXPECT_THAT(test::refusal(two(),
                              "  - union: muscle\n    with: {sphere: {centre: [80.5, 0.5, "
                              "0.5], radius: 0.1}}\n"),
                HasSubstr("thinner"));
}

TEST(CombineSteps, all_names_are_checked_before_any_step) {
    test::Scene scene = two();
    EXPECT_THROW(
        test::repaired(scene, "  - offset: muscle\n    by: 2\n  - open: nerve\n    by: 1\n"),
        InputError);
    EXPECT_FALSE(scene.tissues[0].changed);
}

}  // namespace
}  // namespace myotet
