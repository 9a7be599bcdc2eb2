// SPDX-License-Identifier: Apache-2.0
// `myotet press` as a user runs it: a ball of triangles, and the phantom of a hollow ball.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Report/Picture.h"
#include "Segmentation/ReadLabels.h"
#include "Support/MembraneShapes.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;
using testing::Ran;
using testing::read_bytes;
using ::testing::StartsWith;
using testing::write_bytes;

constexpr int kUsage = 2, kBadInput = 3, kNotConverged = 5;

const char* const kTool = R"(title: a ball is pressed
wall: {young: 0.03, thickness: 3}
tools:
  - name: probe
    shape: sphere
    radius: 12
    direction: [0, 0, -1]
    depth: [[0, -1], [0.2, 5], [0.3, 5], [0.4, -2]]
time: {end: 0.8}
output: {every: 0.2, history: 0.02}
)";

class Press : public ::testing::Test {
protected:
    void SetUp() override {
        write_surface(even_sphere(50, 114));
        write_bytes(tool(), kTool);
    }
    void write_surface(const TriMesh& surface) {
        meshfiles::NamedMesh named;
        named.mesh.points = surface.points;
        named.faces = {{.name = "ball", .tag = 1, .triangles = surface.triangles}};
        meshfiles::write_mesh(named, folder_ / "ball.obj");
    }
    [[nodiscard]] fs::path tool() const { return folder_ / "tool.yaml"; }
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    Ran run(std::vector<std::string> more = {}, const std::string& input = "ball.obj") const {
        more.insert(more.begin(), {"press", folder_ / input, "--tool", tool().string(), "-o",
                                   out().string(), "--no-pictures", "--no-report"});
        return testing::run_program(MYOTET_PROGRAM, more);
    }
    Json report_of(const std::vector<std::string>& more = {},
                   const std::string& input = "ball.obj") {
        const Ran ran = run(more, input);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return ran.code == 0 ? Json::parse(read_bytes(out() / "report.json")) : Json();
    }
    /// Puts `to` where `from` stands in the tool's file.
    void change(const std::string& from, const std::string& to) {
        std::string text = read_bytes(tool());
        ASSERT_NE(text.find(from), std::string::npos) << from;
        write_bytes(tool(), text.replace(text.find(from), from.size(), to));
    }
    /// Runs, checks what every refusal has in common and puts the files back.
    std::string refused(int code = kBadInput, std::vector<std::string> more = {},
                        const std::string& input = "ball.obj") {
        more.emplace_back("--quiet");
        const Ran ran = run(more, input);
        EXPECT_EQ(ran.code, code) << ran.err;
        EXPECT_EQ(ran.out, "");
        EXPECT_THAT(ran.err, StartsWith("myotet: error: "));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_FALSE(fs::exists(out()));
        SetUp();
        return ran.err;
    }
    std::string refused(const std::string& from, const std::string& to) {
        change(from, to);
        return refused();
    }
    void write_shell() {
        segmentation::write_labels(phantoms::make_phantom("shell").volume, folder_ / "shell.nii");
        change("radius: 12", "radius: 6");
        change("thickness: 3", "drag: 5");
    }
    [[nodiscard]] std::map<std::string, std::string> results() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(out()))
            if (entry.is_regular_file() && entry.path().stem() != "report")
                all[fs::relative(entry.path(), out()).string()] = read_bytes(entry.path());
        return all;
    }

    testing::TemporaryFolder folder_;
};

}  // namespace

