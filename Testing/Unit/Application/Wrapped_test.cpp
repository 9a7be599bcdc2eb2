// SPDX-License-Identifier: Apache-2.0
// What programs that wrap Myotet are told: progress and log as JSON, descriptions for Slicer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "Phantoms/Phantoms.h"
#include "Segmentation/ReadLabels.h"
#include "Support/Markup.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::Ran;
using testing::run_program;
using ::testing::StartsWith;
using Json = nlohmann::json;

std::vector<Json> events_of(const std::string& text) {
    std::vector<Json> events;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) events.push_back(Json::parse(line));
    return events;
}

class Wrapped : public ::testing::Test {
protected:
    void SetUp() override {
        segmentation::write_labels(phantoms::make_phantom("sphere").volume, scan());
    }
    [[nodiscard]] std::filesystem::path scan() const { return folder_ / "scan.nii"; }
    [[nodiscard]] Ran mesh(const std::vector<std::string>& more) const {
        std::vector<std::string> words{"mesh", scan(), "-o", folder_ / "out", "--no-report"};
        words.insert(words.end(), more.begin(), more.end());
        return run_program(MYOTET_PROGRAM, words);
    }
    testing::TemporaryFolder folder_;
};

TEST_F(Wrapped, EachLineOnStderrIsAnEvent) {
    const Ran ran = mesh({"--progress", "json", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(Json::accept(ran.out));  // the report, and nothing else
    const std::vector<Json> events = events_of(ran.err);
    ASSERT_GT(events.size(), 3u);
    std::string stage;
    double fraction = 0;
    int stages = 0, notes = 0;
    for (const Json& event : events) {
        if (event.at("event") == "log") {
            EXPECT_NE(event.at("message"), "");
            ++notes;
        }
        if (event.at("event") != "progress") continue;
        if (event.at("stage") != stage) {
            stage = event.at("stage");
            fraction = 0;
            ++stages;
        }
        EXPECT_GE(event.at("fraction").get<double>(), fraction);  // within a stage only forwards
        fraction = event.at("fraction");
        EXPECT_LE(fraction, 1);
    }
    EXPECT_GT(stages, 1);
    EXPECT_GT(notes, 0);
    EXPECT_EQ(events.back(), Json({{"event", "end"}, {"exit_code", 0}}));
}

TEST_F(Wrapped, MistakesAreEventsToo) {
    const std::vector<std::pair<std::vector<std::string>, int>> cases{
        {{"--edge-length", "-1", "--progress", "json"}, 2},
        {{"--progress=json", "--labels", "sp\xFFheres \"x\""}, 3}};
    for (const auto& [words, code] : cases) {
        const Ran ran = mesh(words);
        EXPECT_EQ(ran.code, code);
        const std::vector<Json> events = events_of(ran.err);
        ASSERT_EQ(events.size() >= 2, true) << ran.err;
        const Json& error = events[events.size() - 2];
        EXPECT_EQ(error.at("level"), "error");
        EXPECT_EQ(events.back().at("exit_code"), code);
    }
}

TEST_F(Wrapped, QuietMeansNoProgress) {
    const Ran ran = mesh({"--progress", "json", "--quiet"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(events_of(ran.err).size(), 1u) << ran.err;  // the end
}

TEST_F(Wrapped, SlicerHearsProgressOnStdoutAndOnlyErrorsOnStderr) {
    const Ran ran = mesh({"--progress", "slicer"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    EXPECT_THAT(ran.out, HasSubstr("<filter-comment>"));
    EXPECT_THAT(ran.out, HasSubstr("<filter-progress>0.000000</filter-progress>"));
    EXPECT_THAT(ran.out, HasSubstr("<filter-end>"));
    EXPECT_THAT(mesh({"--progress", "slicer", "--labels", "none"}).err, HasSubstr("error: "));
}

TEST_F(Wrapped, EachCommandDescribesItselfForSlicer) {
    std::istringstream help(run_program(MYOTET_PROGRAM, {"--help"}).out);
    int commands = 0;
    bool below = false;
    for (std::string line; std::getline(help, line);) {
        if (below && line.starts_with("  ") && line.size() > 2 && line[2] != ' ') {
            const std::string command = line.substr(2, line.find(' ', 2) - 2);
            const Ran ran = run_program(MYOTET_PROGRAM, {command, "--xml"});
            EXPECT_EQ(ran.code, 0) << command;
            EXPECT_EQ(ran.err, "") << command;
            EXPECT_THAT(ran.out, StartsWith("<?xml version=\"1.0\""));
            EXPECT_EQ(testing::markup_mistake(ran.out.substr(ran.out.find('\n'))), "") << command;
            EXPECT_THAT(ran.out, HasSubstr("<title>Myotet: " + command + "</title>"));
            ++commands;
        }
        below = below || line.starts_with("Subcommands:");
    }
    EXPECT_GE(commands, 11);
}

TEST_F(Wrapped, SlicerGetsFilesFoldersChoicesAndTexts) {
    const std::string xml = run_program(MYOTET_PROGRAM, {"mesh", "--xml"}).out;
    // What Slicer would run, put together from the description as it does.
    EXPECT_THAT(xml, HasSubstr("<image type=\"label\">\n<name>input</name>"));
    EXPECT_THAT(xml, HasSubstr("<directory>\n<name>output</name>"));
    EXPECT_THAT(xml, HasSubstr("<longflag>--output</longflag>\n<channel>output</channel>"));
    EXPECT_THAT(xml, HasSubstr("<string>\n<name>edge_length</name>"));
    EXPECT_THAT(xml, HasSubstr("<longflag>--lattice</longflag>\n<default>graded</default>\n"
                               "<element>graded</element>\n<element>uniform</element>"));
    EXPECT_THAT(xml, HasSubstr("<boolean>\n<name>heal</name>"));
    EXPECT_THAT(xml, HasSubstr("<boolean>\n<name>no_report</name>"));
    EXPECT_THAT(xml, HasSubstr("<longflag>--progress</longflag>\n<default>slicer</default>"));
    EXPECT_THAT(xml, Not(HasSubstr("--help")));
}

TEST_F(Wrapped, ALinkNamedAfterACommandIsThatCommand) {
    for (const char* name : {"MyotetInspect", "myotet-inspect"}) {
        const std::filesystem::path link = folder_ / name;
        std::filesystem::create_symlink(MYOTET_PROGRAM, link);
        const Ran ran = run_program(link, {scan(), "--json"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(ran.out, run_program(MYOTET_PROGRAM, {"inspect", scan(), "--json"}).out);
    }
}

}  // namespace
}  // namespace myotet
