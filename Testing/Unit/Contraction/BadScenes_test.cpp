// SPDX-License-Identifier: Apache-2.0
// Every rule that read_scene knows, broken once.
#include <gmock/gmock.h>

#include "SceneFolder.h"

namespace myotet::contraction {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// What stands at a place of a scene that is sound but for it.
struct Parts {
    std::string labels, body = "mesh: biceps.vtu", material = "belly";
    std::string more;  ///< of the body
    std::string materials = "belly: {model: blemker2005_muscle}";
    std::string bones = "radius: {surface: radius.stl}";
    std::string attachment = "body: biceps, to: radius, within: 2, end: origin";
    std::string attachments;  ///< besides the two
    std::string contact;
    std::string time = "end: 1, step: 0.1";
    std::string rest;
};

// Lines: bodies 2 to 6, materials 8, bones 10, attachments 12 and 13, time 14.
std::string text_of(const Parts& p) {
    return "bodies:\n  biceps:\n    " + p.body + "\n    material: " + p.material +
           "\n    fibres: {from: laplace}\n    " + p.more + "\nmaterials:\n  " + p.materials +
           "\nbones:\n  " + p.bones + "\nattachments:\n  - {" + p.attachment +
           "}\n  - {body: biceps, to: fixed, node_set: top, end: insertion}\ntime: {" + p.time +
           "}\n" + p.attachments + p.labels + p.contact + p.rest;
}

std::string refusal(const Parts& parts) { return SceneFolder().refusal(text_of(parts)); }

TEST(BadScenes, ThePatternIsSound) { EXPECT_EQ(refusal({}), "no refusal"); }

TEST(BadScenes, YamlItself) {
    const SceneFolder files;
    EXPECT_THAT(files.refusal(""), StartsWith("1: the scene is empty"));
    EXPECT_THAT(files.refusal("- a\n"), StartsWith("1: the scene is a list of 1"));
    EXPECT_THAT(files.refusal("title: a\nbodies: {a: [}\n"), StartsWith("2: is no YAML"));
    EXPECT_THAT(files.refusal("title: a\ntitle: b\n"), StartsWith("2: 'title' stands twice"));
    EXPECT_THAT(files.refusal("title: a\n"), StartsWith("1: 'bodies' is missing in the scene"));
    EXPECT_THROW((void)read_scene("/nonexistent/scene.yaml"), IoError);
}

TEST(BadScenes, UnknownKeysAreRefusedWithTheKnownOnes) {
    EXPECT_EQ(refusal({.rest = "tilte: a\n"}),
              "15: 'tilte' is not known in the scene; did you mean 'title'? Known are title, "
              "labels, bodies, materials, bones, attachments, contact, gravity, time, output");
    EXPECT_THAT(refusal({.more = "fibers: {from: laplace}"}),
                AllOf(StartsWith("6: 'fibers' is not known in the body 'biceps'"),
                      HasSubstr("mesh, tissues, material, fibres, elements, activation")));
    EXPECT_THAT(refusal({.materials = "belly: {model: a, sigma_max: 1}"}),
                AllOf(StartsWith("8: 'sigma_max'"),
                      HasSubstr("model, density_kg_m3, viscosity, constants")));
    EXPECT_THAT(refusal({.bones = "radius: {surface: radius.stl, color: red}"}),
                AllOf(StartsWith("10: 'color'"), HasSubstr("mesh, surface, tissue, motion")));
    EXPECT_THAT(refusal({.attachment = "body: biceps, to: radius, within: 2, node: 1"}),
                AllOf(StartsWith("12: 'node'"), HasSubstr("did you mean 'body'?")));
    EXPECT_THAT(refusal({.time = "end: 1, step: 0.1, steps: 3"}), StartsWith("14: 'steps'"));
    EXPECT_THAT(refusal({.rest = "output: {evry: 1}\n"}), StartsWith("15: 'evry'"));
    EXPECT_THAT(refusal({.contact = "contact:\n  - {between: [a, b], friction: 1}\n"}),
                StartsWith("16: 'friction'"));
    EXPECT_THAT(refusal({.labels = "labels: {file: arm.nii.gz, size: 2}\n"}),
                StartsWith("15: 'size'"));
    EXPECT_THAT(refusal({.more = "activation: {file: emg.csv, col: b}"}), StartsWith("6: 'col'"));
}

TEST(BadScenes, Labels) {
    const auto labels = [](const std::string& more) {
        return refusal({.labels = "labels: {file: arm.nii.gz" + more + "}\n"});
    };
    EXPECT_THAT(
        labels(""),
        StartsWith("15: 'labels' is given, but no body and no bone is made of its tissues"));
    EXPECT_EQ(labels(", edge_length: 0"),
              "15: 'edge_length' is '0' but must be a length in mm above 0 and at most 10000");
    EXPECT_THAT(labels(", edge_length: nan"), StartsWith("15: 'edge_length' is 'nan' but must"));
    EXPECT_THAT(labels(", edge_length: 4mm"), StartsWith("15: 'edge_length' is '4mm' but must"));
    EXPECT_THAT(labels(", close_gaps: -1"), StartsWith("15: 'close_gaps' is '-1' but must be"));
    EXPECT_THAT(labels(", smoothing: strong"),
                StartsWith("15: 'smoothing' is 'strong' but must be one of curvature, "));
    EXPECT_THAT(labels(", repair: no.yaml"), HasSubstr("relative to the scene's folder"));
    EXPECT_THAT(refusal({.labels = "labels: {edge_length: 2}\n"}),
                StartsWith("15: 'file' is missing in 'labels'"));
    const SceneFolder files;
    testing::write_bytes(files.folder / "bad.yaml", "steps:\n  - clop: biceps\n");
    testing::write_bytes(files.folder / "scene.yaml",
                         text_of({.labels = "labels: {file: arm.nii.gz, repair: bad.yaml}\n"}));
    try {
        (void)read_scene(files.folder / "scene.yaml");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("bad.yaml, step 1 (line 2): 'clop' is no step"));
    }
}

