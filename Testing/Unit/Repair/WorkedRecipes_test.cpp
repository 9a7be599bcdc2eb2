// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <set>

#include "Phantoms/Phantoms.h"
#include "RepairShapes.h"
#include "Segmentation/ReadLabels.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
const fs::path kSource = MYOTET_SOURCE_DIR;
const fs::path kArm = fs::path(MYOTET_SHARED_DIR) / "data/arm/bp3d_right_ua1.nii.gz";

test::Scene scene_of(const LabelVolume& volume) {
    std::set<std::int32_t> values(volume.values.begin(), volume.values.end());
    values.erase(0);
    const std::vector<std::int32_t> labels(values.begin(), values.end());
    SilentProgress progress;
    test::Scene scene;
    repair::add_layer(scene, levelset::from_labels(volume, labels, {}, progress), volume);
    return scene;
}

repair::Summary repair_by(const fs::path& recipe, test::Scene& scene) {
    SilentProgress progress;
    return repair::apply(repair::read_recipe(kSource / recipe), scene, progress);
}

double touch(const test::Scene& scene, const std::string& a, const std::string& b) {
    return levelset::contact(test::band_of(scene, a), test::band_of(scene, b)).area;
}

TEST(WorkedRecipes, phantom_of_an_arm_however_scanned) {
    test::Scene scene = scene_of(phantoms::make_phantom("arm").volume);
    const double humerus = test::volume_of(scene, "humerus");
    repair_by("Data/arm_phantom_repair.yaml", scene);
    EXPECT_GE(touch(scene, "biceps_tendon_distal", "radius_ulna"), 90);
    // A capsule of 150 mm and 5 mm radius, all of it in the bone.
    const double marrow = std::numbers::pi * 25 * 150 + test::ball_volume(5);
    EXPECT_NEAR(test::volume_of(scene, "marrow"), marrow, 0.01 * marrow);
    EXPECT_NEAR(test::volume_of(scene, "humerus") + test::volume_of(scene, "marrow"), humerus, 1);
    EXPECT_EQ(test::tissue_of(scene, "cartilage").regions.size(), 1u);
    EXPECT_GT(touch(scene, "cartilage", "humerus"), 500);
    EXPECT_EQ(levelset::enclosed_volume(levelset::intersect(test::band_of(scene, "cartilage"),
                                                            test::band_of(scene, "humerus"))),
              0);
    for (const char* same : {"radius_ulna", "biceps_tendon_proximal", "triceps_tendon_proximal"})
        EXPECT_FALSE(test::tissue_of(scene, same).changed) << same;

    // The recipe's points are the patient's: scanned obliquely, the same result.
    phantoms::PhantomOptions options;
    options.direction = Mat3(Eigen::AngleAxisd(0.15, Vec3(1, 2, 3).normalized()));
    test::Scene turned = scene_of(phantoms::make_phantom("arm", options).volume);
    repair_by("Data/arm_phantom_repair.yaml", turned);
    ASSERT_EQ(scene.tissues.size(), turned.tissues.size());
    for (const repair::Tissue& tissue : scene.tissues) {
        const double volume = test::volume_of(scene, tissue.name);
        // What two scans of one body differ by, a shell of 2 mm most.
        EXPECT_NEAR(test::volume_of(turned, tissue.name), volume, 0.06 * volume) << tissue.name;
    }
}

struct Before {
    double volume = 0;
    std::vector<std::vector<float>> samples;
};

std::map<std::string, Before> remember(const test::Scene& scene) {
    std::map<std::string, Before> before;
    for (const repair::Tissue& tissue : scene.tissues)
        for (const levelset::Region& region : tissue.regions) {
            before[tissue.name].volume += region.volume_level_set;
            before[tissue.name].samples.push_back(region.phi.values);
        }
    return before;
}

TEST(WorkedRecipes, tendons_of_the_shared_arm_reach_their_bones) {
    if (!fs::exists(kArm)) GTEST_SKIP() << kArm << " is not here";
    test::Scene scene = scene_of(segmentation::read_labels(kArm).layers.front());
    const auto before = remember(scene);
    EXPECT_EQ(touch(scene, "biceps_brachii_short_head", "radius"), 0);
    repair_by("Testing/Regression/Recipes/bp3d_right_ua1.yaml", scene);

    const std::string biceps = "biceps_brachii_", triceps = "triceps_brachii_";
    EXPECT_GE(touch(scene, biceps + "short_head", "radius"), 30);
    EXPECT_GE(touch(scene, biceps + "long_head", "radius"), 100);
    EXPECT_GE(touch(scene, biceps + "long_head", "scapula"), 60);
    EXPECT_GE(touch(scene, biceps + "short_head", "scapula"), 40);
    EXPECT_GE(touch(scene, triceps + "long_head", "ulna"), 100);
    EXPECT_GE(touch(scene, triceps + "lateral_head", "ulna"), 100);
    EXPECT_GE(touch(scene, triceps + "medial_head", "ulna"), 100);
    EXPECT_GE(touch(scene, triceps + "long_head", "scapula"), 100);
    EXPECT_GE(touch(scene, triceps + "medial_head", "humerus"), 1000);
    EXPECT_GE(touch(scene, triceps + "lateral_head", "humerus"), 1000);

    int heads = 0;
    for (const repair::Tissue& tissue : scene.tissues) {
        const bool head = tissue.name.starts_with(biceps) || tissue.name.starts_with(triceps);
        heads += head;
        if (head) {
            EXPECT_EQ(tissue.regions.size(), 1u) << tissue.name;
            // A tendon more and crumbs less.
            EXPECT_NEAR(tissue.regions[0].volume_level_set / before.at(tissue.name).volume, 1,
                        0.03);
            continue;
        }
        ASSERT_EQ(tissue.regions.size(), before.at(tissue.name).samples.size());
        for (std::size_t r = 0; r < tissue.regions.size(); ++r)
            EXPECT_EQ(tissue.regions[r].phi.values, before.at(tissue.name).samples[r]);
    }
    EXPECT_EQ(heads, 5);
}

}  // namespace
}  // namespace myotet
