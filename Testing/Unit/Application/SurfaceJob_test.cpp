// SPDX-License-Identifier: Apache-2.0
// The program as a user runs it: tissues to trimmed triangle meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Segmentation/ReadLabels.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Ran;
using Json = nlohmann::json;

constexpr const char* kEdge = "4";  // mm; the torus has a tube of 8 mm

class SurfaceJob : public ::testing::Test {
protected:
    fs::path save(const std::string& phantom) {
        const fs::path file = folder_ / (phantom + ".nrrd");
        segmentation::write_labels(phantoms::make_phantom(phantom).volume, file);
        return file;
    }
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    fs::path write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    Ran surface(const fs::path& input, std::vector<std::string> more = {}) {
        fs::remove_all(out());
        std::vector<std::string> words = {"surface", input,           "-o", out(), "--quiet",
                                          "--json",  "--edge-length", kEdge};
        words.insert(words.end(), more.begin(), more.end());
        return testing::run_program(MYOTET_PROGRAM, words);
    }
    /// The only tissue's part of the report, which keeps every promise.
    Json tissue(const fs::path& input, std::vector<std::string> more = {}) {
        const Ran ran = surface(input, std::move(more));
        EXPECT_EQ(ran.code, 0) << ran.err;
        const Json tissues = Json::parse(ran.out)["tissues"];
        EXPECT_EQ(tissues.size(), 1u);
        EXPECT_EQ(tissues[0]["notes"], Json::array());
        EXPECT_EQ(tissues[0]["crossing_triangle_pairs"], 0);
        return tissues[0];
    }

    testing::TemporaryFolder folder_;
};

TEST_F(SurfaceJob, EveryFormatHoldsTheSameSurface) {
    const fs::path torus = save("torus");
    std::size_t triangles = 0;
    for (const char* format : {"stl", "ply", "obj", "vtp", "vtk"}) {
        const Json t = tissue(torus, {"--format", format});
        const fs::path file = out() / t["files"][0].get<std::string>();
        EXPECT_EQ(file.filename(), std::string("1_torus.") + format);
        EXPECT_EQ(t["euler_characteristic"], 0);
        if (std::string(format) == "vtk") continue;  // which is not read
        const TriMesh mesh = meshfiles::read_surface(file);
        if (triangles == 0) triangles = mesh.triangles.size();
        EXPECT_EQ(mesh.triangles.size(), triangles) << format;
        EXPECT_EQ(mesh.triangles.size(), t["triangles"].get<std::size_t>());
        EXPECT_GT(volume(mesh), 0) << "outward";
    }
    const std::string bytes = testing::read_bytes(out() / "1_torus.vtk");
    EXPECT_THAT(bytes, HasSubstr("DATASET POLYDATA\nPOINTS "));
    EXPECT_THAT(bytes, HasSubstr("\nPOLYGONS " + std::to_string(triangles) + " " +
                                 std::to_string(4 * triangles) + "\n"));
}

TEST_F(SurfaceJob, AHalfSpaceCutsATubeAndPiecesKeepsOne) {
    const fs::path torus = save("torus");
    const Json half = tissue(torus, {"--trim", "0,0,0,1,0.1,0"});
    EXPECT_EQ(half["discarded"], "some");
    EXPECT_EQ(half["euler_characteristic"], 0);
    EXPECT_EQ(half["boundary_loops"], 2);
    // Another surface as the solid: the ball of 20 mm.
    const fs::path box = folder_ / "box.stl";
    const Json ball = tissue(save("sphere"));
    fs::rename(out() / ball["files"][0].get<std::string>(), box);
    const Json two = tissue(torus, {"--trim", box});
    EXPECT_EQ(two["components_out"], 1) << "the ball of 20 mm bites off the inner side";
    EXPECT_EQ(two["euler_characteristic"], 0);
    const Json one = tissue(torus, {"--trim", box, "--trim-offset", "2", "--pieces", "1"});
    EXPECT_EQ(one["components_out"], 1);
    EXPECT_LT(one["area_mm2"].get<double>(), two["area_mm2"].get<double>());
}

