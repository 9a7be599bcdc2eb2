// SPDX-License-Identifier: Apache-2.0
// The main job through the built program: what it writes, and that neither
// threads nor a stop leave other bytes than they should.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Quality/Quality.h"
#include "Segmentation/Census.h"
#include "Segmentation/ReadLabels.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Ran;
using testing::read_bytes;
using Json = nlohmann::json;

Ran mesh(const fs::path& input, const fs::path& out, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"mesh", input.string(), "-o", out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return testing::run_program(MYOTET_PROGRAM, arguments);
}

fs::path write_phantom(const testing::TemporaryFolder& folder, const std::string& name) {
    const fs::path file = folder / (name + ".nii.gz");
    const Ran ran = testing::run_program(MYOTET_PROGRAM, {"phantom", name, "-o", file.string()});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return file;
}

std::set<std::string> files_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

TEST(MeshJob, WritesEachTissueWithItsNameAndReport) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "blocks");
    const fs::path out = folder / "a folder";
    const Ran ran = mesh(scan, out, {"--json", "--edge-length", "4"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(files_in(out),
              (std::set<std::string>{"1_large_block.stl", "1_large_block.vtu", "2_small_block.stl",
                                     "2_small_block.vtu", "report.html", "report.json"}));
    EXPECT_EQ(ran.out, read_bytes(out / "report.json"));

    const Json report = Json::parse(ran.out);
    EXPECT_EQ(report["frame"], "LPS");
    EXPECT_EQ(report["units"], "mm");
    EXPECT_EQ(report["input"], scan.string());
    EXPECT_EQ(report["input_sha256"].get<std::string>().size(), 64u);
    EXPECT_EQ(report["options"]["edge_length_mm"], 4);
    EXPECT_GT(report["peak_memory_bytes"], 0);
    ASSERT_EQ(report["tissues"].size(), 2u);
    const std::vector<std::string> names = {"large_block", "small_block"};
    for (int t = 0; t < 2; ++t) {
        const Json& tissue = report["tissues"][t];
        EXPECT_EQ(tissue["label"], t + 1);
        EXPECT_EQ(tissue["name"], names[t]);
        const TetMesh read =
            meshfiles::read_vtu(out / (std::to_string(t + 1) + "_" + names[t] + ".vtu"));
        EXPECT_EQ(read.tets.size(), tissue["tets"].get<std::size_t>());
        EXPECT_EQ(read.points.size(), tissue["vertices"].get<std::size_t>());
        EXPECT_EQ(read.labels, std::vector<std::int32_t>(read.tets.size(), t + 1));
        EXPECT_DOUBLE_EQ(volume(read), tissue["volume_mesh_mm3"].get<double>());
    }
}

TEST(MeshJob, ReportHasEveryPromisedKey) {
    const testing::TemporaryFolder folder;
    const Ran ran =
        mesh(write_phantom(folder, "sphere"), folder / "out", {"--json", "--edge-length", "8"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json report = Json::parse(ran.out);
    for (const char* key : {"input", "input_sha256", "options", "version", "threads",
                            "peak_memory_bytes", "frame", "units", "seconds", "tissues"})
        EXPECT_TRUE(report.contains(key)) << key;
    for (const char* key : {"label",
                            "name",
                            "voxels",
                            "components_in",
                            "components_out",
                            "volume_labels_mm3",
                            "volume_mesh_mm3",
                            "vertices",
                            "tets",
                            "min_dihedral_deg",
                            "max_dihedral_deg",
                            "max_aspect_ratio",
                            "mean_aspect_ratio",
                            "edge_length_asked_mm",
                            "edge_length_surface_median_mm",
                            "boundary_manifold",
                            "tets_with_four_boundary_nodes",
                            "interior_edges_joining_boundary_nodes",
                            "inverted_tets",
                            "surface_distance_mean_mm",
                            "surface_distance_max_mm",
                            "seconds"})
        EXPECT_TRUE(report["tissues"][0].contains(key)) << key;
    for (const char* stage : {"lattice", "select", "compress", "check"})
        EXPECT_TRUE(report["tissues"][0]["seconds"].contains(stage)) << stage;
}

TEST(MeshJob, UniformLatticesAndDraftsKeepThePromises) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "sphere");
    const auto tissue_with = [&](const std::vector<std::string>& options) {
        std::vector<std::string> all{"--edge-length", "4", "--json"};
        all.insert(all.end(), options.begin(), options.end());
        const Ran ran = mesh(scan, folder / "out", all);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return Json::parse(ran.out);
    };
    const Json graded = tissue_with({}), uniform = tissue_with({"--lattice", "uniform"}),
               draft = tissue_with({"--quality", "draft"});
    EXPECT_EQ(uniform["options"]["lattice"], "uniform");
    EXPECT_EQ(draft["options"]["quality"], "draft");
    const Json &g = graded["tissues"][0], &u = uniform["tissues"][0], &d = draft["tissues"][0];
    EXPECT_GT(u["tets"], g["tets"]);  // the inside is as fine as the surface
    EXPECT_GT(u["min_dihedral_deg"], 28);
    EXPECT_LT(u["max_dihedral_deg"], 116);
    EXPECT_GE(d["max_aspect_ratio"], g["max_aspect_ratio"]);
    EXPECT_GT(d["min_dihedral_deg"], 14);
}

TEST(MeshJob, AnAspectRatioOutOfReachIsNoted) {
    const testing::TemporaryFolder folder;
    const Ran ran = mesh(write_phantom(folder, "sphere"), folder / "out",
                         {"--edge-length", "4", "--max-aspect-ratio", "1.5", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json report = Json::parse(ran.out);
    EXPECT_EQ(report["options"]["max_aspect_ratio"], 1.5);
    EXPECT_THAT(report["tissues"][0]["notes"].dump(), HasSubstr("beyond the 1.5 asked for"));
}

TEST(MeshJob, TableOnStdoutAndLogOnStderr) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "blocks");
    const Ran loud = mesh(scan, folder / "out", {"--edge-length", "8"});
    EXPECT_THAT(loud.out, HasSubstr("large_block"));
    EXPECT_THAT(loud.err, HasSubstr("myotet: edge length 8 mm"));
    const Ran quiet = mesh(scan, folder / "out", {"--edge-length", "8", "--quiet"});
    EXPECT_EQ(quiet.out, loud.out);
    EXPECT_EQ(quiet.err, "");
}

TEST(MeshJob, OnlyTheLabelsAskedFor) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "blocks");
    const Ran ran = mesh(scan, folder / "out", {"--edge-length", "8", "--labels", "Small_Block"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(files_in(folder / "out"),
              (std::set<std::string>{"2_small_block.stl", "2_small_block.vtu", "report.html",
                                     "report.json"}));
}

TEST(MeshJob, ATableGivenByHandNamesTheLabels) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "sphere");
    testing::write_bytes(folder / "mine.txt", "1 M. soleus / medial\n");
    const Ran ran = mesh(scan, folder / "out",
                         {"--edge-length", "8", "--names", (folder / "mine.txt").string()});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(fs::exists(folder / "out/1_M._soleus___medial.vtu"));
}

