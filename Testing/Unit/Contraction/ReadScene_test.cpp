// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "SceneFolder.h"

namespace myotet::contraction {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ReadScene, AShortOneHasDefaults) {
    const Scene scene = SceneFolder().read(R"(
bodies:
  biceps: {mesh: biceps.vtu, material: blemker2005_tendon}
attachments:
  - {body: biceps, to: fixed, node_set: top}
time: {end: 1, step: 0.1}
)");
    ASSERT_EQ(scene.bodies.size(), 1u);
    const Body& body = scene.bodies[0];
    EXPECT_EQ(body.name, "biceps");
    EXPECT_EQ(body.mesh.filename(), "biceps.vtu");
    EXPECT_TRUE(body.mesh.is_absolute());
    EXPECT_EQ(body.elements, Elements::patches);
    EXPECT_EQ(body.fibres.from, FibreSource::none);
    EXPECT_EQ(value_at(body.activation, 0.5), 0);
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "blemker2005_tendon");
    EXPECT_EQ(scene.materials[0].model.name, "blemker2005_tendon");
    EXPECT_EQ(scene.materials[0].model.line, 3);
    EXPECT_EQ(scene.materials[0].density, 1.06e-9);
    EXPECT_EQ(scene.attachments[0].bone, "");
    EXPECT_EQ(scene.attachments[0].end, End::other);
    EXPECT_EQ(scene.gravity, Vec3::Zero());
    EXPECT_EQ(scene.time.scheme, Scheme::quasi_static);
    EXPECT_EQ(scene.time.rho_infinity, 0.9);
    EXPECT_EQ(scene.materials[0].viscosity, 0);
    EXPECT_FALSE(body.force_velocity);
    EXPECT_EQ(scene.output.every, 0.1);
    EXPECT_FALSE(scene.labels);
}

constexpr const char* kWhole = R"(title: biceps curl
labels:
  file: arm.nii.gz
  names: names.txt
  edge_length: 4
  smoothing: constrained
  compression: fem
  close_gaps: 2
  repair: recipe.yaml
bodies:
  biceps:
    tissues: [biceps, 31]
    material: {biceps: belly, 31: blemker2005_tendon}
    fibres: {from: laplace, pennation_deg: 10}
    elements: quadratic
    activation: {file: emg.csv}
  brachialis:
    mesh: biceps.vtu
    material: belly
    fibres: {from: constant, direction: [0, 0, 2]}
    activation: [[0, 0], [0.5, 1]]
  triceps:
    tissues: triceps
    material: belly
    fibres: {from: image, file: fibres.nii.gz}
    activation: 0.25
materials:
  belly:
    model: blemker2005_muscle
    density_kg_m3: 1000
    constants: {sigma_max: 0.25, G1: 5.0e-4}
bones:
  humerus: {mesh: humerus.vtu}
  scapula: {tissue: scapula}
  radius:
    surface: radius.stl
    motion:
      - time: 0
      - {time: 1, rotation: {axis: [0, 0, 3], angle_deg: 90, centre: [1, 2, 3]}}
      - {time: 2, rotation: {axis: [0, 0, -1], angle_deg: 0}, translation: [0, 0, 5]}
attachments:
  - {body: biceps, to: scapula, within: 2.5, end: origin}
  - {body: biceps, to: radius, node_set: distal, end: insertion}
  - body: brachialis
    to: humerus
    plane: {point: [0, 0, 10], normal: [0, 0, 5], within: 1}
  - {body: triceps, to: humerus, within: 1}
contact:
  - {between: [biceps, brachialis], gap: 0.1, stiffness: 3}
  - between: [brachialis, humerus]
gravity: [0, 0, -9810]
time: {end: 2, step: 0.01, scheme: backward-euler, damping: 5}
output: {every: 0.05}
)";

