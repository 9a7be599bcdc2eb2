// SPDX-License-Identifier: Apache-2.0
#include "Outputs.h"

#include <gtest/gtest.h>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::app {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;
using testing::write_bytes;

void write_text(const fs::path& file) { write_atomically(file, "text"); }

TEST(FileStem, KeepsNamesAndDisarmsTheRest) {
    EXPECT_EQ(file_stem(0, 7, "biceps"), "7_biceps");
    EXPECT_EQ(file_stem(0, 0, "M. biceps/brachii: long head"), "0_M._biceps_brachii__long_head");
    EXPECT_EQ(file_stem(0, 12, "Wadenbeinköpfchen"), "12_Wadenbeinköpfchen");
    EXPECT_EQ(file_stem(0, 3, "../../etc"), "3_.._.._etc");
    EXPECT_EQ(file_stem(0, 3, ""), "3_");
    EXPECT_EQ(file_stem(2, 3, "ulna"), "2-3_ulna");
}

TEST(FileStem, CutsLongNamesBetweenCharacters) {
    std::string name(99, 'a');
    name += "öö";  // two bytes each: the first would be cut at byte 100
    EXPECT_EQ(file_stem(0, 1, name), "1_" + std::string(99, 'a'));
}

TEST(OutputFolder, IsMadeByTheFirstFileAndKeptOnDemand) {
    const TemporaryFolder folder;
    {
        OutputFolder out(folder / "a/b/");
        EXPECT_TRUE(fs::is_empty(folder.path()));  // the probe left nothing
        out.write("file", write_text);
        out.keep();
    }
    EXPECT_EQ(testing::read_bytes(folder / "a/b/file"), "text");
}

TEST(OutputFolder, TakesBackWhatWasNotKept) {
    const TemporaryFolder folder;
    {
        OutputFolder out(folder / "a/b");
        out.write("first", write_text);
        EXPECT_THROW(out.write("second", [](const fs::path&) { throw Interrupted(); }),
                     Interrupted);
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(OutputFolder, LeavesOthersFilesAlone) {
    const TemporaryFolder folder;
    write_bytes(folder / "theirs", "");
    { OutputFolder(folder.path()).write("mine", write_text); }
    EXPECT_TRUE(fs::exists(folder / "theirs"));
    EXPECT_FALSE(fs::exists(folder / "mine"));
}

TEST(OutputFolder, RefusesPlacesThatTakeNoFiles) {
    const TemporaryFolder folder;
    write_bytes(folder / "file", "");
    EXPECT_THROW(OutputFolder(folder / "file"), IoError);
    EXPECT_THROW(OutputFolder(folder / "file/below"), IoError);
    EXPECT_THROW(OutputFolder("/proc/myotet/new"), IoError);
}

/// The folder could be written to before: what fails later is the disk.
TEST(OutputFolder, AWriteThatFailsIsALackOfResource) {
    const TemporaryFolder folder;
    OutputFolder out(folder / "out");
    EXPECT_THROW(out.write("file", [](const fs::path&) { throw IoError("disk full"); }),
                 ResourceError);
}

}  // namespace
}  // namespace myotet::app
