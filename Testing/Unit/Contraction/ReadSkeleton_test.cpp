// SPDX-License-Identifier: Apache-2.0
// Bones that go with the bodies of a skeleton.
#include <gmock/gmock.h>

#include <numbers>

#include "Contraction/KeyFrames.h"
#include "SceneFolder.h"

namespace myotet::contraction {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A hinge about x, 0.1 m up, and beyond it a slider along z.
constexpr const char* kModel = R"(<OpenSimDocument Version="40000"><Model name="m">
<gravity>0 0 -9.8</gravity><Ground name="ground"/>
<BodySet><objects>
<Body name="arm"><mass>1</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 0</inertia></Body>
<Body name="rod"><mass>1</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 0</inertia></Body>
</objects></BodySet>
<JointSet><objects>
<PinJoint name="hinge"><socket_parent_frame>f1</socket_parent_frame>
<socket_child_frame>f2</socket_child_frame><frames>
<PhysicalOffsetFrame name="f1"><socket_parent>/ground</socket_parent>
<translation>0 0 0.1</translation><orientation>0 1.5707963267948966 0</orientation>
</PhysicalOffsetFrame>
<PhysicalOffsetFrame name="f2"><socket_parent>/bodyset/arm</socket_parent>
<translation>0 0 0.1</translation><orientation>0 1.5707963267948966 0</orientation>
</PhysicalOffsetFrame></frames>
<coordinates><Coordinate name="turn"/></coordinates></PinJoint>
<SliderJoint name="slide"><socket_parent_frame>/bodyset/arm</socket_parent_frame>
<socket_child_frame>/bodyset/rod</socket_child_frame>
<coordinates><Coordinate name="way"><motion_type>translational</motion_type></Coordinate></coordinates>
</SliderJoint>
</objects></JointSet></Model></OpenSimDocument>)";

// What a spline through key frames and the keys between leave, mm.
constexpr double kPlace = 1e-6;

struct SkeletonFolder : SceneFolder {
    SkeletonFolder() { testing::write_bytes(folder / "model.osim", kModel); }
    Scene read_with(const std::string& skeleton, const std::string& bone = "body: arm") const {
        return read(text(skeleton, bone));
    }
    std::string refused(const std::string& skeleton, const std::string& bone = "body: arm") const {
        return refusal(text(skeleton, bone));
    }
    // Lines: bodies 1, bones 3, skeleton 5 on.
    static std::string text(const std::string& skeleton, const std::string& bone) {
        return "bodies:\n  biceps: {mesh: biceps.vtu, material: teran2003_tendon}\nbones:\n"
               "  radius: {surface: radius.stl, " +
               bone +
               "}\nattachments: [{body: biceps, to: radius, within: 2}]\ntime: {end: 1, step: "
               "0.1}\n" +
               skeleton;
    }
};

const std::string kTurn =
    "skeleton:\n  model: model.osim\n  keys: [{time: 0, turn: 0, way: 0}, {time: 1, turn: 90}]\n";

TEST(ReadSkeleton, ABoneTurnsAboutItsBodysJoint) {
    const SkeletonFolder files;
    const Scene scene = files.read_with(kTurn);
    const Motion& motion = scene.bones[0].motion;
    EXPECT_EQ(pose_at(motion, 0).rotation, Mat3::Identity());
    EXPECT_LT(pose_at(motion, 0).translation.norm(), kPlace);
    const Pose end = pose_at(motion, 1);
    EXPECT_LT((end(Vec3(3, 0, 100)) - Vec3(3, 0, 100)).norm(), kPlace);  // on the axis
    EXPECT_LT((end(Vec3(0, 5, 100)) - Vec3(0, 0, 105)).norm(), kPlace);
    // From rest to rest: half of the way at half of the time.
    const Pose half = pose_at(motion, 0.5);
    const double diagonal = std::numbers::sqrt2 / 2;
    EXPECT_LT((half(Vec3(0, 5, 100)) - Vec3(0, 5 * diagonal, 100 + 5 * diagonal)).norm(), 1e-3);
    // Between keys points stay as far from the axis as they are.
    for (double t = 0; t < 1; t += 0.0137)
        EXPECT_NEAR((pose_at(motion, t)(Vec3(0, 50, 100)) - Vec3(0, 0, 100)).norm(), 50, 1e-6);
}

TEST(ReadSkeleton, WhereTheModelStandsInTheScan) {
    const SkeletonFolder files;
    const Scene scene = files.read_with(
        kTurn +
        "  place: {translation: [10, 20, 30], rotation: {axis: [0, 0, 1], angle_deg: 90}}\n");
    // The axis, x of the model, is y of the scan; it passes through (10, 20, 130).
    const Pose end = pose_at(scene.bones[0].motion, 1);
    EXPECT_LT((end(Vec3(10, 99, 130)) - Vec3(10, 99, 130)).norm(), kPlace);
    EXPECT_LT((end(Vec3(5, 20, 130)) - Vec3(10, 20, 135)).norm(), kPlace);
}

