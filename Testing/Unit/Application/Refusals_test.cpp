// SPDX-License-Identifier: Apache-2.0
// What the program refuses: with which exit code, in which words, and that
// nothing is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "Phantoms/Phantoms.h"
#include "Segmentation/ReadLabels.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Ran;
using testing::read_bytes;
using ::testing::StartsWith;
using testing::write_bytes;

class Refusals : public ::testing::Test {
protected:
    void SetUp() override {
        segmentation::write_labels(phantoms::make_phantom("sphere").volume, scan());
    }
    [[nodiscard]] std::filesystem::path scan() const { return folder_ / "scan.nii"; }
    [[nodiscard]] std::filesystem::path out() const { return folder_ / "out"; }

    /// Runs `myotet mesh INPUT -o out ...` and checks what every refusal has in
    /// common; returns the sentence.
    std::string refused(int code, const std::filesystem::path& input,
                        std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {"mesh", input.string(), "-o", out().string(),
                                              "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ran ran = testing::run_program(MYOTET_PROGRAM, arguments);
        EXPECT_EQ(ran.code, code) << ran.err;
        EXPECT_EQ(ran.out, "");
        EXPECT_THAT(ran.err, StartsWith("myotet: error: "));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_FALSE(std::filesystem::exists(out()));
        return ran.err;
    }

    testing::TemporaryFolder folder_;
};

constexpr int kUsage = 2, kBadInput = 3, kOutOfResource = 6;

TEST_F(Refusals, CommandLinesThatMakeNoSense) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{},
                                               {"mash"},
                                               {"mesh"},
                                               {"mesh", scan()},
                                               {"mesh", scan(), "-o"},
                                               {"phantom", "sphere"},
                                               {"quality"}}) {
        const Ran ran = testing::run_program(MYOTET_PROGRAM, arguments);
        EXPECT_EQ(ran.code, kUsage);
        EXPECT_EQ(ran.out, "");
        EXPECT_THAT(ran.err, StartsWith("myotet: error: "));
    }
    refused(kUsage, scan(), {"--edge-length", "3", "--tets", "5000"});
    refused(kUsage, scan(), {"--quiet", "--verbose"});
    refused(kUsage, scan(), {"--compress", "rubber"});
    refused(kUsage, scan(), {"--compress", "optimization,fem"});
    refused(kUsage, scan(), {"--lattice", "uniform", "--curvature", "1"});
    for (const std::vector<std::string>& unmended :
         {std::vector<std::string>{"--lattice", "uniform"},
          {"--quality", "draft"},
          {"--compress", "fem"}}) {
        std::vector<std::string> options{"--max-aspect-ratio", "4"};
        options.insert(options.end(), unmended.begin(), unmended.end());
        refused(kUsage, scan(), options);
    }
    refused(kUsage, scan(), {"--max-aspect-ratio", "1"});
    EXPECT_THAT(refused(kUsage, scan(), {"--quality", "best"}),
                HasSubstr("'best' is none of draft, standard"));
    refused(kUsage, scan(), {"--orientation", "both"});
    refused(kUsage, scan(), {"--smoothing", "gaussian"});
    for (const char* number : {"0", "-1", "nan", "inf", "three"}) {
        EXPECT_THAT(refused(kUsage, scan(), {"--edge-length", number}), HasSubstr(number));
        EXPECT_THAT(refused(kUsage, scan(), {"--tets", number}), HasSubstr(number));
    }
    refused(kUsage, scan(), {"--smooth=-1"});
    refused(kUsage, scan(), {"--threads", "0"});
}