TEST(BadScenes, Bodies) {
    EXPECT_THAT(SceneFolder().refusal("bodies: []\ntime: {end: 1, step: 1}\n"),
                StartsWith("1: 'bodies' must be a map of at least one body"));
    EXPECT_THAT(SceneFolder().refusal("bodies:\n  biceps:\ntime: {end: 1, step: 1}\n"),
                StartsWith("2: the body 'biceps' is empty but must be keys with values"));
    EXPECT_THAT(refusal({.body = "elements: linear"}),
                StartsWith("2: one of mesh, tissues is missing in the body 'biceps'; add it"));
    EXPECT_THAT(refusal({.body = "mesh: biceps.vtu\n    tissues: biceps"}),
                StartsWith("4: 'mesh' and 'tissues' both stand in the body 'biceps'"));
    EXPECT_THAT(refusal({.body = "mesh: bicep.vtu"}),
                AllOf(StartsWith("3: 'mesh' is 'bicep.vtu', but there is no file "),
                      HasSubstr("/bicep.vtu; names are relative to the scene's folder")));
    EXPECT_THAT(refusal({.body = "mesh: radius.stl"}),
                StartsWith("3: 'mesh' is 'radius.stl' but must be a file of tetrahedra"));
    EXPECT_THAT(refusal({.body = "tissues: biceps"}),
                StartsWith("3: 'biceps' is a tissue of a label volume, but none is given"));
    EXPECT_THAT(refusal({.body = "tissues: []"}), StartsWith("3: 'tissues' is a list of 0 but"));
    EXPECT_THAT(refusal({.labels = "labels: {file: arm.nii.gz}\n", .body = "tissues: [a, b, a]"}),
                StartsWith("3: 'a' stands twice in 'tissues'; write it once"));
    EXPECT_THAT(refusal({.labels = "labels: {file: arm.nii.gz}\n",
                         .body = "tissues: [a, b]",
                         .bones = "radius: {tissue: b}"}),
                StartsWith("10: the tissue 'b' belongs to 'biceps' already"));
    EXPECT_THAT(refusal({.more = "elements: cubic"}),
                StartsWith("6: 'elements' is 'cubic' but must be one of linear, patches, "));
    EXPECT_THAT(
        refusal({.bones = "radius: {surface: radius.stl}\n  biceps: {surface: radius.stl}"}),
        StartsWith("11: 'biceps' is a body already"));
    EXPECT_THAT(refusal({.bones = "fixed: {surface: radius.stl}"}),
                StartsWith("10: 'fixed' is what attachments call space itself"));
}

