// SPDX-License-Identifier: Apache-2.0
// Bones that move: nodes go with them, and rigid motion of all costs nothing.
#include "BlockScene.h"

namespace myotet::contraction {
namespace {

using namespace test;

// Nodes of the upper end lie inside this bone, those of the lower end inside the other.
void write_bones(const BlockFolder& block) {
    meshfiles::write_stl(box_surface(Vec3(-1, -1, 11.5), Vec3(5, 5, 14)),
                         block.folder / "upper.stl");
    meshfiles::write_stl(box_surface(Vec3(-1, -1, -2), Vec3(5, 5, 0.5)),
                         block.folder / "lower.stl");
}

std::string with_bones(const std::string& upper_motion, const std::string& lower_motion,
                       const std::string& more = "") {
    std::string text = text_of(
        {.activation = "0",
         .upper = "to: upper, within: 0.1",
         .more = "bones:\n  upper: {surface: upper.stl, motion: " + upper_motion +
                 "}\n  lower: {surface: lower.stl, motion: " + lower_motion + "}\n" + more});
    const std::string fixed =
        "to: fixed, plane: {point: [0, 0, 0], normal: [0, 0, 1], within: 0.1}";
    return text.replace(text.find(fixed), fixed.size(), "to: lower, within: 0.1");
}

constexpr const char* kTurn =
    "[{time: 0, rotation: {axis: [1, 2, 3], angle_deg: 0, centre: [5, -20, 6]}}, {time: 1, "
    "translation: [3, -4, 5], rotation: {axis: [1, 2, 3], angle_deg: 90, centre: [5, -20, 6]}}]";

TEST(MovingBones, HeldNodesGoExactlyWhereTheirBoneGoes) {
    const BlockFolder block;
    write_bones(block);
    Loaded loaded = block.load_text(
        with_bones("[{time: 0}, {time: 1, translation: [0.5, 0, 1], rotation: {axis: [0, 1, 0], "
                   "angle_deg: 20, centre: [2, 2, 12]}}]",
                   "[{time: 0}]"));
    Simulation simulation(loaded.scene, loaded.model, {});
    ASSERT_TRUE(simulation.begin().converged);
    for (const double time : {0.25, 0.5, 0.75, 1.0}) {
        ASSERT_TRUE(simulation.advance(time).converged);
        EXPECT_EQ(simulation.time(), time);
        for (const HeldGroup& group : loaded.model.held) {
            const Pose pose = pose_at(loaded.scene.bones[group.bone].motion, time);
            EXPECT_EQ(group.nodes.size(), 9u);
            for (const std::int32_t n : group.nodes)
                EXPECT_EQ(simulation.positions()[n], pose(loaded.model.rest[n]));
        }
    }
}

// Positions of 30 mm are turned to rounding, which bulk and area make 1e-11 N; equilibria
// are sought to where rounding hides them.
constexpr double kNoForce = 1e-9;

TEST(MovingBones, RigidMotionOfAllCostsNoForceAndNoVolume) {
    const BlockFolder block;
    write_bones(block);
    Loaded loaded = block.load_text(with_bones(kTurn, kTurn));
    const RunSummary run = block.run(loaded);
    for (const char* bone : {"upper", "lower"})
        for (const double f : column(run.history, std::string("muscle_at_") + bone + "_force"))
            EXPECT_LT(f, kNoForce);
    for (const double v : column(run.history, "muscle_volume"))
        EXPECT_NEAR(v, kVolume, 1e-9 * kVolume);
    // The muscle is where its bones are.
    const TetMesh last = meshfiles::read_vtu(block.out() / "frames/frame_0004.vtu");
    const Pose pose = pose_at(loaded.scene.bones[0].motion, 1);
    for (std::size_t n = 0; n < last.points.size(); ++n)
        EXPECT_LT((last.points[n] - pose(loaded.model.rest[n])).norm(), 1e-6);
}

TEST(MovingBones, AnActiveMuscleTurnsWithItsForce) {
    const BlockFolder block;
    write_bones(block);
    std::string text = with_bones(kTurn, kTurn);
    text.replace(text.find("activation: 0"), 13, "activation: [[0, 0], [0.5, 1]]");
    Loaded loaded = block.load_text(text);
    const History h = block.run(loaded).history;
    const Pose pose = pose_at(loaded.scene.bones[0].motion, 1);
    const Vec3 expected = pose.rotation * Vec3(0, 0, -kSigmaMax * kArea);
    const Vec3 force(column(h, "muscle_at_upper_force_x").back(),
                     column(h, "muscle_at_upper_force_y").back(),
                     column(h, "muscle_at_upper_force_z").back());
    EXPECT_LT((force - expected).norm(), 1e-5 * expected.norm());
}

TEST(MovingBones, BonesAreWrittenWhereTheyAre) {
    const BlockFolder block;
    write_bones(block);
    Loaded loaded = block.load_text(with_bones(kTurn, kTurn));
    (void)block.run(loaded);
    const TriMesh bone = meshfiles::read_surface(block.out() / "bones/upper_0004.vtp");
    const Pose pose = pose_at(loaded.scene.bones[0].motion, 1);
    ASSERT_EQ(bone.points.size(), loaded.bones[0].points.size());
    for (std::size_t n = 0; n < bone.points.size(); ++n)
        EXPECT_LT((bone.points[n] - pose(loaded.bones[0].points[n])).norm(), 1e-4);
    EXPECT_THAT(read_bytes(block.out() / kCollectionFile),
                ::testing::HasSubstr("bones/lower_0002.vtp"));
}

}  // namespace
}  // namespace myotet::contraction
