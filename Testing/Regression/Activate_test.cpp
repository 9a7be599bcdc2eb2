// SPDX-License-Identifier: Apache-2.0
// `myotet activate` and `myotet fit` as a user runs them, on the arm of Data/arm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "MeshFiles/MeshFiles.h"
#include "Skeleton/Table.h"
#include "Support/ReferenceCase.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;
using skeleton::Table;
using testing::Ran;
using testing::read_bytes;
using testing::write_bytes;

constexpr int kUsage = 2, kBadInput = 3, kNotConverged = 5;
// Files hold the shortest texts that read back: moments balance to the solver's tolerance.
constexpr double kBalance = 1e-6;  // N mm, of some 10 000

const fs::path kArm = fs::path(MYOTET_SOURCE_DIR) / "Data/arm";

class Activate : public ::testing::Test {
protected:
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    [[nodiscard]] Ran run(const fs::path& model, const fs::path& motion,
                          std::vector<std::string> more = {}) const {
        more.insert(more.begin(),
                    {"activate", model.string(), motion.string(), "-o", out().string()});
        return testing::run_program(MYOTET_PROGRAM, more);
    }
    [[nodiscard]] Ran curl(std::vector<std::string> more = {}) const {
        more.insert(more.end(), {"--hold", "shoulder_flexion"});
        return run(kArm / "arm.osim", kArm / "curl.yaml", more);
    }
    [[nodiscard]] Table table(const std::string& name) const {
        return skeleton::read_table(out() / name);
    }
    [[nodiscard]] Json report() const { return Json::parse(read_bytes(out() / "report.json")); }

    testing::TemporaryFolder folder_;
};

double cell(const Table& table, std::size_t row, const std::string& name) {
    const int column = skeleton::find_column(table, name);
    EXPECT_GE(column, 0) << name;
    return column < 0 ? NAN : table.rows[row][static_cast<std::size_t>(column)];
}

TEST_F(Activate, ForcesTimesArmsAreTheMoments) {
    const Ran ran = curl();
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Table activations = table("activation.sto"), forces = table("force.sto"),
                moments = table("moments.sto"), arms = table("moment_arms.sto"),
                lengths = table("path_length.sto");
    ASSERT_EQ(activations.times.size(), 131u);
    double most = 0;
    for (std::size_t t = 0; t < moments.times.size(); ++t) {
        double sum = 0;
        for (const std::string& muscle : forces.columns) {
            sum += cell(forces, t, muscle) *
                   arms.rows[t][static_cast<std::size_t>(
                       std::ranges::find(arms.columns, muscle + "/elbow_flexion") -
                       arms.columns.begin())];
            EXPECT_GE(cell(activations, t, muscle), 0.01 - 1e-9);
            EXPECT_LE(cell(activations, t, muscle), 1 + 1e-9);
        }
        EXPECT_NEAR(sum, cell(moments, t, "elbow_flexion_moment"), kBalance);
        most = std::max(most, cell(activations, t, "biceps"));
    }
    // 4 kg at 330 mm and the forearm: 11 N m at 60 degrees, of which the biceps bears most.
    EXPECT_GT(most, 0.2);
    EXPECT_LT(most, 0.4);
    EXPECT_LT(cell(lengths, 130, "biceps"), cell(lengths, 0, "biceps") - 20);
    EXPECT_FALSE(fs::exists(out() / "reserves.sto"));
    EXPECT_EQ(report()["status"], "converged");
    EXPECT_LT(report()["largest_kkt_residual"], 1e-8);
}