TEST_F(Press, TellsHowABallWasPressedAndCameBack) {
    const Ran ran = run({"--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out, read_bytes(out() / "report.json"));
    const Json report = Json::parse(ran.out);
    EXPECT_EQ(report["title"], "a ball is pressed");
    EXPECT_EQ(report["completed"], true);
    EXPECT_EQ(report["reached_s"], 0.8);
    EXPECT_EQ(report["frames"], 5);
    EXPECT_EQ(report["organ"]["name"], "ball");
    EXPECT_EQ(report["organ"]["lumen"], nullptr);
    EXPECT_EQ(report["organ"]["levels"].size(), 3U);
    EXPECT_EQ(report["organ"]["levels"][0]["nodes"], 114);
    EXPECT_EQ(report["organ"]["levels"][1]["springs"], 1344);
    EXPECT_EQ(report["wall"]["thickness_mm"], 3);
    const Json& history = report["history"];
    EXPECT_GT(history["probe_force"]["most"], 0.02);
    EXPECT_EQ(history["probe_force"]["last"], 0);
    EXPECT_GT(history["probe_displacement"]["most"], 3);
    EXPECT_LT(history["probe_displacement"]["most"], 6);
    EXPECT_LT(history["largest_displacement"]["last"], 0.5);
    EXPECT_GT(history["nodes"]["most"], 130);
    EXPECT_LT(history["nodes"]["most"], 600);
    EXPECT_LT(history["volume"]["least"], history["volume"]["first"]);
    EXPECT_NEAR(history["mass"]["most"].get<double>() / history["mass"]["least"].get<double>(), 1,
                1e-12);
    for (const Json& file : report["files"])
        EXPECT_TRUE(fs::exists(out() / file.get<std::string>())) << file;
    EXPECT_THAT(read_bytes(out() / "history.csv"),
                StartsWith("time [s],probe_force [N],probe_displacement [mm],probe_x [mm],probe_y "
                           "[mm],probe_z [mm],nodes,springs,volume [mm^3],pressure [MPa],energy "
                           "[N mm],largest_displacement [mm],mass [t]\n"));
    EXPECT_THAT(read_bytes(out() / "press.pvd"),
                AllOf(HasSubstr("timestep=\"0.4\""), HasSubstr("frames/frame_0002.vtu"),
                      HasSubstr("tools/probe_0002.vtp")));
    const std::string frame = read_bytes(out() / "frames/frame_0002.vtu");
    for (const char* array : {"\"level\"", "\"mass\"", "\"force\"", "\"displacement\"",
                              "\"curvature_change\"", "TimeValue", "label_names"})
        EXPECT_THAT(frame, HasSubstr(array));
}

TEST_F(Press, DrawsFramesAndAPageThatReportMakesAgain) {
    std::vector<std::string> words{"press", folder_ / "ball.obj", "--tool", tool().string(),
                                   "-o",    out().string()};
    const Ran ran = testing::run_program(MYOTET_PROGRAM, words);
    ASSERT_EQ(ran.code, 0) << ran.err;
    const report::Picture sheet = report::read_png(out() / "pictures/press.png");
    EXPECT_GT(sheet.width, report::read_png(out() / "pictures/frame_0004.png").width);
    const std::string page = read_bytes(out() / "report.html");
    EXPECT_THAT(page, AllOf(HasSubstr("a ball is pressed"), HasSubstr("Nodes in use"),
                            HasSubstr("data:image/png")));
    ASSERT_EQ(testing::run_program(MYOTET_PROGRAM, {"report", out().string()}).code, 0);
    EXPECT_EQ(read_bytes(out() / "report.html"), page);
}

TEST_F(Press, OptionsDoWhatTheySay) {
    const Json coarse = report_of({"--levels", "0"});
    EXPECT_EQ(coarse["history"]["nodes"]["most"], 114);
    const Json refined = report_of({"--levels", "1", "--no-adapt"});
    EXPECT_EQ(refined["history"]["nodes"]["least"], 450);
    const Json loose = report_of({"--levels", "1", "--no-shape"});
    EXPECT_EQ(loose["wall"]["shape_stiffness_MPa_per_mm"], 0);
    EXPECT_GT(loose["history"]["largest_displacement"]["last"],
              refined["history"]["largest_displacement"]["last"]);
    write_surface(ico_sphere(50, 4));
    const Json remade = report_of({"--levels", "0", "--nodes", "200"});
    EXPECT_NEAR(remade["organ"]["levels"][0]["nodes"].get<double>(), 200, 50);
    EXPECT_EQ(remade["notes"].dump().find("were asked for"), std::string::npos);
}

TEST_F(Press, ForceThatDrivesATool) {
    change("depth: [[0, -1], [0.2, 5], [0.3, 5], [0.4, -2]]",
           "force: [[0, 0], [0.2, 0.05], [0.6, 0.05], [0.7, 0]]");
    const Json report = report_of({"--levels", "1"});
    EXPECT_NEAR(report["history"]["probe_force"]["most"].get<double>(), 0.05, 1e-6);
    EXPECT_NEAR(report["history"]["probe_force"]["last"].get<double>(), 0, 1e-9);
    EXPECT_GT(report["history"]["probe_displacement"]["most"], 0.3);
}

TEST_F(Press, PatchesHoldsCavityAndAPlane) {
    change("tools:\n",
           "tools:\n"
           "  - {shape: plane, name: plate, direction: [0, 0, 1],\n"
           "     depth: [[0, -1], [0.2, 2]]}\n");
    change("time:",
           "patches: [{direction: [1, 0, 0], radius: 20, force: 0.1, until: 0.3}]\n"
           "hold: {balls: [{centre: [0, 50, 0], radius: 25}], points: [3]}\n"
           "gravity: [0, 0, -9810]\n"
           "cavity: {pressure: 0.00001, bulk: 0.001}\n"
           "time:");
    const Json report = report_of({"--levels", "1"});
    const Json& history = report["history"];
    EXPECT_GT(history["plate_force"]["most"], 0);
    EXPECT_NEAR(history["patch_force"]["most"].get<double>(), 0.1, 1e-12);
    EXPECT_GT(history["patch_displacement"]["most"], 0.1);
    EXPECT_GT(report["organ"]["held_points"], 2);
    EXPECT_GT(history["pressure"]["most"], 1e-5);
}

// The wall encloses a ball of 13 mm in one of 20 mm.
TEST_F(Press, FindsTheLumenOfAWall) {
    write_shell();
    const Json report = report_of({"--levels", "1"}, "shell.nii");
    const Json& organ = report["organ"];
    const double lumen = 4.0 / 3 * std::numbers::pi * 13 * 13 * 13,
                 whole = 4.0 / 3 * std::numbers::pi * 20 * 20 * 20;
    constexpr double kVoxels = 0.02;  // of a surface in voxels of 1 mm, smoothed
    EXPECT_NEAR(organ["lumen"]["volume_mm3"].get<double>() / lumen, 1, kVoxels);
    EXPECT_NEAR(organ["lumen"]["wall_volume_mm3"].get<double>() / (whole - lumen), 1, kVoxels);
    // Volume over the mean of both areas; the distance of the walls is 7 mm.
    const double thickness = (whole - lumen) / (2 * std::numbers::pi * (13 * 13 + 20 * 20));
    EXPECT_NEAR(organ["lumen"]["wall_thickness_mm"].get<double>() / thickness, 1, kVoxels);
    EXPECT_EQ(report["wall"]["thickness_measured"], true);
    EXPECT_NEAR(organ["levels"][0]["nodes"].get<double>(), 400, 100);
    // The finest level's volume; its points lie on the sphere, its triangles within.
    EXPECT_NEAR(report["history"]["volume"]["first"].get<double>() / whole, 1, kVoxels);
    EXPECT_NEAR(report["history"]["lumen_volume"]["first"].get<double>() / lumen, 1, kVoxels);
    EXPECT_NEAR(report["history"]["lumen_volume"]["first"].get<double>() -
                    report["history"]["lumen_volume"]["least"].get<double>(),
                report["history"]["volume"]["first"].get<double>() -
                    report["history"]["volume"]["least"].get<double>(),
                1e-6);
}

TEST_F(Press, SameBytesOnOneThreadAndTwo) {
    write_shell();
    (void)report_of({"--levels", "1", "--threads", "1"}, "shell.nii");
    const auto one = results();
    (void)report_of({"--levels", "1", "--threads", "2"}, "shell.nii");
    EXPECT_EQ(one, results());
    EXPECT_GT(one.size(), 10U);
}

TEST_F(Press, EndsWithFiveWhereTheWallDoesNotBearATool) {
    change("depth: [[0, -1], [0.2, 5], [0.3, 5], [0.4, -2]]", "force: [[0, 0], [0.5, 50]]");
    const Ran ran = run({"--levels", "0"});
    EXPECT_EQ(ran.code, kNotConverged) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("does not bear its force"));
    const Json report = Json::parse(read_bytes(out() / "report.json"));
    EXPECT_EQ(report["completed"], false);
    EXPECT_TRUE(fs::exists(out() / "frames/frame_0000.vtu"));
}

TEST_F(Press, RefusesWhatTheToolsFileSaysWrong) {
    EXPECT_THAT(refused("radius: 12", "radus: 12"),
                AllOf(HasSubstr("tool.yaml:6: "), HasSubstr("did you mean 'radius'?")));
    EXPECT_THAT(refused("radius: 12", "radius: 0"), HasSubstr("above 0"));
    EXPECT_THAT(refused("shape: sphere", "shape: cube"), HasSubstr("one of sphere, plane"));
    EXPECT_THAT(refused("[0.2, 5], [0.3", "[0.2, 5], [0.1"), HasSubstr("do not ascend"));
    EXPECT_THAT(refused("time: {end: 0.8}\n", ""), HasSubstr("'time' is missing"));
    EXPECT_THAT(refused("every: 0.2, history: 0.02", "every: 0.2, history: 0.03"),
                HasSubstr("a whole multiple"));
    EXPECT_THAT(refused("young: 0.03", "material: stomch"),
                AllOf(HasSubstr("no material 'stomch'"), HasSubstr("did you mean 'stomach'?")));
    for (const char* key : {"traction", "speed", "curvature"})
        EXPECT_THAT(refused("time:", "criteria: {" + std::string(key) + ": 0}\ntime:"),
                    AllOf(HasSubstr("tool.yaml:9: '" + std::string(key) + "' is '0'"),
                          HasSubstr("above 0")));
    EXPECT_THAT(refused("time:", "hold: {points: [114]}\ntime:"), HasSubstr("has 114"));
    EXPECT_THAT(refused("time:", "hold: {tissues: liver, within: 3}\ntime:"),
                HasSubstr("has no labels"));
    EXPECT_THAT(refused("direction: [0, 0, -1]", "direction: [0, 0, -1]\n    towards: [90, 0, 0]"),
                HasSubstr("passes the organ by"));
}

TEST_F(Press, RefusesToolsInsideAndWallsTooStiff) {
    const std::string driven =
        "direction: [0, 0, -1]\n    depth: [[0, -1], [0.2, 5], [0.3, 5], [0.4, -2]]";
    EXPECT_THAT(refused(driven, "path: [[0, 1, 2, 3]]"),
                AllOf(HasSubstr("tool.yaml: "), HasSubstr("inside the organ at the start")));
    EXPECT_THAT(refused(driven, "path: [[0, 0, 0, 55]]"), HasSubstr("in the wall at the start"));
    EXPECT_THAT(refused("young: 0.03", "young: 1000000"),
                AllOf(HasSubstr("stable step"), HasSubstr("softer")));
}

TEST_F(Press, RefusesSurfacesThatAreNoWall) {
    TriMesh mesh = even_sphere(50, 20);
    mesh.triangles.push_back({0, 1, 19});
    write_surface(mesh);
    EXPECT_THAT(refused(), AllOf(HasSubstr("ball.obj: "), HasSubstr("manifold")));
    mesh = even_sphere(50, 20);
    TriMesh other = mesh;
    for (Vec3& p : other.points) p += Vec3(70, 9, 4);
    for (Triangle t : other.triangles) mesh.triangles.push_back({t[0] + 20, t[1] + 20, t[2] + 20});
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    write_surface(mesh);
    EXPECT_THAT(refused(), AllOf(HasSubstr("ball.obj: "), HasSubstr("cross")));
    write_surface(sheet(6, 6, 10));
    change("time:", "cavity: {bulk: 1}\ntime:");
    EXPECT_THAT(refused(), HasSubstr("bulk"));
    EXPECT_THAT(refused(kUsage, {"--label", "stomach"}), HasSubstr("--label"));
    EXPECT_THAT(refused(kUsage, {"--smooth", "1"}), HasSubstr("--smooth"));
    EXPECT_THAT(refused(kBadInput, {}, "none.obj"), HasSubstr("no such file"));
}

TEST_F(Press, RefusesLabelsThatAreNotThereOrSeveral) {
    segmentation::write_labels(phantoms::make_phantom("blocks").volume, folder_ / "blocks.nii");
    EXPECT_THAT(refused(kUsage, {}, "blocks.nii"), HasSubstr("--label"));
    EXPECT_THAT(refused(kBadInput, {"--label", "stomach"}, "blocks.nii"), HasSubstr("stomach"));
}

}  // namespace myotet
