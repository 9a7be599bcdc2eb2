// SPDX-License-Identifier: Apache-2.0
#include "Repair/Scene.h"

#include <gtest/gtest.h>

#include "RepairShapes.h"

namespace myotet::repair {
namespace {

LabelVolume oblique_volume() {
    LabelVolume volume;
    volume.size = {10, 20, 30};
    Mat3 directions;  // sheared and left-handed
    directions << 1, 0.2, 0, 0.1, -2, 0, 0, 0, 3;
    volume.index_to_lps.linear() = directions;
    volume.index_to_lps.translation() = Vec3(5, -7, 100);
    return volume;
}

TEST(Scene, the_field_of_view_ends_half_a_voxel_beyond_the_centres) {
    const LabelVolume volume = oblique_volume();
    const std::vector<Plane> planes = field_of_view(volume);
    const auto inside = [&](const Vec3& index) {
        const Vec3 lps = volume.index_to_lps * index;
        return std::all_of(planes.begin(), planes.end(),
                           [&](const Plane& p) { return p.normal.dot(lps) <= p.offset; });
    };
    ASSERT_EQ(planes.size(), 6u);
    EXPECT_TRUE(inside(Vec3(-0.49, -0.49, -0.49)));
    EXPECT_TRUE(inside(Vec3(9.49, 19.49, 29.49)));
    for (int a = 0; a < 3; ++a) {
        EXPECT_FALSE(inside(Vec3(5, 5, 5) - 5.51 * Vec3::Unit(a)));
        EXPECT_FALSE(inside(Vec3(5, 5, 5) + (volume.size[a] - 5.49) * Vec3::Unit(a)));
    }
}

levelset::LabelLevelSets sets(int layer, double spacing = 1) {
    levelset::LabelLevelSets made;
    made.spacing = spacing;
    for (const std::int32_t label : {3, 3, 7}) {
        levelset::Region region;
        region.layer = layer;
        region.label = label;
        made.regions.push_back(region);
    }
    return made;
}

TEST(Scene, layers_become_tissues_with_their_names) {
    LabelVolume volume = oblique_volume();
    volume.names[3].name = "bone";
    Scene scene;
    add_layer(scene, sets(0), volume);
    add_layer(scene, sets(1), volume);
    ASSERT_EQ(scene.tissues.size(), 4u);
    EXPECT_EQ(scene.tissues[0].name, "bone");
    EXPECT_EQ(scene.tissues[0].regions.size(), 2u);
    EXPECT_EQ(scene.tissues[1].name, "label_7");
    EXPECT_EQ(scene.tissues[2].layer, 1);
    const auto regions = take_regions(scene);
    ASSERT_EQ(regions.size(), 6u);
    EXPECT_EQ(regions[2].layer, 1);
    EXPECT_EQ(regions[5].label, 7);
}

TEST(Scene, layers_on_other_lattices_are_refused) {
    Scene scene;
    add_layer(scene, sets(0), oblique_volume());
    EXPECT_THROW(add_layer(scene, sets(1, 0.5), oblique_volume()), InputError);
}

TEST(Scene, a_name_in_two_layers_is_ambiguous) {
    const test::Scene scene = test::make_scene(
        {{"a", test::ball(Vec3(20, 20, 20), 6)}, {"a", test::ball(Vec3(50, 20, 20), 6)}});
    EXPECT_NE(test::refusal(scene, "  - open: a\n    by: 1\n").find("2 tissues"),
              std::string::npos);
}

}  // namespace
}  // namespace myotet::repair