TEST(ReadScene, BodiesAndMaterials) {
    const Scene scene = SceneFolder().read(kWhole);
    ASSERT_EQ(scene.bodies.size(), 3u);
    const Body& biceps = scene.bodies[0];
    EXPECT_EQ(biceps.tissues[1].name, "31");
    EXPECT_EQ(biceps.tissues[1].line, 12);
    EXPECT_EQ(biceps.materials[1].tissue, "31");
    EXPECT_EQ(biceps.materials[1].material.name, "blemker2005_tendon");
    EXPECT_EQ(biceps.fibres.from, FibreSource::laplace);
    EXPECT_EQ(biceps.fibres.pennation_deg, 10);
    EXPECT_EQ(biceps.elements, Elements::quadratic);
    EXPECT_EQ(biceps.activation.values, (std::vector<double>{0, 0.8}));
    EXPECT_EQ(scene.bodies[1].fibres.direction, Vec3::UnitZ());
    EXPECT_EQ(scene.bodies[1].activation.times, (std::vector<double>{0, 0.5}));
    EXPECT_EQ(scene.bodies[2].fibres.file.filename(), "fibres.nii.gz");
    EXPECT_EQ(value_at(scene.bodies[2].activation, 1), 0.25);
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].name, "belly");
    EXPECT_EQ(scene.materials[0].model.name, "blemker2005_muscle");
    EXPECT_DOUBLE_EQ(scene.materials[0].density, 1e-9);
    EXPECT_EQ(scene.materials[0].constants[1].name, "G1");
    EXPECT_EQ(scene.materials[0].constants[1].value, 5e-4);
    EXPECT_EQ(scene.materials[0].constants[1].line, 31);
    EXPECT_EQ(scene.materials[1].name, "blemker2005_tendon");
}

TEST(ReadScene, BonesAndAttachments) {
    const Scene scene = SceneFolder().read(kWhole);
    ASSERT_EQ(scene.bones.size(), 3u);
    EXPECT_EQ(scene.bones[0].mesh.filename(), "humerus.vtu");
    EXPECT_EQ(scene.bones[1].tissue.name, "scapula");
    const auto& keys = scene.bones[2].motion.keys;
    ASSERT_EQ(keys.size(), 3u);
    EXPECT_EQ(keys[1].axis, Vec3::UnitZ());
    EXPECT_EQ(keys[2].centre, Vec3(1, 2, 3));  // of the key before
    EXPECT_EQ(keys[2].translation, Vec3(0, 0, 5));
    const auto& attachments = scene.attachments;
    ASSERT_EQ(attachments.size(), 4u);
    EXPECT_EQ(attachments[0].bone, "scapula");
    EXPECT_EQ(attachments[0].within, 2.5);
    EXPECT_EQ(attachments[0].end, End::origin);
    EXPECT_EQ(attachments[1].where, Where::node_set);
    EXPECT_EQ(attachments[1].node_set, "distal");
    EXPECT_EQ(attachments[1].end, End::insertion);
    EXPECT_EQ(attachments[2].where, Where::plane);
    EXPECT_EQ(attachments[2].normal, Vec3::UnitZ());
    EXPECT_EQ(attachments[2].point, Vec3(0, 0, 10));
    EXPECT_EQ(attachments[2].within, 1);
    EXPECT_EQ(attachments[2].line, 44);
}

TEST(ReadScene, TheRest) {
    const Scene scene = SceneFolder().read(kWhole);
    EXPECT_EQ(scene.title, "biceps curl");
    ASSERT_TRUE(scene.labels);
    EXPECT_EQ(scene.labels->file.filename(), "arm.nii.gz");
    EXPECT_EQ(scene.labels->names.filename(), "names.txt");
    EXPECT_EQ(scene.labels->repair.filename(), "recipe.yaml");
    EXPECT_EQ(scene.labels->edge_length, 4);
    EXPECT_EQ(scene.labels->close_gaps, 2);
    EXPECT_EQ(scene.labels->smoothing, levelset::Smoothing::constrained);
    EXPECT_EQ(scene.labels->compression, meshing::Compression::fem);
    ASSERT_EQ(scene.contacts.size(), 2u);
    EXPECT_EQ(scene.contacts[0].gap, 0.1);
    EXPECT_EQ(scene.contacts[0].stiffness, 3);
    EXPECT_EQ(scene.contacts[1].b, "humerus");
    EXPECT_EQ(scene.contacts[1].stiffness, 1);
    EXPECT_EQ(scene.gravity, Vec3(0, 0, -9810));
    EXPECT_EQ(scene.time.end, 2);
    EXPECT_EQ(scene.time.step, 0.01);
    EXPECT_EQ(scene.time.scheme, Scheme::backward_euler);
    EXPECT_EQ(scene.time.damping, 5);
    EXPECT_EQ(scene.output.every, 0.05);
}

