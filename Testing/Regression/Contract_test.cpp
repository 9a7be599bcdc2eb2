// SPDX-License-Identifier: Apache-2.0
// `myotet contract` as a user runs it, on a block of muscle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "MeshFiles/MeshFiles.h"
#include "Support/ReferenceCase.h"
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

constexpr int kBadInput = 3, kNotConverged = 5, kInterrupted = 130;
constexpr double kForce = 0.3 * 16;  // N, sigma_max times the block's area
// Equilibria leave this part of all nodal forces.
constexpr double kSolved = 1e-5;

const char* const kScene = R"(title: a block, isometric
bodies:
  muscle:
    mesh: block.vtu
    material: teran2003_muscle
    fibres: {from: laplace}
    activation: {file: drive.csv}
attachments:
  - {body: muscle, to: fixed, plane: {point: [0, 0, 0], normal: [0, 0, 1], within: 0.1}, end: origin}
  - {body: muscle, to: bone, within: 0.1, end: insertion}
bones:
  bone: {surface: bone.stl}
time: {end: 2, step: 0.125}
)";

class Contract : public ::testing::Test {
protected:
    void SetUp() override {
        write_block({2, 2, 6});
        write_bone(Vec3(-1, -1, 11.5), Vec3(6, 6, 3));
        write_bytes(folder_ / "drive.csv", "time,muscle\n0,0\n1,1\n2,0\n");
        write_bytes(scene(), kScene);
    }
    void write_block(const std::array<int, 3>& cells) {
        meshfiles::write_vtu(test::five_tet_block(Vec3(4, 4, 12), cells), {},
                             folder_ / "block.vtu");
    }
    void write_bone(const Vec3& low, const Vec3& size) {
        TetMesh bone = test::five_tet_block(size, {2, 2, 2});
        for (Vec3& p : bone.points) p += low;
        meshfiles::write_stl(boundary_surface(bone), folder_ / "bone.stl");
    }
    [[nodiscard]] fs::path scene() const { return folder_ / "scene.yaml"; }
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    [[nodiscard]] std::vector<std::string> words(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"contract", scene().string(), "-o", out().string()});
        return more;
    }
    Ran run(const std::vector<std::string>& more = {}) const {
        return testing::run_program(MYOTET_PROGRAM, words(more));
    }
    /// Puts `to` where `from` stands in a file.
    void change(const std::string& file, const std::string& from, const std::string& to) {
        std::string text = read_bytes(folder_ / file);
        ASSERT_NE(text.find(from), std::string::npos) << from;
        write_bytes(folder_ / file, text.replace(text.find(from), from.size(), to));
    }
    /// Runs, checks what every refusal has in common and puts the scene back.
    std::string refused() {
        const Ran ran = run({"--quiet"});
        EXPECT_EQ(ran.code, kBadInput) << ran.err;
        EXPECT_EQ(ran.out, "");
        EXPECT_THAT(ran.err, StartsWith("myotet: error: "));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_FALSE(fs::exists(out()));
        SetUp();
        return ran.err;
    }
    std::string refused(const std::string& from, const std::string& to) {
        change("scene.yaml", from, to);
        return refused();
    }
    /// Files of the results and their bytes, but for the report and its page, which tell times.
    [[nodiscard]] std::map<std::string, std::string> results() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(out()))
            if (entry.is_regular_file() && entry.path().stem() != "report")
                all[fs::relative(entry.path(), out()).string()] = read_bytes(entry.path());
        return all;
    }

    testing::TemporaryFolder folder_;
};