TEST(MeshJob, AboutTheTetrahedraAskedFor) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "blocks");
    constexpr double kWished = 20000, kPromised = 0.1;  // within 10 %, as --help says
    const Ran ran = mesh(scan, folder / "out", {"--json", "--tets", "20000"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json report = Json::parse(ran.out);
    double tets = 0;
    for (const Json& tissue : report["tissues"]) tets += tissue["tets"].get<double>();
    EXPECT_NEAR(tets, kWished, kPromised * kWished);
}

TEST(MeshJob, DryRunWritesNothing) {
    const testing::TemporaryFolder folder;
    const Ran ran = mesh(write_phantom(folder, "sphere"), folder / "out", {"--dry-run"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("tetrahedra"));
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(MeshJob, SurfaceUnitsBecomeMillimetres) {
    const testing::TemporaryFolder folder;
    const fs::path first = folder / "first";
    ASSERT_EQ(mesh(write_phantom(folder, "sphere"), first, {"--edge-length", "6"}).code, 0);
    fs::rename(first / "1_sphere.stl", folder / "ball.stl");
    const Ran ran = mesh(folder / "ball.stl", folder / "out",
                         {"--input-unit", "cm", "--edge-length", "60", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json tissue = Json::parse(ran.out)["tissues"][0];
    EXPECT_EQ(tissue["name"], "ball");
    EXPECT_EQ(tissue["components_in"], 1);
    const double enclosed = volume(meshfiles::read_surface(folder / "ball.stl", 10));
    // A level set of a quarter of the edge rounds the facets' edges off a little.
    constexpr double kRounding = 0.02;
    EXPECT_NEAR(tissue["volume_mesh_mm3"].get<double>(), enclosed, kRounding * enclosed);
}

/// A left-handed, oblique scan: the mesh lies where the labels lie.
TEST(MeshJob, MeshesLieInTheScansCoordinates) {
    const testing::TemporaryFolder folder;
    phantoms::PhantomOptions options;
    options.direction = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix() *
                        Vec3(1, 1, -1).asDiagonal();
    options.translation = {70, -40, 900};
    const LabelVolume labels = phantoms::make_phantom("blocks", options).volume;
    segmentation::write_labels(labels, folder / "oblique.nii.gz");
    ASSERT_EQ(mesh(folder / "oblique.nii.gz", folder / "out", {"--edge-length", "5"}).code, 0);
    for (const auto& counted : segmentation::count_labels(labels)) {
        fs::path file;
        for (const std::string& name : files_in(folder / "out"))
            if (name.starts_with(std::to_string(counted.value) + "_") && name.ends_with(".vtu"))
                file = folder / "out" / name;
        const TetMesh read = meshfiles::read_vtu(file);
        EXPECT_LT((centroid(read) - counted.centroid).norm(), labels.spacing().minCoeff());
        EXPECT_EQ(quality::measure_shapes(read).inverted_tets, 0);
    }
}

TEST(MeshJob, BytesDoNotDependOnThreads) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "arm");
    for (const char* threads : {"1", "3"})
        ASSERT_EQ(mesh(scan, folder / threads,
                       {"--edge-length", "12", "--threads", threads, "--labels", "2,10,11,12"})
                      .code,
                  0);
    const std::set<std::string> names = files_in(folder / "1");
    EXPECT_EQ(names.size(), 10u);  // four tissues, the report and its page
    EXPECT_EQ(files_in(folder / "3"), names);
    for (const std::string& name : names) {
        if (name == "report.json" || name == "report.html") continue;  // they tell times
        EXPECT_EQ(read_bytes(folder / "3" / name), read_bytes(folder / "1" / name)) << name;
    }
}

/// Waits until the program says `stage`; false when it ended before.
bool wait_for(const testing::Program& program, const std::string& stage) {
    constexpr int kPatience = 3000;  // half a minute; the stage comes within a second
    for (int i = 0; i < kPatience; ++i) {
        if (program.err().find(stage) != std::string::npos) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

TEST(MeshJob, InterruptedRunLeavesNothing) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "arm");
    const std::pair<int, const char*> stops[] = {{SIGINT, "myotet: smoothing"},
                                                 {SIGTERM, "myotet: meshing"}};
    for (const auto& [signal, stage] : stops) {
        testing::Program program(
            MYOTET_PROGRAM,
            {"mesh", scan.string(), "-o", (folder / "out").string(), "--edge-length", "1.5"});
        ASSERT_TRUE(wait_for(program, stage)) << program.err();
        program.send(signal);
        EXPECT_EQ(program.wait(), 130) << program.err();
        EXPECT_THAT(program.err(), HasSubstr("myotet: error: interrupted"));
        EXPECT_FALSE(fs::exists(folder / "out"));
    }
}

TEST(MeshJob, KilledRunLeavesNoHalfWrittenFile) {
    const testing::TemporaryFolder folder;
    const fs::path scan = write_phantom(folder, "blocks"), out = folder / "out";
    testing::Program program(MYOTET_PROGRAM,
                             {"mesh", scan.string(), "-o", out.string(), "--edge-length", "2"});
    ASSERT_TRUE(wait_for(program, "myotet: writing")) << program.err();
    program.send(SIGKILL);
    program.wait();
    if (!fs::exists(out)) return;
    for (const std::string& name : files_in(out)) {
        if (name.starts_with(".")) continue;  // a temporary, which a kill may leave
        if (name.ends_with(".vtu")) {
            EXPECT_GT(meshfiles::read_vtu(out / name).tets.size(), 0u);
        } else if (name.ends_with(".stl")) {
            EXPECT_GT(meshfiles::read_surface(out / name).triangles.size(), 0u);
        }
    }
}

TEST(Quality, TellsAGoodMeshFromABadOne) {
    const testing::TemporaryFolder folder;
    ASSERT_EQ(mesh(write_phantom(folder, "sphere"), folder / "out", {"--edge-length", "8"}).code,
              0);
    const Ran good = testing::run_program(
        MYOTET_PROGRAM, {"quality", (folder / "out/1_sphere.vtu").string(), "--json"});
    EXPECT_EQ(good.code, 0) << good.err;
    const Json label = Json::parse(good.out)["labels"][0];
    EXPECT_EQ(label["label"], 1);
    EXPECT_EQ(label["euler_characteristic"], 2);

    meshfiles::write_vtu({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {7}}, {},
                         folder / "bad.vtu");
    const Ran bad =
        testing::run_program(MYOTET_PROGRAM, {"quality", (folder / "bad.vtu").string()});
    EXPECT_EQ(bad.code, 4);
    EXPECT_THAT(bad.err, HasSubstr("label 7: 1 tetrahedra with four boundary nodes"));

    testing::write_bytes(folder / "no.vtu", "no mesh");
    EXPECT_EQ(testing::run_program(MYOTET_PROGRAM, {"quality", (folder / "no.vtu").string()}).code,
              3);
}

}  // namespace
}  // namespace myotet