TEST(ReadSkeleton, LengthsAndFilesOfMotions) {
    const SkeletonFolder files;
    testing::write_bytes(files.folder / "m.sto",
                         "m\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\ntime turn "
                         "way\n0 0 0\n1 0 0.02\n");
    const Scene scene =
        files.read_with("skeleton: {model: model.osim, motion: m.sto}\n", "body: rod");
    // A slider goes along x of its frame.
    EXPECT_LT((pose_at(scene.bones[0].motion, 1)(Vec3::Zero()) - Vec3(20, 0, 0)).norm(), kPlace);
    std::vector<std::string> names;
    for (const auto& file : input_files(scene, MYOTET_MATERIALS_DIR))
        names.push_back(file.filename());
    EXPECT_THAT(names, ::testing::IsSupersetOf({"model.osim", "m.sto"}));
}

TEST(ReadSkeleton, WhatContradictsItselfIsRefusedAtItsLine) {
    const SkeletonFolder files;
    EXPECT_EQ(files.refused(kTurn), "no refusal");
    EXPECT_THAT(files.refused(kTurn, "body: arn"),
                AllOf(StartsWith("4: the skeleton has no body 'arn'; did you mean 'arm'?")));
    EXPECT_THAT(files.refused(""), StartsWith("4: 'radius' goes with 'arm', but the scene has no "
                                              "skeleton; add 'skeleton:"));
    EXPECT_THAT(files.refused(kTurn, "body: arm, motion: [{time: 1, translation: [1, 0, 0]}]"),
                HasSubstr("has a 'motion' of its own; leave one out"));
    EXPECT_THAT(files.refused("skeleton: {model: none.osim, keys: [{time: 0, turn: 0}]}\n"),
                StartsWith("7: 'model' is 'none.osim', but there is no file"));
    EXPECT_THAT(files.refused("skeleton: {model: model.osim}\n"), StartsWith("7: "));
    testing::write_bytes(files.folder / "short.csv", "time,turn\n0,0\n0.25,0.1\n0.5,0.2\n");
    EXPECT_THAT(files.refused("skeleton: {model: model.osim, motion: short.csv}\n"),
                StartsWith("7: the motion lies between 0 and 0.5 s, but the scene takes it from 0 "
                           "to 1 s"));
}

TEST(KeyFrames, FromAFile) {
    const SkeletonFolder files;
    const auto file = files.folder / "keys.yaml";
    testing::write_bytes(file,
                         "myotet_motion: 1\ntitle: a turn\nkeys:\n  - {time: 0, turn: 1, way: "
                         "0.5}\n  - {time: 2, turn: 30}\n");
    EXPECT_TRUE(is_key_frames(file));
    EXPECT_FALSE(is_key_frames("x.mot"));
    const skeleton::Table table = read_key_frames(file);
    EXPECT_TRUE(table.in_degrees);
    EXPECT_EQ(table.title, "a turn");
    EXPECT_THAT(table.columns, ElementsAre("turn", "way"));
    EXPECT_THAT(table.times, ElementsAre(0, 2));
    EXPECT_THAT(table.rows, ElementsAre(ElementsAre(1, 0.5), ElementsAre(30, 0.5)));
}

TEST(KeyFrames, WhatIsWrongIsToldAtItsLine) {
    const SkeletonFolder files;
    const auto refused = [&](const std::string& keys) {
        const auto file = files.folder / "keys.yaml";
        testing::write_bytes(file, "myotet_motion: 1\nkeys:\n" + keys);
        try {
            (void)read_key_frames(file);
        } catch (const InputError& error) {
            return std::string(error.what()).substr(file.string().size() + 1);
        }
        return std::string("no refusal");
    };
    const std::string first = "  - {time: 0, a: 1, b: 2}\n";
    EXPECT_EQ(refused(first), "no refusal");
    EXPECT_THAT(refused("  - {time: 0}\n"), HasSubstr("names no coordinate"));
    EXPECT_THAT(refused(first + "  - {time: 0, a: 1}\n"), StartsWith("4: the key at 0 s follows"));
    EXPECT_THAT(refused(first + "  - {time: 1, c: 1}\n"),
                StartsWith("4: the first key does not name 'c'"));
    EXPECT_THAT(refused(first + "  - {time: 1, a: x}\n"), StartsWith("4: 'a' is 'x' but must be"));
    EXPECT_THAT(refused(first + "  - {time: 1, a: nan}\n"), StartsWith("4: 'a' is 'nan'"));
    EXPECT_THAT(refused(first + "  - {time: 1, a: 2}\n  - {time: 2, b: 1}\n"),
                AllOf(StartsWith("5: this key does not say where 'a' is"),
                      HasSubstr("in the first alone to hold it")));
    EXPECT_THAT(refused("  - 3\n"), StartsWith("3: a key must be a map"));
}

}  // namespace
}  // namespace myotet::contraction
