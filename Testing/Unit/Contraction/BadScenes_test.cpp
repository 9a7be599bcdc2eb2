// SPDX-License-Identifier: Apache-2.0
// Every rule that read_scene knows, broken once.
#include "BadScene.h"

namespace myotet::contraction {
namespace {

using namespace bad;

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
              "labels, bodies, materials, bones, skeleton, attachments, contact, gravity, time, "
              "output");
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

}  // namespace
}  // namespace myotet::contraction