TEST(ReadScene, MotionWithForceVelocityAndViscosity) {
    const Scene scene = SceneFolder().read(R"(
bodies:
  biceps:
    mesh: biceps.vtu
    material: belly
    fibres: {from: constant, direction: [0, 0, 1]}
    excitation: {file: emg.csv, column: b}
    force_velocity: hill
  brachialis:
    mesh: biceps.vtu
    material: belly
    fibres: {from: constant, direction: [0, 0, 1]}
    excitation: 0.5
    rise: 0.02
    force_velocity: {max_speed: 8, most: 1.5}
  fat: {mesh: biceps.vtu, material: belly}
materials:
  belly: {model: blemker2005_muscle, viscosity: 0.002}
time: {end: 0.5, step: 0.1, scheme: generalized-alpha, rho_infinity: 0.6}
)");
    const muscle::ForceVelocity hill;
    const Body &biceps = scene.bodies[0], &brachialis = scene.bodies[1];
    ASSERT_TRUE(biceps.force_velocity && brachialis.force_velocity);
    EXPECT_EQ(biceps.force_velocity->max_speed, hill.max_speed);
    EXPECT_EQ(brachialis.force_velocity->max_speed, 8);
    EXPECT_EQ(brachialis.force_velocity->shape, hill.shape);
    EXPECT_EQ(brachialis.force_velocity->most, 1.5);
    EXPECT_FALSE(scene.bodies[2].force_velocity);
    EXPECT_EQ(biceps.activation_file.filename(), "emg.csv");
    EXPECT_EQ(biceps.activation.times.size(), 501u);
    EXPECT_EQ(biceps.activation.times.back(), 0.5);
    const muscle::ActivationDynamics slower{.rise = 0.02};
    constexpr double kRounding = 1e-12;
    EXPECT_NEAR(value_at(brachialis.activation, 0.05), slower.after(0, 0.5, 0.05), kRounding);
    EXPECT_EQ(scene.materials[0].viscosity, 0.002);
    EXPECT_EQ(scene.time.scheme, Scheme::generalized_alpha);
    EXPECT_EQ(scene.time.rho_infinity, 0.6);
}

TEST(ReadScene, InputFilesAreAllThatIsRead) {
    const SceneFolder files;
    testing::write_bytes(files.folder / "recipe.yaml",
                         "steps:\n  - union: biceps\n    with: {surface: extra.stl}\n");
    testing::write_bytes(files.folder / "extra.stl", "surface");
    std::vector<std::string> names;
    for (const auto& file : input_files(files.read(kWhole), "materials"))
        names.push_back(file.filename());
    EXPECT_THAT(names,
                ElementsAre("scene.yaml", "arm.nii.gz", "names.txt", "recipe.yaml", "extra.stl",
                            "emg.csv", "biceps.vtu", "fibres.nii.gz", "blemker2005_muscle.yaml",
                            "blemker2005_tendon.yaml", "humerus.vtu", "radius.stl"));
}

TEST(ReadScene, AFingerprintChangesWithEveryFileAndNotWithTheFolder) {
    const SceneFolder files, others;
    const std::filesystem::path materials = files.folder / "materials";
    std::filesystem::copy(MYOTET_MATERIALS_DIR, materials);
    const std::string before = fingerprint(files.read(kWhole), materials);
    EXPECT_EQ(fingerprint(others.read(kWhole), MYOTET_MATERIALS_DIR), before);
    EXPECT_NE(fingerprint(files.read(std::string(kWhole) + "# a word\n"), materials), before);
    testing::write_bytes(materials / "blemker2005_muscle.yaml", "another");
    const std::string changed = fingerprint(files.read(kWhole), materials);
    EXPECT_NE(changed, before);
    testing::write_bytes(files.folder / "radius.stl", "another");
    EXPECT_NE(fingerprint(files.read(kWhole), materials), changed);
}

TEST(FindLabel, ByNameOrValue) {
    Scene scene;
    scene.file = "scene.yaml";
    const std::map<std::int32_t, std::string> names{
        {1, "bone"}, {2, "biceps"}, {3, ""}, {5, "bone"}};
    EXPECT_EQ(find_label(scene, {"biceps", 4}, names), 2);
    EXPECT_EQ(find_label(scene, {"3", 4}, names), 3);
    EXPECT_EQ(find_label(scene, {"5", 4}, names), 5);
    const auto refusal = [&](const std::string& word) -> std::string {
        try {
            (void)find_label(scene, {word, 4}, names);
        } catch (const InputError& error) {
            return error.what();
        }
        return "no refusal";
    };
    EXPECT_EQ(refusal("bicps"),
              "scene.yaml:4: there is no tissue 'bicps'; did you mean 'biceps'? Known are bone, "
              "biceps, 3, bone");
    EXPECT_THAT(refusal("bone"), HasSubstr("label 1 or label 5"));
    EXPECT_THAT(refusal("4"), HasSubstr("scene.yaml:4: there is no tissue '4'"));
}

}  // namespace
}  // namespace myotet::contraction
