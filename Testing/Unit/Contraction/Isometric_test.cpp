// SPDX-License-Identifier: Apache-2.0
// A block of muscle between two planes: forces in closed form, and what is written.
#include "BlockScene.h"
#include "Muscle/Curves.h"

namespace myotet::contraction {
namespace {

using namespace test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Equilibria leave this part of all nodal forces, see EquilibriumOptions.
constexpr double kSolved = 1e-5;
// What the program promises of a muscle's volume.
constexpr double kKept = 0.01;

// Held at the length of the scan, all of it stays as it is: fibres pull sigma_max along z,
// nothing across, and the matrix is at rest. So the force is sigma_max times the area.
TEST(Isometric, FullyActiveItPullsSigmaMaxTimesItsAreaAtBothEnds) {
    for (const char* elements : {"linear", "patches", "quadratic"}) {
        const BlockFolder block;
        const History h = block.run(BlockText{.elements = elements}).history;
        const auto lower = column(h, "muscle_at_fixed_force_z"),
                   upper = column(h, "muscle_at_fixed_2_force_z"),
                   active = column(h, "muscle_activation");
        ASSERT_EQ(lower.size(), 5u) << elements;
        EXPECT_THAT(active, ElementsAre(0, 0.5, 1, 0.5, 0));
        for (std::size_t r = 0; r < 5; ++r) {
            const double expected = active[r] * kSigmaMax * kArea;
            EXPECT_NEAR(lower[r], expected, kSolved * kSigmaMax * kArea) << elements << r;
            EXPECT_NEAR(upper[r], -expected, kSolved * kSigmaMax * kArea) << elements << r;
        }
        for (const double v : column(h, "muscle_volume")) EXPECT_NEAR(v / kVolume, 1, kKept);
        for (const double l : column(h, "muscle_length")) EXPECT_NEAR(l, kSize.z(), kSolved);
        for (const double s : column(h, "muscle_fiber_stretch")) EXPECT_NEAR(s, 1, kSolved);
    }
}

// Of a slender block its ends matter little: stretched by l with free sides it pulls
//   A [2 (l - 1/l^2)(C1 + C2/l) + sigma_max (passive(l) + a active(l))]
// [Rivlin 1948; Teran 2003, sec. 3]. Held ends stiffen it by what this allows.
TEST(Isometric, AStretchedOnePullsByItsFibresAndItsMatrix) {
    constexpr double kEnds = 0.02, kStretch = 1.1, C1 = 0.03, C2 = 0.01;
    const Vec3 size(4, 4, 40);
    BlockFolder block;
    block.write_block(myotet::test::five_tet_block(size, {2, 2, 20}));
    meshfiles::write_stl(box_surface(Vec3(-1, -1, 39.5), Vec3(5, 5, 43)),
                         block.folder / "bone.stl");
    const History h =
        block
            .run({.activation = "[[1, 0], [2, 1]]",
                  .upper = "to: bone, within: 0.1",
                  .time = "end: 2, step: 0.5",
                  .more = "bones:\n  bone: {surface: bone.stl, motion: [{time: 0}, {time: 1, "
                          "translation: [0, 0, 4]}]}\n"})
            .history;
    const auto force = column(h, "muscle_at_bone_force_z");
    const muscle::ToeCurve passive(0.05, 6.6, 1.4, muscle::ToeForm::smooth);
    const double matrix = 2 * (kStretch - 1 / (kStretch * kStretch)) * (C1 + C2 / kStretch) * kArea;
    const double resting = matrix + kSigmaMax * passive.value(kStretch) * kArea;
    EXPECT_NEAR(-force[2] / resting, 1, 3 * kEnds);  // the matrix alone feels the ends
    const double active = kSigmaMax * muscle::kTeranActive.value(kStretch) * kArea;
    EXPECT_NEAR((force[2] - force[4]) / active, 1, kEnds);
    EXPECT_NEAR(column(h, "muscle_length").back(), 44, kSolved);
}

TEST(Isometric, MuscleAndTendonByLabelInOneMesh) {
    TetMesh mesh = myotet::test::five_tet_block(kSize, {2, 2, 6});
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        double z = 0;
        for (const std::int32_t n : mesh.tets[t]) z += mesh.points[n].z() / 4;
        mesh.labels[t] = z < 8 ? 7 : 9;
    }
    BlockFolder block;
    block.write_block(mesh, {{7, "belly"}, {9, "cord"}});
    Loaded loaded = block.load({.material = "{belly: teran2003_muscle, 9: teran2003_tendon}"});
    const Architecture a = architecture(loaded.scene, loaded.model)[0];
    EXPECT_NEAR(a.volume, kVolume * 8 / 12, kSolved * kVolume);
    EXPECT_NEAR(a.fibre_length, 8, kSolved);
    EXPECT_NEAR(a.pcsa, kArea, kSolved * kArea);
    const RunSummary run = block.run(loaded);
    const auto force = column(run.history, "muscle_at_fixed_force_z");
    // The belly shortens until its tendon, many times as stiff, pulls as hard.
    EXPECT_GT(force[2], 0.9 * kSigmaMax * kArea);
    EXPECT_LT(force[2], kSigmaMax * kArea);
    EXPECT_LT(column(run.history, "muscle_fiber_stretch")[2], 1);
    EXPECT_NEAR(force.back(), 0, kSolved * kSigmaMax * kArea);
    for (const double v : column(run.history, "muscle_volume")) EXPECT_NEAR(v / kVolume, 1, kKept);

