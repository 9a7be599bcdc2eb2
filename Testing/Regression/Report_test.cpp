// SPDX-License-Identifier: Apache-2.0
// `myotet report` and the page at the end of each run, as a user meets them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "Core/Text.h"
#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Report/Html.h"
#include "Report/Picture.h"
#include "Segmentation/ReadLabels.h"
#include "Support/Markup.h"
#include "Support/ReferenceCase.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using testing::Ran;
using testing::read_bytes;
using testing::write_bytes;

constexpr int kUsage = 2, kBadInput = 3;

const char* const kScene = R"(title: a block <isometric> & "fixed"
bodies:
  muscle:
    mesh: block.vtu
    material: teran2003_muscle
    fibres: {from: laplace}
    activation: {file: drive.csv}
attachments:
  - {body: muscle, to: fixed, plane: {point: [0, 0, 0], normal: [0, 0, 1], within: 0.1}, end: origin}
  - {body: muscle, to: fixed, plane: {point: [0, 0, 12], normal: [0, 0, 1], within: 0.1}, end: insertion}
time: {end: 0.5, step: 0.125}
output: {every: 0.25}
)";

class ReportPage : public ::testing::Test {
protected:
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    [[nodiscard]] std::string page() const { return read_bytes(out() / "report.html"); }
    [[nodiscard]] Json report() const { return Json::parse(read_bytes(out() / "report.json")); }
    static Ran run(const std::vector<std::string>& words) {
        return testing::run_program(MYOTET_PROGRAM, words);
    }
    Ran remake(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words{"report", out().string()};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    /// Two halves of a ball whose names are markup.
    void mesh(const std::vector<std::string>& more = {}) const {
        LabelVolume labels;
        labels.size = {24, 24, 24};
        labels.values.assign(24 * 24 * 24, 0);
        for (int k = 0; k < 24; ++k)
            for (int j = 0; j < 24; ++j)
                for (int i = 0; i < 24; ++i)
                    if ((Vec3(i, j, k) - Vec3::Constant(11.5)).norm() < 9)
                        labels.values[labels.offset(i, j, k)] = i < 12 ? 3 : 5;
        labels.names[3] = {"<b>\"left\" & 'lower'</b>", {}};
        labels.names[5] = {"biceps", {}};
        segmentation::write_labels(labels, scan());
        std::vector<std::string> words{
            "mesh", scan().string(), "-o", out().string(), "--edge-length", "3", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const Ran ran = run(words);
        ASSERT_EQ(ran.code, 0) << ran.err;
    }
    Ran activate(const std::vector<std::string>& more = {}) const {
        const fs::path arm = fs::path(MYOTET_SOURCE_DIR) / "Data/arm";
        std::vector<std::string> words{"activate",
                                       (arm / "arm.osim").string(),
                                       (arm / "curl.yaml").string(),
                                       "--hold",
                                       "shoulder_flexion",
                                       "-o",
                                       out().string(),
                                       "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    [[nodiscard]] fs::path scan() const { return folder_ / "scan.nii.gz"; }
    void expect_a_page_that_stands_alone() const {
        const std::string html = page();
        EXPECT_EQ(testing::markup_mistake(html), "");
        for (const char* word : {"http:", "https:", "src=\"//", "href=\"//", "@import", "url("})
            EXPECT_THAT(html, Not(HasSubstr(word)));
    }
    /// A number of report.json stands in the page, whole.
    static void expect_number(const std::string& html, const Json& number) {
        EXPECT_NE(html.find("<data value=\"" + shown(number.get<double>()) + "\">"),
                  std::string::npos)
            << number;
    }
    /// What is refused with this sentence, and leaves the page as it was.
    void expect_refused(const std::string& sentence) const {
        const bool there = fs::exists(out() / "report.html");
        const std::string before = there ? page() : "";
        const Ran ran = remake();
        EXPECT_EQ(ran.code, kBadInput) << sentence;
        EXPECT_THAT(ran.err, HasSubstr(sentence));
        EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'),
                  1 + (ran.err.find("report\n") != std::string::npos))
            << ran.err;
        EXPECT_EQ(fs::exists(out() / "report.html"), there);
        if (there) {
            EXPECT_EQ(page(), before);
        }
    }
    void change_report(const std::function<void(Json&)>& change) const {
        Json json = report();
        change(json);
        write_bytes(out() / "report.json", json.dump(2));
    }

    testing::TemporaryFolder folder_;
};

TEST_F(ReportPage, OfMeshesTellsWhatReportJsonTells) {
    mesh();
    expect_a_page_that_stands_alone();
    const std::string html = page();
    const Json told = report();
    ASSERT_EQ(told["tissues"].size(), 2u);
    for (const Json& tissue : told["tissues"]) {
        EXPECT_NE(html.find(report::escaped(tissue["name"].get<std::string>())), std::string::npos);
        for (const char* key :
             {"voxels", "volume_labels_mm3", "volume_mesh_mm3", "vertices", "tets",
              "min_dihedral_deg", "max_dihedral_deg", "max_aspect_ratio", "mean_aspect_ratio",
              "edge_length_asked_mm", "edge_length_surface_median_mm", "surface_distance_mean_mm",
              "surface_distance_max_mm"})
            expect_number(html, tissue[key]);
        expect_number(html, tissue["smoothing"]["moved_max_mm"]);
    }
    EXPECT_THAT(html, Not(HasSubstr("<b>")));
    EXPECT_NE(html.find("Each mesh keeps all promises."), std::string::npos);
    for (const char* words :
         {"from the front", "cut open, from the left", "axial slices", "Smallest dihedral angle",
          told["version"].get_ref<const std::string&>().c_str()})
        EXPECT_NE(html.find(words), std::string::npos) << words;
    EXPECT_EQ(html.find(" broken</strong>"), std::string::npos);
}

TEST_F(ReportPage, OfTheSameFolderHasTheSameBytes) {
    mesh();
    const std::string first = page();
    ASSERT_EQ(remake().code, 0);
    EXPECT_TRUE(page() == first);
}

TEST_F(ReportPage, IsLeftOutOnDemandAndMadeLater) {
    mesh();
    mesh({"--no-report"});
    EXPECT_FALSE(fs::exists(out() / "report.html")) << "of the run before";
    ASSERT_EQ(remake().code, 0);
    EXPECT_TRUE(fs::exists(out() / "report.html"));
}

TEST_F(ReportPage, WithoutItsScanSaysSo) {
    mesh();
    std::ofstream(scan(), std::ios::app) << "more";
    ASSERT_EQ(remake().code, 0);
    EXPECT_NE(page().find("has changed since it was meshed; slices are left out."),
              std::string::npos);
    fs::remove(scan());
    ASSERT_EQ(remake().code, 0);
    EXPECT_NE(page().find("is not there any more; slices are left out."), std::string::npos);
    EXPECT_EQ(page().find("axial slices"), std::string::npos);
    expect_a_page_that_stands_alone();
}

TEST_F(ReportPage, OfSurfacesAloneShowsThem) {
    mesh({"--format", "stl"});
    expect_a_page_that_stands_alone();
    EXPECT_NE(page().find("from the front"), std::string::npos);
    EXPECT_EQ(page().find("cut open"), std::string::npos);
}

TEST_F(ReportPage, DrawsEachTissueAsAFileOnDemand) {
    mesh();
    EXPECT_FALSE(fs::exists(out() / "pictures"));
    ASSERT_EQ(remake({"--png"}).code, 0);
    for (const char* name : {"whole_front", "whole_left", "whole_back", "whole_above",
                             "whole_front_cut", "whole_left_cut", "5_biceps", "5_biceps_cut"}) {
        const report::Picture picture =
            report::read_png(out() / "pictures" / (std::string(name) + ".png"));
        EXPECT_EQ(std::max(picture.width, picture.height), 960) << name;
        const auto coloured = std::ranges::count_if(picture.rgb, [](int c) { return c < 250; });
        EXPECT_GT(coloured, 960 * 960 / 4) << name;
    }
}

TEST_F(ReportPage, OfAContractionHasFramesCurvesAndBodies) {
    meshfiles::write_vtu(test::five_tet_block(Vec3(4, 4, 12), {2, 2, 4}), {},
                         folder_ / "block.vtu");
    write_bytes(folder_ / "drive.csv", "time,muscle\n0,0\n0.5,0.4\n");
    write_bytes(folder_ / "scene.yaml", kScene);
    const Ran ran =
        run({"contract", (folder_ / "scene.yaml").string(), "-o", out().string(), "--quiet"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    expect_a_page_that_stands_alone();
    const std::string html = page();
    const Json told = report();
    EXPECT_NE(html.find("<h1>a block &lt;isometric&gt; &amp; &quot;fixed&quot;</h1>"),
              std::string::npos);
    for (const auto& [name, column] : told["history"].items()) {
        if (name.starts_with("time")) continue;
        for (const char* key : {"first", "last", "least", "most"}) expect_number(html, column[key]);
    }
    for (const char* key : {"nodes", "tets", "pcsa_mm2", "fibre_length_mm"})
        expect_number(html, told["bodies"][0][key]);
    for (const char* words :
         {"Force at attachments", "Smallest J", "Worst aspect ratio", "frame 0002", "data-plays"})
        EXPECT_NE(html.find(words), std::string::npos) << words;

    write_bytes(out() / "pictures/frame_0001.png", "no picture");
    expect_refused("frame_0001.png");
    fs::remove(out() / "history.csv");
    expect_refused("frame_0001.png");
    EXPECT_EQ(remake({"--png"}).code, kUsage);
}

TEST_F(ReportPage, OfActivationsHasCurvesAndTables) {
    ASSERT_EQ(activate().code, 0);
    expect_a_page_that_stands_alone();
    const std::string html = page();
    const Json told = report();
    for (const Json& muscle : told["muscles"])
        for (const char* key : {"highest_activation", "highest_force_N", "times_at_a_bound"})
            expect_number(html, muscle[key]);
    for (const Json& coordinate : told["coordinates"])
        for (const char* key : {"largest_torque_N_mm", "largest_reserve_N_mm", "most_missing_N_mm"})
            expect_number(html, coordinate[key]);
    EXPECT_NE(html.find("left to what holds it"), std::string::npos);
    fs::remove(out() / "force.sto");
    expect_refused("force.sto");
}

TEST_F(ReportPage, RefusesWhatIsNoRunOfThisProgram) {
    expect_refused("report.json: is not there");
    fs::create_directories(out());
    write_bytes(out() / "report.json", "{\"version\": ");
    expect_refused("is damaged: it is no JSON");
    write_bytes(out() / "report.json", "[1, 2]");
    expect_refused("says no version");
    write_bytes(out() / "report.json", R"({"version": "0.0.1", "tissues": []})");
    expect_refused("was written by version 0.0.1");
    const std::string version = run({"--version"}).out;
    const std::string now = std::string(trimmed(version.substr(version.find(' '))));
    write_bytes(out() / "report.json",
                R"({"version": ")" + now + R"(", "tissues": [{"label": 1}]})");
    expect_refused("is of a run that has no page");
}

TEST_F(ReportPage, RefusesDamageAndKeepsThePageOfBefore) {
    mesh();
    const std::string whole = read_bytes(out() / "report.json");
    const auto damaged = [&](const std::function<void(Json&)>& change, const std::string& told) {
        change_report(change);
        expect_refused(told);
        write_bytes(out() / "report.json", whole);
    };
    damaged([](Json& j) { j.erase("seconds"); }, "is damaged");
    damaged([](Json& j) { j["tissues"][0]["tets"] = "many"; }, "is damaged");
    damaged([](Json& j) { j["tissues"][0].erase("files"); }, "is damaged");
    damaged([](Json& j) { j["tissues"][0]["files"] = {"../../etc/passwd.vtu"}; },
            "is not in the folder of results");
    damaged([](Json& j) { j["tissues"][0]["files"] = {"gone.vtu"}; }, "but it is not there");
    write_bytes(out() / report()["tissues"][1]["files"][0].get<std::string>(), "no mesh");
    expect_refused("5_biceps.vtu");
}

TEST_F(ReportPage, SlicesSayThatTheyShowTheLabelsBeforeTheyWereMended) {
    const char* const sentence = "where the recipe mended them, outlines and labels differ";
    mesh();
    EXPECT_THAT(page(), Not(HasSubstr(sentence)));
    write_bytes(folder_ / "recipe.yaml", "steps:\n  - {keep_largest: biceps}\n");
    mesh({"--repair", (folder_ / "recipe.yaml").string()});
    EXPECT_THAT(page(), HasSubstr(sentence));
}

}  // namespace
}  // namespace myotet