TEST_F(Activate, MomentArmsAreSlopesOfLengths) {
    // A degree a second, so that differences of neighbours are slopes.
    write_bytes(folder_ / "slow.csv", [] {
        std::string text = "time,elbow_flexion,shoulder_flexion\n";
        for (int i = 0; i <= 120; ++i)
            text += std::to_string(i) + "," + std::to_string(i * M_PI / 180) + ",0\n";
        return text;
    }());
    const Ran ran = run(kArm / "arm.osim", folder_ / "slow.csv", {"--static", "--reserves", "1e6"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Table lengths = table("path_length.sto"), arms = table("moment_arms.sto");
    for (const std::string muscle : {"biceps", "brachialis", "triceps"}) {
        const auto column = static_cast<std::size_t>(
            std::ranges::find(arms.columns, muscle + "/elbow_flexion") - arms.columns.begin());
        ASSERT_LT(column, arms.columns.size());
        for (std::size_t t = 1; t + 1 < lengths.times.size(); ++t) {
            const double slope =
                (cell(lengths, t + 1, muscle) - cell(lengths, t - 1, muscle)) / (2 * M_PI / 180);
            // Second differences of an arm that changes by 5 mm in 10 degrees, and where a
            // path leaves a cylinder the arm has a kink.
            EXPECT_NEAR(-slope, arms.rows[t][column], 0.1) << muscle << " at " << t;
        }
    }
}

TEST_F(Activate, ReservesAreToldAndFewerMusclesNeedThem) {
    const Ran ran = run(kArm / "arm.osim", kArm / "curl.yaml", {"--reserves", "1e5", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json told = Json::parse(ran.out);
    EXPECT_GT(told["coordinates"][0]["largest_reserve_N_mm"].get<double>(), 100);
    const Table reserves = table("reserves.sto");
    EXPECT_EQ(reserves.columns.size(), 2u);
}

TEST_F(Activate, WhatMusclesCannotDoIsSaid) {
    const Ran ran = run(kArm / "arm.osim", kArm / "curl.yaml");
    EXPECT_EQ(ran.code, kNotConverged);
    EXPECT_THAT(ran.err, AllOf(HasSubstr("muscles cannot balance"), HasSubstr("_flexion"),
                               HasSubstr("reserve")));
    EXPECT_EQ(report()["status"], "infeasible");
    EXPECT_TRUE(fs::exists(out() / "moments.sto"));
    EXPECT_FALSE(fs::exists(out() / "activation.sto"));
    EXPECT_FALSE(fs::exists(out() / "force.sto"));
}

TEST_F(Activate, CostsTendonsAndBounds) {
    write_bytes(folder_ / "bounds.csv", "time,biceps_max,triceps_min\n0,0.1,0.1\n2,0.1,0.1\n");
    const auto most = [&](const std::vector<std::string>& more) {
        const Ran ran = curl(more);
        EXPECT_EQ(ran.code, 0) << ran.err;
        std::map<std::string, double> muscles;
        const Json told = report();
        for (const Json& m : told["muscles"]) muscles[m["name"]] = m["highest_activation"];
        return muscles;
    };
    const auto squares = most({});
    const auto cubes = most({"--cost", "stress^3"});
    EXPECT_GT(cubes.at("brachialis"), squares.at("brachialis"));  // more evenly
    const auto rigid = most({"--tendon", "rigid"});
    EXPECT_NE(rigid.at("biceps"), squares.at("biceps"));
    const auto bound = most({"--bounds", (folder_ / "bounds.csv").string()});
    EXPECT_NEAR(bound.at("biceps"), 0.1, 1e-6);
    EXPECT_GT(bound.at("brachialis"), squares.at("brachialis"));
    write_bytes(folder_ / "emg.csv", "time,triceps\n0,0.3\n2,0.3\n");
    const auto tracked = most({"--emg", (folder_ / "emg.csv").string(), "--tracking", "100"});
    EXPECT_NEAR(tracked.at("triceps"), 0.3, 0.05);
}

TEST_F(Activate, TheSameBytesOnOneThreadAndTwo) {
    ASSERT_EQ(curl({"--threads", "1"}).code, 0);
    std::map<std::string, std::string> one;
    for (const auto& entry : fs::directory_iterator(out()))
        if (entry.path().extension() == ".sto")
            one[entry.path().filename()] = read_bytes(entry.path());
    EXPECT_EQ(one.size(), 5u);
    ASSERT_EQ(curl({"--threads", "2"}).code, 0);
    for (const auto& [name, bytes] : one) EXPECT_EQ(read_bytes(out() / name), bytes) << name;
}

TEST_F(Activate, BadInputIsOneSentenceAndNothingWritten) {
    const auto refused = [&](const fs::path& motion, const std::vector<std::string>& more,
                             int code) {
        std::vector<std::string> words = more;
        words.push_back("--quiet");
        const Ran ran = run(kArm / "arm.osim", motion, words);
        EXPECT_EQ(ran.code, code) << ran.err;
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_FALSE(fs::exists(out()));
        return ran.err;
    };
    EXPECT_THAT(refused(kArm / "curl.yaml", {"--hold", "elbow"}, kUsage),
                HasSubstr("the model has no coordinate 'elbow'; it has"));
    EXPECT_THAT(refused(kArm / "curl.yaml", {"--reserves", "elbow_flexion=no"}, kUsage),
                HasSubstr("names no strength above 0"));
    EXPECT_THAT(refused(kArm / "curl.yaml", {"--cost", "fatigue"}, kUsage),
                HasSubstr("neither activation^P nor stress^P"));
    EXPECT_THAT(refused(folder_ / "none.mot", {}, kBadInput), HasSubstr("none.mot"));
    write_bytes(folder_ / "nan.csv", "time,elbow_flexion\n0,0\n1,nan\n");
    EXPECT_THAT(refused(folder_ / "nan.csv", {}, kBadInput), HasSubstr("nan.csv:3"));
    write_bytes(folder_ / "knee.csv", "time,knee\n0,0\n1,1\n");
    EXPECT_THAT(refused(folder_ / "knee.csv", {}, kBadInput), HasSubstr("knee"));
    write_bytes(folder_ / "bounds.csv", "time,biceps_max\n0,1.5\n");
    EXPECT_THAT(
        refused(kArm / "curl.yaml", {"--bounds", (folder_ / "bounds.csv").string()}, kBadInput),
        HasSubstr("biceps is 1.5 at 0 s, but activations are from 0 to 1"));
    write_bytes(folder_ / "bounds.csv", "time,bicep_max\n0,0.5\n");
    EXPECT_THAT(
        refused(kArm / "curl.yaml", {"--bounds", (folder_ / "bounds.csv").string()}, kBadInput),
        HasSubstr("no column bounds a muscle"));
}

TEST_F(Activate, AMotionBeyondItsRangesIsWarnedOf) {
    write_bytes(folder_ / "far.yaml",
                "myotet_motion: 1\nkeys: [{time: 0, elbow_flexion: 0, shoulder_flexion: 0}, "
                "{time: 1, elbow_flexion: 160}]\n");
    const Ran ran = run(kArm / "arm.osim", folder_ / "far.yaml", {"--reserves", "1e6"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("takes elbow_flexion to 160 degrees at 1 s, 20 degrees beyond"));
}

// The chain that the README shows, on a block instead of the phantom: the activation that
// was found drives a muscle whose bone goes with the forearm.
TEST_F(Activate, AScanFollows) {
    ASSERT_EQ(curl().code, 0);
    meshfiles::write_vtu(test::five_tet_block(Vec3(4, 4, 12), {2, 2, 6}), {},
                         folder_ / "block.vtu");
    TetMesh bone = test::five_tet_block(Vec3(6, 6, 3), {2, 2, 2});
    for (Vec3& p : bone.points) p += Vec3(-1, -1, -2.5);
    meshfiles::write_stl(boundary_surface(bone), folder_ / "bone.stl");
    write_bytes(folder_ / "scene.yaml",
                "bodies:\n  muscle: {mesh: block.vtu, material: teran2003_muscle, fibres: {from: "
                "laplace}, activation: {file: out/activation.sto, muscle: biceps}}\nbones:\n  "
                "forearm: {surface: bone.stl, body: forearm}\nskeleton: {model: " +
                    (kArm / "arm.osim").string() + ", motion: " + (kArm / "curl.yaml").string() +
                    ", place: {translation: [2, 2, -2]}}\nattachments:\n  - {body: muscle, to: "
                    "fixed, plane: {point: [0, 0, 12], normal: [0, 0, 1], within: 0.1}, end: "
                    "origin}\n  - {body: muscle, to: forearm, within: 0.6, end: insertion}\ntime: "
                    "{end: 1.3, step: 0.1}\n");
    const Ran ran = testing::run_program(MYOTET_PROGRAM,
                                         {"contract", (folder_ / "scene.yaml").string(), "-o",
                                          (folder_ / "run").string(), "--no-pictures", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json told = Json::parse(ran.out);
    EXPECT_EQ(told["failed_steps"], 0);
    // Over activations at steps of 0.1 s.
    const Table activations = table("activation.sto");
    double most = 0;
    for (std::size_t t = 0; t < activations.times.size(); t += 10)
        most = std::max(most, cell(activations, t, "biceps"));
    EXPECT_NEAR(told["history"]["muscle_activation"]["most"].get<double>(), most, 1e-9);
}

class Fit : public ::testing::Test {
protected:
    Fit() {
        meshfiles::write_vtu(test::five_tet_block(Vec3(4, 4, 12), {1, 1, 3}), {},
                             folder_ / "block.vtu");
        write_scene("0.3");
    }
    void write_scene(const std::string& activation) const {
        write_bytes(
            folder_ / "scene.yaml",
            "bodies:\n  muscle: {mesh: block.vtu, material: teran2003_muscle, fibres: {from: "
            "laplace}, activation: " +
                activation +
                "}\nattachments:\n  - {body: muscle, to: fixed, plane: {point: [0, 0, 0], "
                "normal: [0, 0, 1], within: 0.1}, end: origin}\n  - {body: muscle, to: fixed, "
                "plane: {point: [0, 0, 12], normal: [0, 0, 1], within: 0.1}, end: "
                "insertion}\ntime: {end: 1, step: 0.125}\n");
    }
    [[nodiscard]] Ran run(std::vector<std::string> more = {}) const {
        more.insert(more.begin(),
                    {"fit", (folder_ / "scene.yaml").string(), "--target",
                     (folder_ / "force.csv").string(), "-o", (folder_ / "out").string()});
        return testing::run_program(MYOTET_PROGRAM, more);
    }
    testing::TemporaryFolder folder_;
};

// Held at its length a block pulls sigma_max times its area times its activation.
TEST_F(Fit, AKnownActivationComesBack) {
    write_bytes(folder_ / "force.csv", [] {
        // A parabola, which a cubic spline holds exactly.
        std::string text = "time,muscle_at_fixed_2_force\n";
        for (int i = 0; i <= 8; ++i) {
            const double t = i / 8.0;
            text +=
                std::to_string(t) + "," + std::to_string(4.8 * (0.4 + 0.8 * t * (1 - t))) + "\n";
        }
        return text;
    }());
    Ran ran = run({"--intervals", "4", "--goal", "1e-4"});
    if (ran.code == kBadInput) {  // the error lists the quantities there are
        ADD_FAILURE() << ran.err;
        return;
    }
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Table found = skeleton::read_table(folder_ / "out/activation.sto");
    for (std::size_t i = 0; i < found.times.size(); ++i) {
        const double t = found.times[i];
        EXPECT_NEAR(found.rows[i][0], 0.4 + 0.8 * t * (1 - t), 2e-3) << t;
    }
    const Json told = Json::parse(read_bytes(folder_ / "out/report.json"));
    EXPECT_EQ(told["status"], "converged");
    EXPECT_LT(told["evaluations"], 20);
}

TEST_F(Fit, WhatCannotBeIsSaid) {
    write_bytes(folder_ / "force.csv", "time,muscle_force\n0,1\n1,1\n");
    Ran ran = run();
    EXPECT_EQ(ran.code, kBadInput);
    EXPECT_THAT(ran.err, AllOf(HasSubstr("'muscle_force' is no quantity of the scene's history"),
                               HasSubstr("muscle_length")));
    write_bytes(folder_ / "force.csv", "time,muscle_volume\n0,192\n2,192\n");
    ran = run();
    EXPECT_EQ(ran.code, kBadInput);
    EXPECT_THAT(ran.err, HasSubstr("but the scene from 0 to 1 s"));
    write_bytes(folder_ / "force.csv", "time,muscle_volume\n0,192\n1,192\n");
    ran = run({"--body", "biceps"});
    EXPECT_EQ(ran.code, kUsage);
    EXPECT_THAT(ran.err, HasSubstr("'biceps' is no muscle of the scene"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace myotet
