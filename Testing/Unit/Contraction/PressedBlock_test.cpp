// SPDX-License-Identifier: Apache-2.0
// A block on a fixed end that a bone presses from above.
#include "BlockScene.h"

namespace myotet::contraction {
namespace {

using namespace test;

// Forces balance to 1e-6 of all, the level set of the bone is of floats.
constexpr double kSolved = 1e-4;

std::string pressed(const std::string& more) {
    return "bodies:\n  muscle: {mesh: block.vtu, material: teran2003_muscle, elements: " + more +
           ", fibres: {from: constant, direction: [0, 0, 1]}}\nbones:\n  press: {surface: "
           "press.stl, motion: [{time: 0}, {time: 1, translation: [0, 0, -1]}]}\nattachments:\n  "
           "- {body: muscle, to: fixed, plane: {point: [0, 0, 0], normal: [0, 0, 1], within: "
           "0.1}}\ncontact:\n  - {between: [press, muscle], stiffness: 2}\ntime: {end: 1, step: "
           "0.25}\n";
}

TEST(PressedBlock, WhatPressesIsWhatTheOtherEndBears) {
    for (const char* elements : {"linear", "patches", "quadratic"}) {
        const BlockFolder block;
        meshfiles::write_stl(box_surface(Vec3(-3, -3, 12.25), Vec3(7, 7, 16)),
                             block.folder / "press.stl");
        Loaded loaded = block.load_text(pressed(elements));
        const History h = block.run(loaded).history;
        const auto contact = column(h, "press_on_muscle_contact_force"),
                   reaction = column(h, "muscle_at_fixed_force_z"),
                   area = column(h, "press_on_muscle_contact_area"),
                   depth = column(h, "press_on_muscle_max_penetration");
        EXPECT_EQ(contact[0], 0) << elements;
        // It has come 0.25 mm and just touches, to what a level set of floats tells.
        EXPECT_NEAR(depth[1], 0, kSolved) << elements;
        EXPECT_GT(contact[4], contact[2]);
        EXPECT_NEAR(contact[4] / -reaction[4], 1, kSolved) << elements;
        // The bone is flat: all of the end is pressed on, and what its rim stands for beside.
        EXPECT_GE(area[4], kArea * (1 - kSolved)) << elements;
        // p = k depth: none sinks in less than the mean of all, none more than all the way.
        EXPECT_GE(depth[4], contact[4] / (2 * area[4]) * (1 - kSolved)) << elements;
        EXPECT_LT(depth[4], 0.75) << elements;
        EXPECT_LT(column(h, "muscle_volume")[4], kVolume) << elements;
    }
}

TEST(PressedBlock, TwoBodiesPressEachOtherAlike) {
    const BlockFolder block;
    // Wider than the block, whose rim meets its flat face.
    TetMesh other = myotet::test::five_tet_block(Vec3(10, 10, 12), {5, 5, 6});
    for (Vec3& p : other.points) p += Vec3(-3, -3, 12.25);
    meshfiles::write_vtu(other, {}, block.folder / "other.vtu");
    meshfiles::write_stl(box_surface(Vec3(-4, -4, 23.5), Vec3(8, 8, 26)),
                         block.folder / "bone.stl");
    Loaded loaded = block.load_text(
        "bodies:\n  a: {mesh: block.vtu, material: teran2003_muscle, fibres: {from: constant, "
        "direction: [0, 0, 1]}}\n  b: {mesh: other.vtu, material: teran2003_muscle, fibres: "
        "{from: constant, direction: [0, 0, 1]}}\nbones:\n  bone: {surface: bone.stl, motion: "
        "[{time: 0}, {time: 1, translation: [0, 0, -1]}]}\nattachments:\n  - {body: a, to: fixed, "
        "plane: {point: [0, 0, 0], normal: [0, 0, 1], within: 0.1}}\n  - {body: b, to: bone, "
        "within: 0.1}\ncontact:\n  - {between: [a, b]}\ntime: {end: 1, step: 0.25}\n");
    const History h = block.run(loaded).history;
    const double below = column(h, "a_at_fixed_force_z").back(),
                 above = column(h, "b_at_bone_force_z").back();
    EXPECT_LT(below, -0.05);
    EXPECT_NEAR(above / -below, 1, kSolved);
    EXPECT_NEAR(column(h, "a_on_b_contact_force").back() / -below, 1, 0.01);  // all but along z
}

}  // namespace
}  // namespace myotet::contraction
