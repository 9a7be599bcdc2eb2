// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Model.h"

#include "BlockScene.h"

namespace myotet::contraction {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Sums of some hundred terms.
constexpr double kRounding = 1e-12;

TEST(Model, MassesAreVolumeTimesDensityWhateverTheElements) {
    for (const char* elements : {"linear", "patches", "quadratic"}) {
        const BlockFolder block;
        const Loaded loaded = block.load(BlockText{.elements = elements});
        double mass = 0;
        for (const double m : loaded.model.masses) {
            EXPECT_GT(m, 0);
            mass += m;
        }
        EXPECT_NEAR(mass / (1.06e-9 * kVolume), 1, kRounding) << elements;
        EXPECT_EQ(loaded.model.rest.size(), loaded.model.masses.size());
        EXPECT_EQ(loaded.model.bodies[0].nodes, loaded.model.rest.size());
        EXPECT_EQ(loaded.model.weight, nullptr);
    }
}

TEST(Model, QuadraticElementsHoldTheMiddlesOfHeldEdges) {
    const BlockFolder block;
    const Loaded loaded = block.load(BlockText{.elements = "quadratic"});
    ASSERT_EQ(loaded.model.held.size(), 2u);
    for (const HeldGroup& group : loaded.model.held) {
        EXPECT_EQ(group.nodes.size(), 25u);  // 9 corners, 12 + 4 edges: a grid of 5 x 5
        EXPECT_TRUE(std::ranges::is_sorted(group.nodes));
        const double z = loaded.model.rest[group.nodes[0]].z();
        for (const std::int32_t n : group.nodes) EXPECT_EQ(loaded.model.rest[n].z(), z);
    }
}

TEST(Model, FibresOfABlockRunAlongItFromItsOrigin) {
    for (const char* from : {"{from: laplace}", "{from: constant, direction: [0, 0, 2]}"}) {
        const BlockFolder block;
        const Loaded loaded = block.load(BlockText{.fibres = from});
        const auto& fibres = loaded.model.bodies[0].fibres;
        ASSERT_EQ(fibres.size(), 120u);
        for (const Vec3& f : fibres) EXPECT_LT((f - Vec3::UnitZ()).norm(), 1e-9) << from;
    }
    const BlockFolder block;
    const Loaded pennate = block.load(BlockText{.fibres = "{from: laplace, pennation_deg: 20}"});
    for (const Vec3& f : pennate.model.bodies[0].fibres)
        EXPECT_NEAR(f.z(), std::cos(20 * M_PI / 180), 1e-9);
    const Loaded fitted = block.load(BlockText{.fibres = "{from: bspline}"});
    for (const Vec3& f : fitted.model.bodies[0].fibres) EXPECT_GT(f.z(), 0.9);
    EXPECT_THAT(fitted.model.bodies[0].notes,
                ::testing::Contains(StartsWith("the fitted B-spline solid lies ")));
}

TEST(Model, ABodyWithoutFibresOfAMaterialWithSomeIsRefused) {
    const BlockFolder block;
    std::string text = text_of({});
    for (const std::string line :
         {"    fibres: {from: laplace}\n", "    activation: [[0, 0], [0.5, 1], [1, 0]]\n"})
        text.erase(text.find(line), line.size());
    EXPECT_THAT(block.refusal_of(text),
                AllOf(StartsWith("2: muscle is of a material with fibres, but 'fibres' does not "),
                      HasSubstr("add 'fibres: {from: laplace}'")));
}

TEST(Model, AttachmentsThatHoldNothingOrTheSameAreRefusedAtTheirLine) {
    const BlockFolder block;
    EXPECT_THAT(block.refusal({.upper = "to: fixed, plane: {point: [0, 0, 15], normal: [0, 0, 1], "
                                        "within: 0.5}"}),
                StartsWith("10: no node of 'muscle' is within 0.5 mm of the plane, the nearest is "
                           "at 3 mm; "));
    EXPECT_THAT(block.refusal({.upper = "to: fixed, plane: {point: [0, 0, 1], normal: [0, 0, 1], "
                                        "within: 1.5}"}),
                HasSubstr("with what is fixed"));
    EXPECT_THAT(block.refusal({.upper = "to: femur, within: 1"}),
                StartsWith("10: there is no bone 'femur'"));
}

TEST(Model, BadMeshesAreRefusedAtTheBodysLine) {
    BlockFolder block;
    const TetMesh sound = myotet::test::five_tet_block(kSize, {2, 2, 6});
    TetMesh mesh = sound;
    std::swap(mesh.tets[17][0], mesh.tets[17][1]);
    mesh.tets[33][3] = mesh.tets[33][2];
    block.write_block(mesh);
    EXPECT_THAT(block.refusal(BlockText{}),
                StartsWith("2: the mesh of muscle has 2 inverted or flat tetrahedra, the first is "
                           "number 17 (from 0); "));
    mesh = sound;
    mesh.points.emplace_back(1, 2, 3);
    block.write_block(mesh);
    EXPECT_THAT(block.refusal(BlockText{}),
                StartsWith("2: the mesh of muscle has 1 points of no tetrahedron; "));
}

TEST(Model, AnOpenBoneCannotBeTouched) {
    const BlockFolder block;
    TriMesh bone = box_surface(Vec3(6, 0, 0), Vec3(9, 4, 4));
    bone.triangles.resize(bone.triangles.size() / 2);
    meshfiles::write_stl(bone, block.folder / "bone.stl");
    EXPECT_THAT(
        block.refusal({.more = "bones:\n  bone: {surface: bone.stl}\ncontact:\n  - "
                               "{between: [muscle, bone]}\n"}),
        AllOf(StartsWith("15: the surface of bone cannot be touched: "), HasSubstr("closed")));
}

}  // namespace
}  // namespace myotet::contraction