TEST_F(Contract, TellsWhatABlockDid) {
    const Ran ran = run({"--json", "--threads", "2"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out, read_bytes(out() / "report.json"));
    const Json report = Json::parse(ran.out);
    EXPECT_EQ(report["title"], "a block, isometric");
    EXPECT_EQ(report["frame"], "LPS");
    EXPECT_EQ(report["units"], "mm, N, MPa, s");
    EXPECT_EQ(report["threads"], 2);
    EXPECT_EQ(report["completed"], true);
    EXPECT_EQ(report["interrupted"], false);
    EXPECT_EQ(report["message"], "the end was reached");
    EXPECT_EQ(report["reached_s"], 2);
    EXPECT_EQ(report["resumed_from_s"], nullptr);
    EXPECT_EQ(report["failed_steps"], 0);
    EXPECT_GE(report["steps"], 16);
    EXPECT_LT(report["largest_residual"], kSolved);
    EXPECT_EQ(report["scene_sha256"].get<std::string>().size(), 64u);
    EXPECT_EQ(report["warnings"], Json::array());
    const Json body = report["bodies"].at(0);
    EXPECT_EQ(body["name"], "muscle");
    EXPECT_EQ(body["nodes"], 63);
    EXPECT_EQ(body["tets"], 120);
    EXPECT_NEAR(body["pcsa_mm2"], 16, 16 * kSolved);
    EXPECT_NEAR(body["fibre_length_mm"], 12, 12 * kSolved);
    EXPECT_NEAR(body["isometric_force_expected_N"], kForce, kForce * kSolved);
    const Json force = report["history"]["muscle_at_bone_force"];
    EXPECT_EQ(force["unit"], "N");
    EXPECT_NEAR(force["most"], kForce, kForce * kSolved);
    EXPECT_NEAR(force["last"], 0, kForce * kSolved);
    EXPECT_NEAR(report["history"]["muscle_at_fixed_force_z"]["most"], kForce, kForce * kSolved);
    std::map<std::string, int> kinds;
    for (const Json& file : report["files"]) {
        EXPECT_TRUE(fs::exists(out() / file.get<std::string>())) << file;
        ++kinds[fs::path(file.get<std::string>()).extension().string()];
    }
    for (const char* kind : {".vtu", ".vtp"}) EXPECT_EQ(kinds[kind], 17) << kind;
    for (const char* kind : {".csv", ".pvd", ".myotet"}) EXPECT_EQ(kinds[kind], 1) << kind;
}

TEST_F(Contract, ADryRunWritesNothing) {
    const Ran ran = run({"--dry-run", "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NEAR(Json::parse(ran.out)["bodies"].at(0)["pcsa_mm2"], 16, 16 * kSolved);
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Contract, BadScenesAreRefusedInASentenceAndNothingIsWritten) {
    const std::string at = (scene().string() + ":");
    EXPECT_THAT(refused("to: bone,", "to: bune,"),
                AllOf(HasSubstr(at + "10: there is no bone 'bune'"), HasSubstr("mean 'bone'")));
    EXPECT_THAT(refused("surface: bone.stl", "tissue: bone"), HasSubstr(at + "12: 'bone' is a "));
    EXPECT_THAT(refused("material: teran2003_muscle", "material: {belly: teran2003_muscle}"),
                HasSubstr(at + "5: there is no tissue 'belly'"));
    EXPECT_THAT(refused("within: 0.1, end: insertion", "node_set: tip, end: insertion"),
                HasSubstr(at + "10: the mesh of 'muscle' has no node set 'tip'"));
    EXPECT_THAT(refused("point: [0, 0, 0]", "point: [0, 0, -9]"),
                HasSubstr(at + "9: no node of 'muscle' is within 0.1 mm of the plane"));
    EXPECT_THAT(refused("{file: drive.csv}", "1.5"),
                AllOf(HasSubstr(at + "7: "), HasSubstr("1.5")));
    EXPECT_THAT(refused("teran2003_muscle", "teran2004"),
                AllOf(HasSubstr(at + "5: there is no model 'teran2004'"),
                      HasSubstr("known are blemker2005_muscle, ")));
    EXPECT_THAT(refused("time:",
                        "materials: {teran2003_muscle: {model: teran2003_muscle, "
                        "constants: {C3: 1}}}\ntime:"),
                AllOf(HasSubstr(at + "13: "), HasSubstr("C3")));
    change("drive.csv", "1,1", "1,nan");
    EXPECT_THAT(refused(), HasSubstr("drive.csv:3: column 'muscle' holds 'nan'"));
    TetMesh mesh = test::five_tet_block(Vec3(4, 4, 12), {2, 2, 6});
    std::swap(mesh.tets[5][0], mesh.tets[5][1]);
    meshfiles::write_vtu(mesh, {}, folder_ / "block.vtu");
    EXPECT_THAT(refused(), AllOf(HasSubstr(at + "3: "), HasSubstr("1 inverted or flat")));
    meshfiles::write_vtu(mesh, {}, folder_ / "block.vtu");
    fs::resize_file(folder_ / "block.vtu", 900);
    EXPECT_THAT(refused(), HasSubstr("block.vtu"));
}

TEST_F(Contract, AResumeThatCannotBeIsRefused) {
    Ran ran = run({"--resume", "--quiet"});
    EXPECT_EQ(ran.code, kBadInput);
    EXPECT_THAT(ran.err, AllOf(StartsWith("myotet: error: "), HasSubstr("is not there")));
    EXPECT_FALSE(fs::exists(out()));
    ASSERT_EQ(run({"--quiet"}).code, 0);
    const auto before = results();
    change("drive.csv", "1,1", "1,0.9");
    ran = run({"--resume", "--quiet"});
    EXPECT_EQ(ran.code, kBadInput);
    EXPECT_THAT(ran.err, AllOf(HasSubstr("checkpoint.myotet"), HasSubstr("another")));
    EXPECT_EQ(results(), before);
}

TEST_F(Contract, StoppedBySigtermItGoesOnWithTheSameBytesOnAnyNumberOfThreads) {
    write_block({4, 4, 12});
    change("scene.yaml", "{surface: bone.stl}",
           "{surface: bone.stl, motion: [{time: 0}, {time: 2, translation: [1, 0, -2]}]}");
    ASSERT_EQ(run({"--quiet", "--threads", "1", "--checkpoint-every", "3"}).code, 0);
    const auto expected = results();
    fs::remove_all(out());

    testing::Program stopped(MYOTET_PROGRAM,
                             words({"--quiet", "--threads", "2", "--checkpoint-every", "3"}));
    // As soon as the fifth frame is there: the last checkpoint is two steps back.
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!fs::exists(out() / "frames/frame_0005.vtu") &&
           std::chrono::steady_clock::now() < patience)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stopped.send(SIGTERM);
    ASSERT_EQ(stopped.wait(), kInterrupted) << stopped.err();
    const Json report = Json::parse(read_bytes(out() / "report.json"));
    EXPECT_EQ(report["interrupted"], true);
    EXPECT_EQ(report["completed"], false);
    EXPECT_LT(report["reached_s"], 2);
    EXPECT_GE(report["reached_s"], 0.625);

    const Ran resumed = run({"--resume", "--threads", "2", "--checkpoint-every", "3"});
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("going on from "));
    const auto got = results();
    ASSERT_EQ(got.size(), expected.size());
    for (const auto& [name, bytes] : expected) EXPECT_TRUE(got.at(name) == bytes) << name;
}

// Tetrahedra between what is fixed and what goes with the bone are flat when it has gone 2 mm:
// at 0.75 s.
TEST_F(Contract, WithoutEquilibriumItSaysWhereAndKeepsWhatItHas) {
    write_bone(Vec3(-1, -1, 11.5), Vec3(3.5, 6, 3));
    change("scene.yaml", "teran2003_muscle", "blemker2005_muscle");
    change("scene.yaml", "normal: [0, 0, 1], within: 0.1", "normal: [0, 0, 1], within: 10.1");
    change("scene.yaml", "{surface: bone.stl}",
           "{surface: bone.stl, motion: [{time: 0}, {time: 0.5}, {time: 1, translation: [0, 0, "
           "-4]}]}");
    const Ran ran = run({"--json"});
    EXPECT_EQ(ran.code, kNotConverged) << ran.err;
    EXPECT_THAT(ran.err,
                AllOf(HasSubstr("no matrix is between them"), HasSubstr("no equilibrium beyond "),
                      HasSubstr(" tetrahedron "), HasSubstr(" of muscle at (")));
    // The warning comes before anything is solved.
    EXPECT_LT(ran.err.find("no matrix"), ran.err.find("no equilibrium"));
    const Json report = Json::parse(ran.out);
    EXPECT_EQ(report["completed"], false);
    EXPECT_EQ(report["interrupted"], false);
    EXPECT_EQ(report["warnings"].size(), 1u);
    const double reached = report["reached_s"];
    EXPECT_GE(reached, 0.5);
    EXPECT_LT(reached, 0.75);
    std::size_t frames = 0;
    for (const Json& file : report["files"]) {
        EXPECT_TRUE(fs::exists(out() / file.get<std::string>())) << file;
        frames += file.get<std::string>().starts_with("frames/");
    }
    EXPECT_EQ(frames, static_cast<std::size_t>(std::floor(reached / 0.125 + 1e-9)) + 1);
    EXPECT_EQ(results().count("frames/frame_0016.vtu"), 0u);
}

}  // namespace
}  // namespace myotet