TEST_F(Refusals, OptionsThatDoNotFitTheInput) {
    write_bytes(folder_ / "a.off",
                "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    EXPECT_THAT(refused(kUsage, folder_ / "a.off", {"--labels", "1"}), HasSubstr("--labels"));
    EXPECT_THAT(refused(kUsage, folder_ / "a.off", {"--close-gaps", "1"}),
                HasSubstr("--close-gaps"));
    EXPECT_THAT(refused(kUsage, folder_ / "a.off", {"--repair", "r.yaml"}), HasSubstr("--repair"));
    EXPECT_THAT(refused(kUsage, folder_ / "a.off", {"--one-hot", "--orientation", "qform"}),
                HasSubstr("--orientation and --one-hot: "));
    EXPECT_THAT(refused(kUsage, folder_ / "a.off", {"--smoothing", "none"}),
                HasSubstr("--smoothing: "));
    const Ran level_set = testing::run_program(
        MYOTET_PROGRAM, {"levelset", folder_ / "a.off", "-o", out(), "--one-hot"});
    EXPECT_EQ(level_set.code, kUsage);
    EXPECT_THAT(level_set.err, HasSubstr("--one-hot: "));
    EXPECT_THAT(refused(kUsage, scan(), {"--input-unit", "cm"}), HasSubstr("--input-unit"));
    EXPECT_THAT(refused(kUsage, scan(), {"--heal"}), HasSubstr("--heal"));
}

TEST_F(Refusals, FilesThatAreNotThereOrNotKnown) {
    EXPECT_THAT(refused(kBadInput, folder_ / "absent.nii"), HasSubstr("absent.nii"));
    write_bytes(folder_ / "scan.docx", "PK");
    EXPECT_THAT(refused(kBadInput, folder_ / "scan.docx"), HasSubstr("extension"));
    EXPECT_THAT(refused(kBadInput, folder_.path()), HasSubstr(folder_.path().string()));
}

TEST_F(Refusals, ATruncatedScan) {
    const std::string whole = read_bytes(scan());
    for (const std::size_t length : {std::size_t{0}, std::size_t{100}, whole.size() / 2}) {
        write_bytes(folder_ / "cut.nii", whole.substr(0, length));
        EXPECT_THAT(refused(kBadInput, folder_ / "cut.nii"), HasSubstr("cut.nii"));
    }
}

TEST_F(Refusals, NoLabels) {
    LabelVolume empty = phantoms::make_phantom("sphere").volume;
    std::ranges::fill(empty.values, 0);
    segmentation::write_labels(empty, folder_ / "empty.nii");
    EXPECT_THAT(refused(kBadInput, folder_ / "empty.nii"),
                AllOf(HasSubstr("empty.nii"), HasSubstr("label")));
}

TEST_F(Refusals, SpacingThatIsNotANumber) {
    std::string bytes = read_bytes(scan());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr std::size_t kPixdim1 = 80, kSformX = 280;  // NIfTI-1 header
    std::memcpy(bytes.data() + kPixdim1, &nan, sizeof nan);
    std::memcpy(bytes.data() + kSformX, &nan, sizeof nan);
    write_bytes(folder_ / "nan.nii", bytes);
    EXPECT_THAT(refused(kBadInput, folder_ / "nan.nii"), HasSubstr("nan.nii"));
}

TEST_F(Refusals, LabelsThatAreNotThere) {
    EXPECT_THAT(refused(kBadInput, scan(), {"--labels", "77"}), HasSubstr("77"));
    EXPECT_THAT(refused(kBadInput, scan(), {"--labels", "spheer"}), HasSubstr("spheer"));
}

TEST_F(Refusals, ANameTableThatIsNotThere) {
    EXPECT_THAT(refused(kBadInput, scan(), {"--names", (folder_ / "no.txt").string()}),
                HasSubstr("no.txt"));
}

TEST_F(Refusals, AnEdgeLengthFarTooFineForMemory) {
    EXPECT_THAT(refused(kOutOfResource, scan(), {"--edge-length", "0.001"}),
                HasSubstr("--edge-length"));
    EXPECT_THAT(refused(kOutOfResource, scan(), {"--tets", "1000000000000"}),
                HasSubstr("tetrahedra"));
}

TEST_F(Refusals, AnOutputFolderThatCannotBeWritten) {
    write_bytes(folder_ / "file", "");
    for (const std::string& place : {(folder_ / "file").string(), (folder_ / "file/below").string(),
                                     std::string("/proc/myotet")}) {
        const Ran ran =
            testing::run_program(MYOTET_PROGRAM, {"mesh", scan(), "-o", place, "--quiet"});
        EXPECT_EQ(ran.code, kBadInput);
        EXPECT_THAT(ran.err, AllOf(StartsWith("myotet: error: "), HasSubstr(place)));
    }
    EXPECT_EQ(read_bytes(folder_ / "file"), "");
}

TEST_F(Refusals, AnOpenSurface) {
    for (const char* first : {"0 0 0", "-1 -1 -1"}) {  // as if closed: no volume, some volume
        write_bytes(folder_ / "open.off", std::string("OFF\n4 3 0\n") + first +
                                              "\n1 0 0\n0 1 0\n0 0 1\n"
                                              "3 0 2 1\n3 0 1 3\n3 0 3 2\n");
        EXPECT_THAT(refused(kBadInput, folder_ / "open.off"),
                    AllOf(HasSubstr("open.off"), HasSubstr("closed")));
    }
}

TEST_F(Refusals, ABrokenSurface) {
    write_bytes(folder_ / "nan.off",
                "OFF\n4 4 0\n0 0 nan\n1 0 0\n0 1 0\n0 0 1\n"
                "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    EXPECT_THAT(refused(kBadInput, folder_ / "nan.off"), HasSubstr("nan.off"));
}

TEST_F(Refusals, AnUnknownPhantomListsThoseThereAre) {
    const Ran ran =
        testing::run_program(MYOTET_PROGRAM, {"phantom", "leg", "-o", (out() / "x.nii").string()});
    EXPECT_EQ(ran.code, kBadInput);
    for (const std::string_view name : phantoms::phantom_names())
        EXPECT_THAT(ran.err, HasSubstr(std::string(name)));
    EXPECT_FALSE(std::filesystem::exists(out()));
}

}  // namespace
}  // namespace myotet