    EXPECT_THAT(block.refusal(BlockText{.material = "{belly: teran2003_muscle}"}),
                HasSubstr("no material is named for the tissue cord of muscle"));
    EXPECT_THAT(block.refusal(BlockText{.material = "{bely: teran2003_muscle}"}),
                HasSubstr("4: there is no tissue 'bely'; did you mean 'belly'?"));
}

TEST(Isometric, ArchitectureOfABlockIsItsLengthAndCrossSection) {
    for (const char* elements : {"patches", "quadratic"}) {
        const BlockFolder block;
        const Loaded loaded = block.load(BlockText{.elements = elements});
        const Architecture a = architecture(loaded.scene, loaded.model)[0];
        EXPECT_NEAR(a.volume, kVolume, kSolved * kVolume);
        EXPECT_NEAR(a.fibre_length, kSize.z(), kSolved * kSize.z());
        EXPECT_NEAR(a.pcsa, kArea, kSolved * kArea);
        EXPECT_NEAR(a.force, kSigmaMax * kArea, kSolved);
    }
    const BlockFolder block;
    const Loaded tendon = block.load(BlockText{.material = "teran2003_tendon"});
    EXPECT_EQ(architecture(tendon.scene, tendon.model)[0].pcsa, 0);
}

TEST(Isometric, HistoryHasItsColumnsAndFramesAreReadable) {
    const BlockFolder block;
    Loaded loaded = block.load({.more = "output: {every: 0.5}\n"});
    const RunSummary run = block.run(loaded);
    std::vector<std::string> names;
    for (const Column& c : run.history.columns) names.push_back(c.name);
    EXPECT_THAT(names, ElementsAre("time", "muscle_activation", "muscle_volume",
                                   "muscle_fiber_stretch", "muscle_max_aspect_ratio",
                                   "muscle_min_J", "muscle_length", "muscle_at_fixed_force_x",
                                   "muscle_at_fixed_force_y", "muscle_at_fixed_force_z",
                                   "muscle_at_fixed_force", "muscle_at_fixed_moment_x",
                                   "muscle_at_fixed_moment_y", "muscle_at_fixed_moment_z",
                                   "muscle_at_fixed_2_force_x", "muscle_at_fixed_2_force_y",
                                   "muscle_at_fixed_2_force_z", "muscle_at_fixed_2_force",
                                   "muscle_at_fixed_2_moment_x", "muscle_at_fixed_2_moment_y",
                                   "muscle_at_fixed_2_moment_z", "newton_iterations"));
    EXPECT_THAT(column(run.history, "time"), ElementsAre(0, 0.25, 0.5, 0.75, 1));
    const std::string csv = read_bytes(block.out() / kHistoryFile);
    EXPECT_EQ(std::ranges::count(csv, '\n'), 6);
    EXPECT_THAT(csv, HasSubstr("time [s],muscle_activation,muscle_volume [mm^3],"));

    // Frames at 0, 0.5 and 1 s, the last one where the block was at rest.
    const std::string pvd = read_bytes(block.out() / kCollectionFile);
    for (const char* file : {"frame_0000.vtu", "frame_0001.vtu", "frame_0002.vtu"}) {
        EXPECT_THAT(pvd, HasSubstr(std::string("file=\"frames/") + file));
        const TetMesh frame = meshfiles::read_vtu(block.out() / "frames" / file);
        ASSERT_EQ(frame.tets.size(), 120u);
        for (std::size_t n = 0; n < frame.points.size(); ++n)
            EXPECT_LT((frame.points[n] - loaded.model.rest[n]).norm(), kSolved * kSize.z());
    }
    EXPECT_THAT(pvd, Not(HasSubstr("frame_0003")));
    std::vector<fs::path> files;
    for (const auto& [name, bytes] : contents(block.out())) files.emplace_back(name);
    EXPECT_THAT(run.files, ::testing::UnorderedElementsAreArray(files));
}

TEST(Isometric, NodeSetsOfAMeshHoldAsPlanesDo) {
    const BlockFolder block;
    meshfiles::NamedMesh named{myotet::test::five_tet_block(kSize, {2, 2, 6}), {{0, "muscle"}}};
    meshfiles::NodeSet top{"top", {}};
    for (std::size_t n = 0; n < named.mesh.points.size(); ++n)
        if (named.mesh.points[n].z() > 11.9) top.nodes.push_back(static_cast<std::int32_t>(n));
    for (std::int32_t& label : named.mesh.labels) label = 1;
    named.names = {{1, "muscle"}};
    named.nodes = {top};
    meshfiles::write_mesh(named, block.folder / "block.inp");
    std::string text = text_of({.upper = "to: fixed, node_set: top"});
    text.replace(text.find("block.vtu"), 9, "block.inp");
    Loaded loaded = block.load_text(text);
    ASSERT_EQ(loaded.model.held.size(), 2u);
    EXPECT_EQ(loaded.model.held[1].nodes, top.nodes);
    EXPECT_NEAR(column(block.run(loaded).history, "muscle_at_fixed_2_force_z")[2],
                -kSigmaMax * kArea, kSolved * kSigmaMax * kArea);
    text.replace(text.find("node_set: top"), 13, "node_set: tip");
    EXPECT_THAT(block.refusal_of(text), HasSubstr("has no node set 'tip'"));
}

}  // namespace
}  // namespace myotet::contraction
