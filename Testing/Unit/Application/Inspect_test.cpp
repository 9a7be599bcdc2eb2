// SPDX-License-Identifier: Apache-2.0
// `myotet inspect`: the grid in patient words, what would be lost, JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "InspectReport.h"
#include "Phantoms/Phantoms.h"
#include "Segmentation/ReadLabels.h"
#include "Support/RunProgram.h"

namespace myotet::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using testing::Ran;

constexpr double kAngleRounding = 1e-6;  // of an arc cosine near 1, degrees

LabelVolume volume_with(const Mat3& axes) {
    LabelVolume volume;
    volume.size = {20, 20, 20};
    volume.index_to_lps.linear() = axes;
    volume.values.assign(8000, 0);
    return volume;
}

void paint(LabelVolume& volume, std::int32_t label, const Index3& min, const Index3& max) {
    for (int k = min[2]; k <= max[2]; ++k)
        for (int j = min[1]; j <= max[1]; ++j)
            for (int i = min[0]; i <= max[0]; ++i) volume.values[volume.offset(i, j, k)] = label;
}

TEST(Grid, OfThePatientsAxes) {
    const GridReport grid = describe_grid(volume_with(Vec3(1, 2, 3).asDiagonal()));
    EXPECT_EQ(grid.axes, "LPS");
    EXPECT_EQ(grid.oblique_deg, 0);
    EXPECT_EQ(grid.shear_deg, 0);
    EXPECT_FALSE(grid.left_handed);
    EXPECT_THAT(grid.sides,
                ElementsAre("right", "left", "anterior", "posterior", "inferior", "superior"));
}

TEST(Grid, OfPermutedAndFlippedAxes) {
    Mat3 axes = Mat3::Zero();
    axes(1, 0) = -2;  // i grows to anterior
    axes(2, 1) = 1;   // j to superior
    axes(0, 2) = 3;   // k to left
    const GridReport grid = describe_grid(volume_with(axes));
    EXPECT_EQ(grid.axes, "ASL");
    EXPECT_TRUE(grid.left_handed);
    EXPECT_THAT(grid.sides,
                ElementsAre("posterior", "anterior", "inferior", "superior", "right", "left"));
}

TEST(Grid, ObliqueAxesTakeEachPatientAxisOnce) {
    for (const double angle_deg : {10.0, 44.9, 45.0}) {
        const Mat3 turn =
            Eigen::AngleAxisd(angle_deg * std::acos(-1.0) / 180, Vec3::UnitZ()).toRotationMatrix();
        const GridReport grid = describe_grid(volume_with(turn));
        EXPECT_NEAR(grid.oblique_deg, angle_deg, kAngleRounding);
        std::string letters = grid.axes;
        for (char& c : letters) c = c == 'R' ? 'L' : c == 'A' ? 'P' : c;
        std::ranges::sort(letters);
        EXPECT_EQ(letters, "LPS");
    }
    Mat3 sheared = Mat3::Identity();
    sheared(1, 2) = std::tan(0.1);
    EXPECT_NEAR(describe_grid(volume_with(sheared)).shear_deg, 0.1 * 180 / std::acos(-1.0),
                kAngleRounding);
}

