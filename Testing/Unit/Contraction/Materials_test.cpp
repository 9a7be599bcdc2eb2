// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Materials.h"

#include "BlockScene.h"

namespace myotet::contraction {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const fs::path kFolder = MYOTET_MATERIALS_DIR;

TEST(Materials, EverySetThatComesWithMyotetIsRead) {
    int sets = 0;
    for (const auto& entry : fs::directory_iterator(kFolder)) {
        ++sets;
        const muscle::TissueMaterial material = read_material(entry.path());
        EXPECT_GT(material.bulk, 0) << entry.path();
        EXPECT_NE(material.fibres, muscle::FibreCurve::none) << entry.path();
    }
    EXPECT_EQ(sets, 4);
    const muscle::TissueMaterial teran = read_material(kFolder / "teran2003_muscle.yaml");
    EXPECT_EQ(teran.C1, 0.03);
    EXPECT_EQ(teran.sigma_max, kSigmaMax);
    EXPECT_EQ(teran.fibre_stretch, muscle::FibreStretch::full);
}

TEST(Materials, ASceneChangesConstants) {
    const BlockFolder block;
    const Loaded loaded = block.load(
        {.material = "belly",
         .more = "materials:\n  belly: {model: teran2003_muscle, constants: {sigma_max: 0.2}}\n"});
    const muscle::TissueMaterial material =
        material_of(loaded.scene, loaded.scene.materials[0], kFolder);
    EXPECT_EQ(material.sigma_max, 0.2);
    EXPECT_EQ(material.C1, 0.03);
    EXPECT_EQ(loaded.model.bodies[0].greatest_tension, 0.2);
}

// Lines: body 2 to 7, attachments 8 to 10, time 11, materials 12 and 13.
TEST(Materials, WhatASceneSaysOfThemIsRefusedAtItsLine) {
    const BlockFolder block;
    EXPECT_THAT(block.refusal(BlockText{.material = "teran2003_muscel"}),
                AllOf(StartsWith("4: there is no model 'teran2003_muscel'; did you mean "
                                 "'teran2003_muscle'? Known are blemker2005_muscle, "),
                      HasSubstr("or name a file of your own that ends in .yaml")));
    const auto belly = [&](const std::string& what) {
        return block.refusal(
            {.material = "belly", .more = "materials:\n  belly: {" + what + "}\n"});
    };
    EXPECT_THAT(belly("model: own.yaml"), StartsWith("13: there is no file "));
    EXPECT_THAT(belly("model: teran2003_muscle, constants: {sigma_min: 1}"),
                AllOf(StartsWith("13: "), HasSubstr("sigma_min"), HasSubstr("sigma_max")));
    EXPECT_THAT(belly("model: teran2003_muscle, constants: {L1: 1}"),
                AllOf(StartsWith("13: "), HasSubstr("L1")));
    EXPECT_THAT(belly("model: teran2003_muscle, constants: {bulk: -1}"),
                AllOf(StartsWith("13: "), HasSubstr("bulk"), HasSubstr("-1")));
}

TEST(Materials, AFileIsRefusedAtItsLine) {
    const testing::TemporaryFolder folder;
    const auto refusal = [&](const std::string& text) {
        testing::write_bytes(folder / "own.yaml", text);
        try {
            (void)read_material(folder / "own.yaml");
        } catch (const InputError& error) {
            const std::string said = error.what(), file = (folder / "own.yaml").string() + ":";
            EXPECT_EQ(said.substr(0, file.size()), file);
            return said.substr(std::min(said.size(), file.size()));
        }
        return std::string("no refusal");
    };
    const std::string sound =
        "myotet_material: 1\nfibres: teran_muscle\nfibre_stretch: full\nconstants:\n  C1: 0.03\n"
        "  bulk: 10\n  sigma_max: 0.3\n  P1: 0.05\n  P2: 6.6\n  linear_stretch: 1.4\n";
    EXPECT_EQ(refusal(sound), "no refusal");
    EXPECT_THAT(refusal("fibres: none\n"), HasSubstr("'myotet_material' is missing"));
    EXPECT_THAT(refusal("myotet_material: 2\n"), StartsWith("1: 'myotet_material' is '2'"));
    EXPECT_THAT(refusal("myotet_material: 1\nfibres: hill\n"),
                AllOf(StartsWith("2: "), HasSubstr("hill"), HasSubstr("teran_muscle")));
    EXPECT_THAT(refusal(sound + "  G3: 1\n"), AllOf(StartsWith("11: "), HasSubstr("G3")));
    EXPECT_THAT(refusal(sound + "  G1: nan\n"), AllOf(StartsWith("11: "), HasSubstr("nan")));
    EXPECT_THAT(refusal(sound + "colour: red\n"), StartsWith("11: 'colour' is not known"));
    EXPECT_THAT(refusal("myotet_material: 1\nconstants: 3\n"),
                StartsWith("2: 'constants' must be a map"));
    EXPECT_THROW((void)read_material(folder / "absent.yaml"), IoError);
}

}  // namespace
}  // namespace myotet::contraction
