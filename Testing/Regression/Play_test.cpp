// SPDX-License-Identifier: Apache-2.0
// `myotet cage` and `myotet play` one after the other, as a user runs them: the phantom of a
// ball gets a cage, and falls in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Report/Picture.h"
#include "Segmentation/ReadLabels.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;
using testing::Ran;
using testing::read_bytes;
using testing::write_bytes;

constexpr int kBadInput = 3;

const char* const kScene = R"(title: a ball falls
bodies:
  ball:
    cage: cage/cage.vtu
    surface: cage/ball.stl
    soft: {young: 0.05, poisson: 0.45}
    place: {translation: [0, 0, 30]}
obstacles:
  floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}
time: {end: 0.2, step: 0.01}
output: {every: 0.05}
)";

class Play : public ::testing::Test {
protected:
    void SetUp() override {
        segmentation::write_labels(phantoms::make_phantom("sphere", Vec3::Constant(2)).volume,
                                   folder_ / "scan.nii");
        const Ran surface = run({"surface", folder_ / "scan.nii", "-o", folder_ / "surface",
                                 "--edge-length", "4", "--quiet"});
        ASSERT_EQ(surface.code, 0) << surface.err;
        fs::path stl;
        for (const auto& entry : fs::directory_iterator(folder_ / "surface"))
            if (entry.path().extension() == ".stl") stl = entry.path();
        const Ran cage =
            run({"cage", stl.string(), "-o", folder_ / "cage", "--tets", "150", "--quiet"});
        ASSERT_EQ(cage.code, 0) << cage.err;
        fs::copy_file(stl, folder_ / "cage/ball.stl");
        write_bytes(scene(), kScene);
    }
    static Ran run(const std::vector<std::string>& words) {
        return testing::run_program(MYOTET_PROGRAM, words);
    }
    Ran play(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words{"play", scene().string(), "-o", out().string(), "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    [[nodiscard]] fs::path scene() const { return folder_ / "scene.yaml"; }
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    testing::TemporaryFolder folder_;
};

TEST_F(Play, ABallInItsCageFallsAndTellsHowItWent) {
    const Ran ran = play({"--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json report = Json::parse(ran.out);
    EXPECT_EQ(report, Json::parse(read_bytes(out() / "report.json")));
    EXPECT_TRUE(report["completed"]);
    EXPECT_EQ(report["steps"], 20);
    EXPECT_EQ(report["inverted_tets"], 0);
    const Json& energy = report["energy_mJ"];
    EXPECT_LT(energy["last"]["total"].get<double>(), energy["first"]["total"].get<double>());
    // Rounding: nothing drives the ball but its weight, which the total holds.
    EXPECT_LT(energy["greatest_gain_in_a_step"].get<double>(),
              1e-6 * energy["first"]["total"].get<double>());
    for (const Json& file : report["files"])
        EXPECT_TRUE(fs::exists(out() / file.get<std::string>())) << file;
    EXPECT_THAT(read_bytes(out() / "play.pvd"), HasSubstr("timestep=\"0.05"));
    const report::Picture sheet = report::read_png(out() / "pictures/play.png");
    EXPECT_GT(sheet.width, report::read_png(out() / "pictures/frame_0000.png").width);
}

TEST_F(Play, TheSameBytesOnOneThreadAndTwo) {
    ASSERT_EQ(play({"--threads", "1", "--no-pictures"}).code, 0);
    const std::string history = read_bytes(out() / "history.csv");
    EXPECT_FALSE(fs::exists(out() / "pictures/play.png"));
    ASSERT_EQ(play({"--threads", "2", "--no-pictures"}).code, 0);
    EXPECT_EQ(read_bytes(out() / "history.csv"), history);
}

TEST_F(Play, ADryRunWritesNothingAndMistakesAreNamed) {
    const Ran dry = play({"--dry-run"});
    EXPECT_EQ(dry.code, 0) << dry.err;
    EXPECT_THAT(dry.out, HasSubstr("ball"));
    EXPECT_FALSE(fs::exists(out()));

    std::string text = kScene;
    text.replace(text.find("poisson: 0.45"), 13, "poisson: 0.55");
    write_bytes(scene(), text);
    const Ran bad = play();
    EXPECT_EQ(bad.code, kBadInput);
    EXPECT_THAT(bad.err, AllOf(HasSubstr("scene.yaml:6"), HasSubstr("poisson")));
    EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace myotet