TEST_F(SurfaceJob, ATissueTrimsAnother) {
    const Ran ran = surface(
        save("blocks"), {"--labels", "small_block", "--trim", "large_block", "--trim-offset", "1"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    // Where sharp edges of both meet the boundary may fall short, which a note says.
    const Json t = Json::parse(ran.out)["tissues"][0];
    EXPECT_EQ(t["name"], "small_block");
    EXPECT_EQ(t["euler_characteristic"], 1) << "open where it lay on the other";
    EXPECT_EQ(t["boundary_loops"], 1);
}

TEST_F(SurfaceJob, ATissueThatARecipeMakesTrims) {
    const fs::path recipe = write("bite.yaml",
                                  "steps:\n"
                                  "  - create: bite\n"
                                  "    from: {sphere: {centre: [20, 0, 0], radius: 6}}\n"
                                  "    takes_from: sphere\n");
    const Json t =
        tissue(save("sphere"), {"--repair", recipe, "--trim", "bite", "--trim-offset", "0.5"});
    EXPECT_EQ(t["name"], "sphere");
    EXPECT_EQ(t["euler_characteristic"], 1);
    EXPECT_EQ(t["boundary_loops"], 1);
}

TEST_F(SurfaceJob, AMeshIsAnInputToo) {
    const fs::path ball = save("sphere");
    const Ran meshed = testing::run_program(
        MYOTET_PROGRAM, {"mesh", ball, "-o", folder_ / "tets", "--edge-length", "5", "--quiet"});
    ASSERT_EQ(meshed.code, 0) << meshed.err;
    const Json t = tissue(folder_ / "tets" / "1_sphere.vtu", {"--trim", "0,0,3,0,0,1"});
    EXPECT_EQ(t["euler_characteristic"], 1);
    EXPECT_EQ(t["boundary_loops"], 1);
    EXPECT_EQ(t["name"], "sphere") << "as the mesh says, not its file";
}

TEST_F(SurfaceJob, EveryFormatOfTetrahedraIsAnInputAndTrims) {
    const fs::path ball = save("sphere");
    const fs::path tets = folder_ / "tets";
    const Ran meshed = testing::run_program(
        MYOTET_PROGRAM, {"mesh", ball, "-o", tets, "--edge-length", "6", "--quiet", "--quality",
                         "draft", "--format", "vtu,msh,feb,inp,bdf,nas,xdmf,mesh"});
    ASSERT_EQ(meshed.code, 0) << meshed.err;
    std::size_t triangles = 0;
    for (const char* format : {"vtu", "msh", "feb", "inp", "bdf", "nas", "xdmf", "mesh"}) {
        SCOPED_TRACE(format);
        const fs::path file = tets / (std::string("1_sphere.") + format);
        const Json t = tissue(file);
        EXPECT_EQ(t["euler_characteristic"], 2);
        EXPECT_EQ(t["name"], "sphere");
        // .vtu keeps all digits of a coordinate, other formats most.
        if (triangles == 0) triangles = t["triangles"].get<std::size_t>();
        EXPECT_NEAR(t["triangles"].get<double>() / static_cast<double>(triangles), 1, 0.01);
    }
    const Json bitten = tissue(save("torus"), {"--trim", tets / "1_sphere.msh"});
    EXPECT_EQ(bitten["boundary_loops"], 2);
    EXPECT_EQ(bitten["euler_characteristic"], 0);
}

TEST_F(SurfaceJob, LevelSetsAreInputsAndTrim) {
    const auto level_set = [&](const char* phantom) {
        const Ran ran = testing::run_program(
            MYOTET_PROGRAM, {"levelset", save(phantom), "-o", folder_ / "sets", "--quiet"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        return folder_ / "sets" / (std::string("1_") + phantom + ".vdb");
    };
    const fs::path torus = level_set("torus"), ball = level_set("sphere");
    // The way over the file holds the same samples; only the far field is made anew.
    constexpr double kSame = 1e-3;
    for (const std::vector<std::string>& trim :
         {std::vector<std::string>{}, {"--trim", "0,0,0,1,0.1,0"}, {"--trim", ball.string()}}) {
        SCOPED_TRACE(trim.empty() ? "" : trim.back());
        const Json direct = tissue(save("torus"), trim), over_file = tissue(torus, trim);
        EXPECT_EQ(over_file["name"], "torus");
        EXPECT_EQ(over_file["label"], direct["label"]);
        for (const char* count : {"euler_characteristic", "boundary_loops", "components_out"})
            EXPECT_EQ(over_file[count], direct[count]) << count;
        for (const char* measure : {"area_mm2", "triangles"})
            EXPECT_NEAR(over_file[measure].get<double>() / direct[measure].get<double>(), 1, kSame)
                << measure;
    }
    // As a trimming solid, against the tissue's own surface.
    const Json by_set = tissue(save("torus"), {"--trim", ball});
    const Json of_ball = tissue(save("sphere"));
    const fs::path stl = folder_ / "ball.stl";
    fs::rename(out() / of_ball["files"][0].get<std::string>(), stl);
    const Json by_surface = tissue(save("torus"), {"--trim", stl});
    // Chords of the ball's surface at 4 mm lie a tenth of a millimetre inside it.
    EXPECT_NEAR(by_set["area_mm2"].get<double>() / by_surface["area_mm2"].get<double>(), 1, 0.02);
    EXPECT_EQ(by_set["euler_characteristic"], by_surface["euler_characteristic"]);
}

TEST_F(SurfaceJob, OptionsThatMeanNothingForTheInputAreRefused) {
    const fs::path ball = save("sphere");
    ASSERT_EQ(surface(ball).code, 0);
    fs::rename(out() / "1_sphere.stl", folder_ / "ball.stl");
    ASSERT_EQ(testing::run_program(MYOTET_PROGRAM, {"mesh", ball, "-o", out(), "--quiet"}).code, 0);
    fs::rename(out() / "1_sphere.vtu", folder_ / "ball.vtu");
    ASSERT_EQ(testing::run_program(MYOTET_PROGRAM, {"levelset", ball, "-o", out(), "--quiet"}).code,
              0);
    fs::rename(out() / "1_sphere.vdb", folder_ / "ball.vdb");
    const auto refused = [&](const char* input, const std::vector<std::string>& more) {
        const Ran ran = surface(folder_ / input, more);
        EXPECT_EQ(ran.code, 2) << input << " " << more[0];
        EXPECT_THAT(ran.err, HasSubstr("myotet: error: " + more[0] + ": ")) << input;
        EXPECT_FALSE(fs::exists(out() / "report.json"));
    };
    for (const char* input : {"ball.stl", "ball.vtu", "ball.vdb"}) {
        refused(input, {"--orientation", "sform"});
        refused(input, {"--one-hot"});
        refused(input, {"--labels", "1"});
        refused(input, {"--names", "names.txt"});
        refused(input, {"--close-gaps", "1"});
        refused(input, {"--repair", "recipe.yaml"});
        refused(input, {"--smoothing", "none"});
    }
    refused("ball.vtu", {"--heal"});
    refused("ball.vtu", {"--input-unit", "cm"});
    refused("ball.vdb", {"--heal"});
    refused("ball.vdb", {"--smooth", "1"});
    refused("ball.vdb", {"--spacing", "1"});
    EXPECT_THAT(surface(folder_ / "ball.vdb", {"--input-unit", "cm"}).err,
                HasSubstr("says its unit itself"));
}

TEST_F(SurfaceJob, RefusalsSayWhy) {
    const fs::path ball = save("sphere");
    const auto expect = [&](std::vector<std::string> more, int code, const char* word) {
        const Ran ran = surface(ball, std::move(more));
        EXPECT_EQ(ran.code, code) << ran.err;
        EXPECT_THAT(ran.err, HasSubstr(word));
        EXPECT_FALSE(fs::exists(out() / "report.json"));
    };
    expect({"--trim", "0,0,0,0,0,0"}, 2, "the normal, the last three numbers, is zero");
    expect({"--trim", "cube"}, 2, "is neither x,y,z,nx,ny,nz nor a tissue");
    expect({"--trim", "0,0,90,0,0,1"}, 3, "discards everything");
    expect({"--trim", "0,0,-90,0,0,1"}, 3, "discards nothing");
    expect({"--trim", write("empty.stl", "solid a\nendsolid a\n")}, 3, "empty.stl");
    expect({"--trim", write("cut.vdb", " BDV")}, 3, "cut.vdb: is no OpenVDB file");
    expect({"--trim", write("cut.msh", "$MeshFormat\n")}, 3, "cut.msh");
    expect({"--format", "step"}, 2, "--format");
    const Ran unknown = surface(write("scan.docx", "PK"));
    EXPECT_EQ(unknown.code, 3);
    EXPECT_THAT(unknown.err, HasSubstr("level sets as .vdb"));
}

}  // namespace
}  // namespace myotet