class Inspect : public ::testing::Test {
protected:
    [[nodiscard]] std::filesystem::path scan() const { return folder_ / "scan.nii"; }
    Ran run(std::vector<std::string> more = {}) {
        segmentation::write_labels(volume, scan());
        std::vector<std::string> arguments{"inspect", scan().string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return testing::run_program(MYOTET_PROGRAM, arguments);
    }
    Json json() {
        const Ran ran = run({"--json"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        return Json::parse(ran.out);
    }
    testing::TemporaryFolder folder_;
    LabelVolume volume = volume_with(Mat3::Identity());
};

TEST_F(Inspect, SaysWhatIsThere) {
    paint(volume, 3, {2, 2, 2}, {9, 9, 19});
    paint(volume, 8, {10, 2, 2}, {14, 9, 12});
    volume.names[3] = {"biceps", {}};
    const Json json = this->json();
    EXPECT_EQ(json["frame"], "LPS");
    EXPECT_EQ(json["grid"]["axes"], "LPS");
    EXPECT_EQ(json["grid"]["size_voxels"], Json({20, 20, 20}));
    ASSERT_EQ(json["labels"].size(), 2u);
    const Json& biceps = json["labels"][0];
    EXPECT_EQ(biceps["label"], 3);
    EXPECT_EQ(biceps["name"], "biceps");
    EXPECT_EQ(biceps["voxels"], 8 * 8 * 18);
    EXPECT_EQ(biceps["component_sizes_voxels"], Json({8 * 8 * 18}));
    EXPECT_EQ(biceps["cut_by_field_of_view_voxels"], Json({{"superior", 64}}));
    EXPECT_DOUBLE_EQ(biceps["inscribed_radius_median_mm"], 4);
    EXPECT_EQ(biceps["touches"][1]["label"], 8);
    EXPECT_EQ(biceps["touches"][1]["faces"], 8 * 11);
    EXPECT_TRUE(json["labels"][1]["name"].is_null());
    EXPECT_DOUBLE_EQ(json["default_edge_length_mm"], 2);
}

TEST_F(Inspect, SaysWhatWouldBeLostInWordsToActOn) {
    volume.index_to_lps.linear() = Vec3(1, 1, 4).asDiagonal();
    paint(volume, 3, {2, 2, 2}, {12, 12, 19});
    paint(volume, 3, {16, 16, 5}, {16, 16, 6});
    paint(volume, 0, {6, 6, 6}, {6, 6, 6});
    paint(volume, 9, {1, 18, 1}, {18, 18, 10});
    volume.names[3] = {"biceps", {}};
    volume.names[5] = {"triceps", {}};
    const Ran ran = run();
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("1 of its 2 pieces (2 voxels"));
    EXPECT_THAT(ran.out, HasSubstr("1 piece is a speck of at most 8 voxels"));
    EXPECT_THAT(ran.out, HasSubstr("encloses 1 unlabelled void (4 mm^3)"));
    EXPECT_THAT(ran.out, HasSubstr("cuts it: superior (121 voxels)"));
    EXPECT_THAT(ran.out, HasSubstr("180 voxels (100 %) lie where it is one voxel thick"));
    EXPECT_THAT(ran.out, HasSubstr("Slices are 4 mm apart, 4 times the 1 mm in the plane"));
    EXPECT_THAT(ran.out, HasSubstr("1 label has no name (9)"));
    EXPECT_THAT(ran.out, HasSubstr("1 name belongs to values without voxels (5 triceps)"));
    EXPECT_THAT(ran.out, HasSubstr("1 unlabelled pocket (4 mm^3) lies enclosed"));
}

TEST_F(Inspect, HasNothingToComplainAboutInASoundScan) {
    paint(volume, 3, {3, 3, 3}, {16, 16, 16});
    volume.names[3] = {"biceps", {}};
    const Json json = this->json();
    EXPECT_EQ(json["notes"], Json::array());
    EXPECT_EQ(json["warnings"], Json::array());
    EXPECT_EQ(json["labels"][0]["notes"], Json::array());
}

TEST_F(Inspect, OverlappingLayersAreCounted) {
    InspectReport report;
    report.grid = describe_grid(volume);
    report.pockets = report.pocket_voxels = {0, 0};
    report.labels.resize(2);
    report.labels[0].name = "liver";
    report.labels[1].name = "tumour";
    report.labels[1].layer = 1;
    for (InspectedLabel& l : report.labels) l.found.value = 1, l.found.voxels = 9, l.named = true;
    report.overlaps = {{0, 1, 1, 1, 7}};
    add_notes(report);
    EXPECT_THAT(to_text(report), HasSubstr("liver and tumour by 7 voxels"));
    EXPECT_EQ(Json::parse(to_json(report))["overlaps"][0]["voxels"], 7);
}

TEST_F(Inspect, TheSameBytesForAnyNumberOfThreads) {
    volume = phantoms::make_phantom("arm").volume;
    EXPECT_EQ(run({"--json", "--threads", "1"}).out, run({"--json", "--threads", "2"}).out);
    EXPECT_EQ(run({"--threads", "1"}).out, run({"--threads", "2"}).out);
}

TEST_F(Inspect, RefusesWhatItCannotRead) {
    const Ran none = testing::run_program(MYOTET_PROGRAM, {"inspect", folder_ / "none.nii"});
    EXPECT_EQ(none.code, 3);
    EXPECT_THAT(none.err, HasSubstr("there is no such file"));
    paint(volume, 3, {3, 3, 3}, {16, 16, 16});
    EXPECT_EQ(run({"--orientation", "both"}).code, 2);
    EXPECT_THAT(run({"--orientation", "sform"}).out, Not(HasSubstr("error")));
}

}  // namespace
}  // namespace myotet::app
