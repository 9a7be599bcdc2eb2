// SPDX-License-Identifier: Apache-2.0
// The program as a user runs it: surfaces and labels to cages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Segmentation/ReadLabels.h"
#include "Support/CageShapes.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Ran;
using Json = nlohmann::json;

class CageJob : public ::testing::Test {
protected:
    fs::path save(const TriMesh& surface, const std::string& name) {
        meshfiles::NamedMesh named;
        named.mesh.points = surface.points;
        named.names = {{1, "it"}};
        named.faces = {{.name = "it", .tag = 1, .triangles = surface.triangles}};
        meshfiles::write_mesh(named, folder_ / name);
        return folder_ / name;
    }
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    Ran cage(const fs::path& input, std::vector<std::string> more = {}) {
        fs::remove_all(out());
        std::vector<std::string> words = {"cage", input, "-o", out(), "--quiet", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return testing::run_program(MYOTET_PROGRAM, words);
    }

    testing::TemporaryFolder folder_;
};

TEST_F(CageJob, ASurfaceGetsACageItsSurfaceAndWhereItsPointsLie) {
    const Ran ran = cage(save(testing::banana(40, 20), "banana.obj"),
                         {"--cell", "9", "--tries", "2", "--format", "vtu,msh"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json report = Json::parse(ran.out), tissue = report["tissues"][0];
    EXPECT_EQ(testing::read_bytes(out() / "report.json"), ran.out);
    EXPECT_EQ(tissue["enclosed"], true);
    EXPECT_EQ(tissue["offset_reached"], true);
    EXPECT_EQ(tissue["bombs_found"], tissue["bombs_defused"]);
    EXPECT_EQ(tissue["tries"].size(), 2u);
    EXPECT_LE(tissue["boundary_distance_max_mm"].get<double>(), 0.4 * 9);
    const TetMesh mesh = meshfiles::read_vtu(out() / "cage.vtu");
    EXPECT_EQ(mesh.tets.size(), tissue["tetrahedra"].get<std::size_t>());
    EXPECT_EQ(meshfiles::read_mesh(out() / "cage.msh").mesh.tets.size(), mesh.tets.size());
    EXPECT_EQ(meshfiles::read_surface(out() / "cage_surface.stl").triangles.size(),
              tissue["boundary_faces"].get<std::size_t>());
    EXPECT_THAT(testing::read_bytes(out() / "embedding.npz"), HasSubstr("weights.npy"));
}

TEST_F(CageJob, LabelsOfTwoTissuesGetACageEach) {
    const fs::path labels = folder_ / "two.nrrd";
    segmentation::write_labels(phantoms::make_phantom("blocks").volume, labels);
    const Ran ran = cage(labels, {"--tets", "200", "--offset-ratio", "0.8"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json tissues = Json::parse(ran.out)["tissues"];
    for (const Json& tissue : tissues) {
        EXPECT_EQ(tissue["enclosed"], true);
        for (const Json& file : tissue["files"]) EXPECT_TRUE(fs::exists(out() / file));
    }
}

TEST_F(CageJob, AnOpenSurfaceIsRefusedWithWhereAndHealedWhenAsked) {
    TriMesh open = testing::banana(40, 20);
    open.triangles.pop_back();
    const fs::path file = save(open, "open.obj");
    const Ran refused = cage(file, {"--cell", "9"});
    EXPECT_EQ(refused.code, 3);
    EXPECT_THAT(refused.err, HasSubstr("is open: 3 edges"));
    EXPECT_THAT(refused.err, HasSubstr("--heal"));
    EXPECT_FALSE(fs::exists(out()));
    const Ran healed =
        cage(file, {"--cell", "9", "--heal", "--spacing", "1", "--offset-ratio", "0.6"});
    EXPECT_EQ(healed.code, 0) << healed.err;
}

TEST_F(CageJob, CrossingTrianglesAndCellsTooLargeAreRefused) {
    const TriMesh crossed =
        testing::together(testing::block(Vec3::Zero(), Vec3::Constant(9)),
                          testing::block(Vec3::Constant(5), Vec3::Constant(14)));
    const Ran meets = cage(save(crossed, "crossed.obj"), {"--cell", "6"});
    EXPECT_EQ(meets.code, 3);
    EXPECT_THAT(meets.err, HasSubstr("meets itself"));
    const Ran large = cage(save(testing::banana(40, 20), "b.obj"), {"--cell", "900"});
    EXPECT_EQ(large.code, 3);
    EXPECT_THAT(large.err, HasSubstr("longest side"));
}

TEST_F(CageJob, AnOffsetOutOfReachIsSaidAndWrittenOnlyWhenAsked) {
    const fs::path file = save(testing::banana(40, 20), "b.obj");
    const Ran said = cage(file, {"--cell", "20", "--offset-ratio", "0.0001"});
    EXPECT_EQ(said.code, 5);
    EXPECT_THAT(said.err, HasSubstr("--write-unreached"));
    EXPECT_EQ(Json::parse(said.out)["tissues"][0]["files"].size(), 0u);
    EXPECT_FALSE(fs::exists(out() / "cage.vtu"));
    const Ran written =
        cage(file, {"--cell", "20", "--offset-ratio", "0.0001", "--write-unreached"});
    EXPECT_EQ(written.code, 5);
    EXPECT_TRUE(fs::exists(out() / "cage.vtu"));
}

}  // namespace
}  // namespace myotet