TEST(BadScenes, Materials) {
    EXPECT_THAT(refusal({.material = "[a]"}), StartsWith("4: 'material' is a list of 1 but must"));
    EXPECT_THAT(refusal({.material = "{}"}), StartsWith("4: 'material' is a map of keys but must"));
    const std::string labels = "labels: {file: arm.nii.gz}\n";
    EXPECT_THAT(refusal({.labels = labels, .body = "tissues: [a, b]", .material = "{a: belly}"}),
                StartsWith("4: 'material' names none for 'b'"));
    EXPECT_THAT(
        refusal({.labels = labels, .body = "tissues: [a, b]", .material = "{a: belly, c: belly}"}),
        AllOf(StartsWith("4: 'c' is no tissue of this body"), HasSubstr("Known are a, b")));
    EXPECT_THAT(refusal({.materials = "belly: {density_kg_m3: 1000}"}),
                StartsWith("8: 'model' is missing in the material 'belly'"));
    EXPECT_THAT(refusal({.materials = "belly: {model: a, density_kg_m3: 0}"}),
                StartsWith("8: 'density_kg_m3' is '0' but must be a density in kg/m^3 above 0"));
    EXPECT_THAT(refusal({.materials = "belly: {model: a, constants: {G1: nan}}"}),
                StartsWith("8: 'G1' is 'nan' but must be a finite number"));
    EXPECT_THAT(refusal({.materials = "belly: {model: a, constants: {G1: inf}}"}),
                StartsWith("8: 'G1' is 'inf' but must be a finite number"));
    EXPECT_THAT(refusal({.materials = "belly: {model: a, constants: [1]}"}),
                StartsWith("8: 'constants' is a list of 1 but must be a map"));
    EXPECT_THAT(refusal({.materials = "- belly"}), StartsWith("8: 'materials' must be a map"));
}

std::string fibre_refusal(const std::string& fibres) {
    return SceneFolder().refusal(
        "bodies:\n  biceps:\n    mesh: biceps.vtu\n    material: belly\n    fibres: " + fibres +
        "\nattachments:\n  - {body: biceps, to: fixed, node_set: top}\ntime: {end: 1, step: 1}\n");
}

TEST(BadScenes, Fibres) {
    EXPECT_EQ(fibre_refusal("{from: constant, direction: [1, 2, 3]}"), "no refusal");
    EXPECT_THAT(fibre_refusal("{pennation_deg: 3}"),
                StartsWith("5: 'from' is missing in fibres; add it: laplace, bspline, image or"));
    EXPECT_THAT(fibre_refusal("{from: guess}"), StartsWith("5: 'from' is 'guess' but must be one"));
    EXPECT_THAT(fibre_refusal("{from: laplace, direction: [1, 0, 0]}"),
                StartsWith("5: 'direction' is not known in fibres from laplace; known are from, "));
    EXPECT_THAT(fibre_refusal("{from: image}"),
                StartsWith("5: 'file' is missing in fibres from image"));
    EXPECT_THAT(fibre_refusal("{from: image, file: fibres.nii.gz, pennation_deg: 1}"),
                StartsWith("5: 'pennation_deg' is not known in fibres from image"));
    EXPECT_THAT(fibre_refusal("{from: bspline, direction: [1, 0, 0]}"),
                StartsWith("5: 'direction' is not known in fibres from bspline"));
    EXPECT_EQ(fibre_refusal("{from: bspline, file: solid.bspline}"), "no refusal");
    EXPECT_THAT(fibre_refusal("{from: constant}"),
                StartsWith("5: 'direction' is missing in constant fibres"));
    EXPECT_THAT(fibre_refusal("{from: constant, direction: [0, 0, 0]}"),
                StartsWith("5: 'direction' is [0, 0, 0] but must point somewhere"));
    EXPECT_THAT(fibre_refusal("{from: constant, direction: [1, nan, 0]}"),
                StartsWith("5: 'direction' is 'nan' but must be"));
    EXPECT_THAT(fibre_refusal("{from: constant, direction: [1, 0]}"),
                StartsWith("5: 'direction' is a list of 2 but must be three numbers"));
    EXPECT_THAT(fibre_refusal("{from: laplace, pennation_deg: 61}"),
                StartsWith("5: 'pennation_deg' is '61' but must be an angle from -60 to 60"));
    EXPECT_THAT(fibre_refusal("{from: laplace}"),
                AllOf(StartsWith("2: the fibres of 'biceps' run from its origin"),
                      HasSubstr("'end: origin'")));
    EXPECT_THAT(fibre_refusal("{from: bspline}"), HasSubstr("'end: origin'"));
    EXPECT_THAT(refusal({.attachment = "body: biceps, to: radius, within: 2, end: insertion"}),
                HasSubstr("'end: origin'"));
}

