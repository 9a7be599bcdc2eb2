// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "Core/Errors.h"
#include "Repair/Recipe.h"
#include "Support/TemporaryFolder.h"

namespace myotet::repair {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Recipe read(const std::string& text) {
    const myotet::testing::TemporaryFolder folder;
    myotet::testing::write_bytes(folder / "r.yaml", text);
    return read_recipe(folder / "r.yaml");
}

std::string refusal(const std::string& text) {
    try {
        (void)read(text);
    } catch (const InputError& e) {
        return e.what();
    }
    return {};
}

std::string refused_step(const std::string& step) { return refusal("steps:\n  - " + step); }

TEST(ReadRecipe, every_step_is_read) {
    const Recipe recipe = read(R"(
myotet_recipe: 1
about: one of each
steps:
  - union: a
    with: {sphere: {centre: [1, 2, 3], radius: 4}}
    blend: 0.5
    takes_from: [b, c]
  - intersection: a
    with: b
    into: c
    label: 12
  - difference: a
    with: {surface: implant.stl}
  - create: cuff
    from: {torus: {relative_to: a, centre: [0, 0, 0], axis: [0, 0, 2], ring: 9, tube: 2}}
  - offset: [a, b]
    by: -0.5
  - open: a
    by: 1
  - close: all
    by: 2
  - keep_largest: a
    count: 2
  - drop_islands: a
    under: 10
  - fill_cavities: a
  - clip: a
    margin: 1
  - join: a
    within: 9
    radius: 2
  - grow: a
    until_it_touches: b
    within: 45
    radius: [2, 3]
    over: 30
    from: [0, 0, 1]
    into: tendon
  - priority: [a, b]
)");
    ASSERT_EQ(recipe.steps.size(), 14u);
    const auto& first = std::get<Combine>(recipe.steps[0].task);
    EXPECT_EQ(std::get<Sphere>(std::get<Solid>(first.with).shape).centre, Vec3(1, 2, 3));
    EXPECT_EQ(first.takes_from, (std::vector<std::string>{"b", "c"}));
    EXPECT_EQ(first.blend, 0.5);
    EXPECT_EQ(std::get<Combine>(recipe.steps[1].task).into->label, 12);
    EXPECT_EQ(std::get<SurfaceFile>(std::get<Combine>(recipe.steps[2].task).with).file,
              "implant.stl");
    const auto& cuff = std::get<Solid>(std::get<Create>(recipe.steps[3].task).from);
    EXPECT_EQ(cuff.relative_to, "a");
    EXPECT_EQ(std::get<Torus>(cuff.shape).axis, Vec3::UnitZ());
    EXPECT_EQ(std::get<Reshape>(recipe.steps[4].task).by, -0.5);
    EXPECT_EQ(std::get<KeepLargest>(recipe.steps[7].task).count, 2);
    const auto& grow = std::get<Grow>(recipe.steps[12].task);
    EXPECT_EQ(grow.bridge.radius, (std::array<double, 2>{2, 3}));
    EXPECT_EQ(grow.from, Vec3(0, 0, 1));
    EXPECT_FALSE(grow.to.has_value());
    EXPECT_EQ(recipe.steps[12].number, 13);
    EXPECT_EQ(recipe.steps[12].line, 33);
}

TEST(ReadRecipe, every_solid_is_read) {
    for (const char* solid : {"sphere: {centre: [0, 0, 0], radius: 1}",
                              "ellipsoid: {centre: [0, 0, 0], semi_axes: [3, 2, 1], x_axis: [0, 1, "
                              "0], y_axis: [1, 0, 0]}",
                              "capsule: {from: [0, 0, 0], to: [1, 0, 0], radius: [1, 2]}",
                              "cylinder: {from: [0, 0, 0], to: [1, 0, 0], radius: 1}",
                              "cone: {from: [0, 0, 0], to: [1, 0, 0], radius: [1, 0]}",
                              "box: {centre: [0, 0, 0], size: [1, 2, 3]}",
                              "torus: {centre: [0, 0, 0], axis: [1, 1, 0], ring: 2, tube: 1}",
                              "half_space: {point: [0, 0, 0], outward: [0, 0, 1]}"})
        EXPECT_EQ(refused_step("difference: a\n    with: {" + std::string(solid) + "}"), "")
            << solid;
}

TEST(ReadRecipe, misspelt_words_are_answered_with_the_nearest) {
    EXPECT_THAT(refused_step("unoin: a"), AllOf(HasSubstr("step 1"), HasSubstr("'union'")));
    EXPECT_THAT(refused_step("open: a\n    bye: 2"), AllOf(HasSubstr("'bye'"), HasSubstr("'by'")));
    EXPECT_THAT(refused_step("union: a\n    with: {spere: {}}"), HasSubstr("'sphere'"));
    EXPECT_THAT(refused_step("union: a\n    with: {sphere: {center: [0, 0, 0], radius: 2}}"),
                HasSubstr("'centre'"));
    EXPECT_THAT(refusal("stepps: []"), HasSubstr("'steps'"));
}

TEST(ReadRecipe, refusals_name_file_step_and_line) {
    const std::string sentence =
        refusal("steps:\n  - open: a\n    by: 1\n  - open: a\n    by: -1\n");
    EXPECT_THAT(sentence, AllOf(HasSubstr("r.yaml"), HasSubstr("step 2"), HasSubstr("line 4"),
                                HasSubstr("'-1'"), HasSubstr("above 0")));
}

TEST(ReadRecipe, values_out_of_range_are_refused) {
    for (const char* step :
         {"offset: a\n    by: 0",
          "offset: a\n    by: nan",
          "offset: a\n    by: 1e9",
          "offset: a\n    by: two",
          "offset: a\n    by: [1]",
          "offset: a\n    by:",
          "open: a",
          "offset: []\n    by: 1",
          "offset: [a, a]\n    by: 1",
          "offset: {a: 1}\n    by: 1",
          "keep_largest: a\n    count: 1.5",
          "keep_largest: a\n    count: 0",
          "drop_islands: a\n    under: 0",
          "priority: [a]",
          "priority: a",
          "union: a\n    with: {sphere: {centre: [0, 0], radius: 1}}",
          "union: a\n    with: {sphere: {centre: [0, 0, inf], radius: 1}}",
          "union: a\n    with: {sphere: {centre: [0, 0, 0], radius: -1}}",
          "union: a\n    with: {capsule: {from: [0, 0, 0], to: [0, 0, 0], radius: 1}}",
          "union: a\n    with: {cone: {from: [0, 0, 0], to: [0, 0, 1], radius: 0}}",
          "union: a\n    with: {torus: {centre: [0, 0, 0], axis: [0, 0, 0], ring: 1, tube: 1}}",
          "union: a\n    with: {box: {centre: [0, 0, 0], size: [1, 1, 1], x_axis: [1, 0, 0], "
          "y_axis: [1, 1, 0]}}",
          "union: a\n    with: {sphere: {centre: [0, 0, 0], radius: 1}, tissue: b}",
          "union: a\n    with: []",
          "union: a\n    with: {}",
          "union: [a, b]\n    with: c",
          "union: a\n    with: b\n    into: c",
          "difference: a\n    with: b\n    label: 3",
          "grow: a\n    until_it_touches: a\n    within: 3",
          "grow: a\n    within: 3",
          "open: a\n    by: 1\n    close: a",
          "7",
          "[]",
          "{}"})
        EXPECT_THAT(refused_step(step), HasSubstr("step 1 (line 2)")) << step;
}

TEST(ReadRecipe, what_is_no_recipe_is_refused) {
    for (const char* text :
         {"", "steps:", "steps: []", "steps: 3", "a: b", "[1, 2]", "steps: [", "steps:\n\t- x",
          "myotet_recipe: 2\nsteps:\n  - clip: a", "steps:\n  - open: a\n    open: b\n    by: 1",
          "steps:\n  - open: &a [*a]\n    by: 1",
          "steps: [[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]"})
        EXPECT_NE(refusal(text), "") << text;
    EXPECT_THROW((void)read_recipe("/nonexistent/recipe.yaml"), IoError);
}

TEST(ReadRecipe, many_aliases_do_not_make_a_bomb) {
    std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 10; ++i) {
        const std::string alias = "*a" + std::to_string(i - 1);
        text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + alias;
        for (int n = 0; n < 9; ++n) text += ", " + alias;
        text += "]\n";
    }
    EXPECT_THAT(refusal(text), HasSubstr("too"));
}

}  // namespace
}  // namespace myotet::repair
