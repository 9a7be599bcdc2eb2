// SPDX-License-Identifier: Apache-2.0
// Rules of bones, attachments, contact and time, broken once.
#include "BadScene.h"

namespace myotet::contraction {
namespace {

using namespace bad;

std::string motion_refusal(const std::string& keys) {
    return refusal({.bones = "radius:\n    surface: radius.stl\n    motion:" + keys});
}

TEST(BadBones, BonesAndMotions) {
    EXPECT_THAT(refusal({.bones = "- radius"}), StartsWith("10: 'bones' must be a map"));
    EXPECT_THAT(refusal({.bones = "radius: {}"}),
                StartsWith("10: one of mesh, surface, tissue is missing in the bone 'radius'"));
    EXPECT_THAT(refusal({.bones = "radius: {surface: radius.stl, tissue: radius}"}),
                StartsWith("10: 'surface' and 'tissue' both stand in the bone 'radius'"));
    EXPECT_THAT(refusal({.bones = "radius: {surface: radius.ply}"}),
                StartsWith("10: 'surface' is 'radius.ply', but there is no file"));
    EXPECT_THAT(
        refusal({.bones = "radius: {surface: humerus.vtu}"}),
        StartsWith("10: 'surface' is 'humerus.vtu' but must be a file of a closed surface"));
    EXPECT_THAT(refusal({.bones = "radius: {mesh: radius.stl}"}),
                StartsWith("10: 'mesh' is 'radius.stl' but must be a file of tetrahedra"));
    EXPECT_THAT(refusal({.bones = "radius: {tissue: radius}"}),
                StartsWith("10: 'radius' is a tissue of a label volume, but none is given"));
    EXPECT_EQ(motion_refusal("\n      - {time: 1, translation: [1, 2, 3]}"), "no refusal");
    EXPECT_THAT(motion_refusal(" []"), StartsWith("12: 'motion' must be a list of key frames"));
    EXPECT_THAT(motion_refusal("\n      - {translation: [1, 2, 3]}"),
                StartsWith("13: 'time' is missing in a key frame"));
    EXPECT_THAT(motion_refusal("\n      - {time: -1}"),
                StartsWith("13: 'time' is '-1' but must be a time in s of at least 0"));
    EXPECT_THAT(motion_refusal("\n      - {time: 0, translation: [1, 0, 0]}"),
                StartsWith("13: the key at 0 s moves the bone"));
    EXPECT_THAT(motion_refusal("\n      - time: 2\n      - time: 1"),
                StartsWith("14: the key at 1 s follows the one at 2 s, but times must ascend"));
    EXPECT_THAT(motion_refusal("\n      - time: 0\n      - time: 0"),
                StartsWith("14: the key at 0 s follows the one at 0 s"));
    EXPECT_THAT(motion_refusal("\n      - {time: 1, translation: [1, .nan, 0]}"),
                StartsWith("13: 'translation' is '.nan' but must be a length in mm"));
    EXPECT_THAT(motion_refusal("\n      - {time: 1, rotation: {axis: [0, 0, 1], angle_deg: 9}}"),
                StartsWith("13: 'centre' is missing in a rotation"));
    EXPECT_THAT(motion_refusal("\n      - {time: 1, rotation: {axis: [0, 0, 0], angle_deg: 9}}"),
                StartsWith("13: 'axis' is [0, 0, 0] but must point somewhere"));
    EXPECT_THAT(motion_refusal("\n      - {time: 1, rotation: {axis: [0, 0, 1]}}"),
                StartsWith("13: 'angle_deg' is missing in a rotation"));
    EXPECT_THAT(
        motion_refusal("\n      - time: 1\n        rotation:\n          axis: [0, 0, 1]\n"
                       "          angle_deg: 200\n          centre: [0, 0, 0]"),
        AllOf(StartsWith("13: between the keys at 0 s and 1 s the bone turns by 200 degrees"),
              HasSubstr("put a key between them")));
}

TEST(BadBones, Attachments) {
    const auto attach = [](const std::string& a) { return refusal({.attachment = a}); };
    EXPECT_THAT(attach("to: radius, within: 2"),
                StartsWith("12: 'body' is missing in an attachment"));
    EXPECT_THAT(attach("body: biceps, within: 2"),
                StartsWith("12: 'to' is missing in an attachment"));
    EXPECT_THAT(attach("body: bicps, to: radius, within: 2"),
                StartsWith("12: there is no body 'bicps'; did you mean 'biceps'?"));
    EXPECT_THAT(attach("body: biceps, to: ulna, within: 2"),
                StartsWith("12: there is no bone 'ulna'; known are radius, fixed"));
    EXPECT_THAT(attach("body: biceps, to: radius"),
                StartsWith("12: one of within, node_set, plane is missing in an attachment"));
    EXPECT_THAT(attach("body: biceps, to: radius, within: 2, node_set: a"),
                StartsWith("12: 'within' and 'node_set' both stand in an attachment"));
    EXPECT_THAT(attach("body: biceps, to: radius, within: -2"),
                StartsWith("12: 'within' is '-2' but must be a length in mm from 0"));
    EXPECT_THAT(
        attach("body: biceps, to: fixed, within: 2"),
        StartsWith("12: 'within' is a distance from a bone, but the nodes are to be fixed"));
    EXPECT_THAT(attach("body: biceps, to: fixed, plane: {point: [0, 0, 0], within: 1}"),
                StartsWith("12: 'normal' is missing in a plane"));
    EXPECT_THAT(
        attach("body: biceps, to: fixed, plane: {point: [0, 0], normal: [0, 0, 1], within: 1}"),
        StartsWith("12: 'point' is a list of 2 but must be three numbers"));
    EXPECT_THAT(attach("body: biceps, to: radius, within: 2, end: middle"),
                StartsWith("12: 'end' is 'middle' but must be one of origin, insertion, other"));
    const SceneFolder files;
    EXPECT_THAT(files.refusal("bodies:\n  a: {mesh: biceps.vtu, material: m}\n"
                              "time: {end: 1, step: 1}\n"),
                StartsWith("2: the body 'a' is attached nowhere, so that it has no rest"));
    EXPECT_EQ(files.refusal("bodies:\n  a: {mesh: biceps.vtu, material: m}\n"
                            "time: {end: 1, step: 1, scheme: generalized-alpha}\n"),
              "no refusal");
    EXPECT_THAT(files.refusal("bodies:\n  a: {mesh: biceps.vtu, material: m}\n"
                              "attachments: {body: a}\ntime: {end: 1, step: 1}\n"),
                StartsWith("3: 'attachments' must be a list"));
}

TEST(BadBones, Contact) {
    const auto contact = [](const std::string& c) {
        return refusal({.contact = "contact:\n  - {" + c + "}\n"});
    };
    EXPECT_EQ(contact("between: [biceps, radius]"), "no refusal");
    EXPECT_THAT(contact("gap: 1"), StartsWith("16: 'between' is missing in a contact"));
    EXPECT_THAT(contact("between: biceps"),
                StartsWith("16: 'between' is 'biceps' but must be two"));
    EXPECT_THAT(contact("between: [biceps, biceps]"), StartsWith("16: 'biceps' stands twice"));
    EXPECT_THAT(contact("between: [biceps, ulna]"),
                StartsWith("16: there is no body or bone 'ulna'; known are biceps, radius"));
    EXPECT_THAT(contact("between: [biceps, radius], gap: nan"),
                StartsWith("16: 'gap' is 'nan' but"));
    EXPECT_THAT(contact("between: [biceps, radius], stiffness: 0"),
                StartsWith("16: 'stiffness' is '0' but must be a pressure a depth in MPa/mm"));
    EXPECT_THAT(contact("between: [biceps, radius]}\n  - {between: [radius, biceps]"),
                StartsWith("17: contact between 'radius' and 'biceps' stands twice"));
    EXPECT_THAT(refusal({.bones = "radius: {surface: radius.stl}\n  ulna: {surface: radius.stl}",
                         .contact = "contact:\n  - {between: [radius, ulna]}\n"}),
                StartsWith("17: 'radius' and 'ulna' are bones, which do not give way"));
    EXPECT_THAT(refusal({.contact = "contact: {between: [biceps, radius]}\n"}),
                StartsWith("15: 'contact' must be a list"));
}

TEST(BadBones, TimeGravityAndOutput) {
    const auto time = [](const std::string& t) { return refusal({.time = t}); };
    EXPECT_THAT(time("step: 0.1"),
                StartsWith("14: 'end' is missing in 'time'; add it: a time in s"));
    EXPECT_THAT(time("end: 1"), StartsWith("14: 'step' is missing in 'time'"));
    EXPECT_THAT(time("end: 0, step: 0.1"), StartsWith("14: 'end' is '0' but must be a time in s"));
    EXPECT_THAT(time("end: 1, step: nan"), StartsWith("14: 'step' is 'nan' but must be a time"));
    EXPECT_THAT(time("end: 1, step: 2"), StartsWith("14: 'step' is 2 s, but the time ends at 1 s"));
    EXPECT_THAT(time("end: 1, step: 0.1, scheme: explicit"),
                StartsWith("14: 'scheme' is 'explicit' but must be one of quasi-static, "));
    EXPECT_THAT(time("end: 1, step: 0.1, scheme: generalized-alpha, damping: -1"),
                StartsWith("14: 'damping' is '-1' but must be a rate in 1/s"));
    EXPECT_THAT(time("end: 1, step: 0.1, damping: 1"),
                StartsWith("14: 'damping' slows motion, of which quasi-static knows none"));
    EXPECT_THAT(time("end: 1, step: 0.1, scheme: generalized-alpha, rho_infinity: 1.1"),
                StartsWith("14: 'rho_infinity' is '1.1' but must be a number from 0 to 1"));
    EXPECT_THAT(time("end: 1, step: 0.1, scheme: backward-euler, rho_infinity: 0.5"),
                StartsWith("14: 'rho_infinity' is of the scheme generalized-alpha alone"));
    EXPECT_THAT(time("end: 1, step: 0.1, rho_infinity: 0.5"),
                StartsWith("14: 'rho_infinity' is of the scheme"));
    EXPECT_THAT(refusal({.rest = "gravity: 9810\n"}),
                StartsWith("15: 'gravity' is '9810' but must be three numbers"));
    EXPECT_THAT(refusal({.rest = "gravity: [0, 0, nan]\n"}), StartsWith("15: 'gravity' is 'nan'"));
    EXPECT_THAT(refusal({.rest = "output: {every: 0.01}\n"}),
                StartsWith("15: 'every' is 0.01 s, but a step takes 0.1 s"));
    EXPECT_THAT(refusal({.rest = "title: [a]\n"}), StartsWith("15: 'title' is a list of 1 but"));
}

}  // namespace
}  // namespace myotet::contraction