TEST(BadScenes, Activations) {
    const auto activation = [](const std::string& a) {
        return refusal({.more = "activation: " + a});
    };
    EXPECT_EQ(activation("1"), "no refusal");
    EXPECT_THAT(activation("1.5"),
                StartsWith("6: 'activation' is '1.5' but must be a number from"));
    EXPECT_THAT(activation("nan"), StartsWith("6: 'activation' is 'nan' but must be a number"));
    EXPECT_THAT(activation("full"), StartsWith("6: 'activation' is 'full' but must be a number"));
    EXPECT_THAT(activation("[]"), StartsWith("6: 'activation' is an empty list"));
    EXPECT_THAT(activation("[[0, 0],\n      [1]]"),
                StartsWith("7: 'activation' has a row that is"));
    EXPECT_THAT(activation("[0, 1]"), StartsWith("6: 'activation' has a row that is not two"));
    EXPECT_THAT(
        activation("[[0, 0],\n      [0, 1]]"),
        AllOf(StartsWith("7: in 'activation' the time 0 s follows 0 s"), HasSubstr("must ascend")));
    EXPECT_THAT(activation("[[0, 0], [1, -0.5]]"),
                StartsWith("6: in 'activation' the value is -0.5 but must be"));
    EXPECT_THAT(activation("{file: none.csv}"),
                StartsWith("6: 'file' is 'none.csv', but there is"));
    EXPECT_THAT(activation("{column: b}"), StartsWith("6: 'file' is missing in an activation"));
    EXPECT_THAT(SceneFolder().refusal("bodies:\n  a:\n    mesh: biceps.vtu\n    material: m\n"
                                      "    activation: 1\ntime: {end: 1, step: 1}\n"),
                StartsWith("5: the body 'a' has 'activation' but no fibres to pull along"));
    const SceneFolder files;
    testing::write_bytes(files.folder / "scene.yaml",
                         text_of({.more = "activation: {file: emg.csv, column: c}"}));
    try {
        (void)read_scene(files.folder / "scene.yaml");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("emg.csv:1: has no column 'c'"),
                                        HasSubstr("nown are biceps, b")));
    }
}

TEST(BadScenes, Excitations) {
    const auto more = [](const std::string& m) { return refusal({.more = m}); };
    EXPECT_EQ(more("excitation: 1\n    rise: 0.01\n    fall: 0.04"), "no refusal");
    EXPECT_THAT(more("activation: 1\n    excitation: 1"),
                StartsWith("7: 'activation' and 'excitation' both stand in the body 'biceps'"));
    EXPECT_THAT(more("activation: 1\n    rise: 0.01"),
                StartsWith("7: 'rise' says how activation follows an excitation, but none"));
    EXPECT_THAT(more("fall: 0.01"), StartsWith("6: 'fall' says how activation follows"));
    EXPECT_THAT(more("excitation: 2"),
                StartsWith("6: 'excitation' is '2' but must be a number from 0 to 1"));
    EXPECT_THAT(more("excitation: []"), StartsWith("6: 'excitation' is an empty list"));
    EXPECT_THAT(more("excitation: [[0, 0], [1, 7]]"),
                StartsWith("6: in 'excitation' the value is 7 but must be"));
    EXPECT_THAT(more("excitation: {column: b}"),
                StartsWith("6: 'file' is missing in an excitation"));
    EXPECT_THAT(more("excitation: 1\n    rise: 0"),
                StartsWith("7: 'rise' is '0' but must be a time in s above 0"));
    EXPECT_THAT(more("excitation: 1\n    fall: nan"), StartsWith("7: 'fall' is 'nan' but must"));
    EXPECT_THAT(more("excitation: [[-1e9, 0], [1, 1]]"),
                StartsWith("6: 'excitation' lasts 1000000001 s, but 3600 s at most"));
    EXPECT_THAT(SceneFolder().refusal("bodies:\n  a:\n    mesh: biceps.vtu\n    material: m\n"
                                      "    excitation: 1\ntime: {end: 1, step: 1}\n"),
                StartsWith("5: the body 'a' has 'excitation' but no fibres to pull along"));
}

TEST(BadScenes, ForceVelocityAndViscosity) {
    const std::string moving = "end: 1, step: 0.1, scheme: backward-euler";
    const auto curve = [&](const std::string& c) {
        return refusal({.more = "force_velocity: " + c, .time = moving});
    };
    EXPECT_EQ(curve("hill"), "no refusal");
    EXPECT_EQ(curve("{most: 1.3}"), "no refusal");
    EXPECT_THAT(curve("thelen"), StartsWith("6: 'force_velocity' is 'thelen' but must be hill or"));
    EXPECT_THAT(curve("[1]"), StartsWith("6: 'force_velocity' is"));
    EXPECT_THAT(curve("{speed: 1}"), StartsWith("6: 'speed' is not known in a force-velocity"));
    EXPECT_THAT(curve("{max_speed: 0}"), StartsWith("6: 'max_speed' is '0' but must be a speed"));
    EXPECT_THAT(curve("{shape: nan}"), StartsWith("6: 'shape' is 'nan' but must be a number"));
    EXPECT_THAT(curve("{most: 1}"), StartsWith("6: 'most' is '1' but must be a number above 1"));
    EXPECT_THAT(refusal({.more = "force_velocity: hill"}),
                StartsWith("6: 'force_velocity' is of motion, of which quasi-static knows none"));
    EXPECT_THAT(SceneFolder().refusal("bodies:\n  a:\n    mesh: biceps.vtu\n    material: m\n"
                                      "    force_velocity: hill\ntime: {end: 1, step: 1}\n"),
                StartsWith("5: the body 'a' has 'force_velocity' but no fibres"));
    const auto viscosity = [&](const std::string& v, const std::string& time) {
        return refusal({.materials = "belly: {model: a, viscosity: " + v + "}", .time = time});
    };
    EXPECT_EQ(viscosity("0.01", moving), "no refusal");
    EXPECT_EQ(viscosity("0", "end: 1, step: 0.1"), "no refusal");
    EXPECT_THAT(viscosity("-1", moving), StartsWith("8: 'viscosity' is '-1' but must be a visc"));
    EXPECT_THAT(viscosity("nan", moving), StartsWith("8: 'viscosity' is 'nan' but must be"));
    EXPECT_THAT(viscosity("0.01", "end: 1, step: 0.1"),
                StartsWith("8: 'viscosity' resists motion, of which quasi-static knows none"));
}

std::string motion_refusal(const std::string& keys) {
    return refusal({.bones = "radius:\n    surface: radius.stl\n    motion:" + keys});
}

TEST(BadScenes, BonesAndMotions) {
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

TEST(BadScenes, Attachments) {
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

TEST(BadScenes, Contact) {
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

TEST(BadScenes, TimeGravityAndOutput) {
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
