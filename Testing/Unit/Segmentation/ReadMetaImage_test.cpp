// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Samples.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {
namespace {

using ::testing::HasSubstr;

const std::string kData{"\0\1\2\3\4\5\6\7", 8};

/// A header in which one line may be replaced by another.
std::string header(const std::string& key = "", const std::string& line = "") {
    std::string text;
    for (const char* field :
         {"ObjectType = Image", "NDims = 3", "BinaryData = True", "BinaryDataByteOrderMSB = False",
          "CompressedData = False", "TransformMatrix = 0 1 0 1 0 0 0 0 1", "Offset = 10 20 30",
          "ElementSpacing = 2 3 4", "DimSize = 2 2 2", "ElementType = MET_UCHAR",
          "ElementDataFile = LOCAL"})
        if (key.empty() || !std::string(field).starts_with(key + " ="))
            text += std::string(field) + "\n";
        else if (!line.empty())
            text += line + "\n";
    return text;
}

class MetaImage : public ::testing::Test {
protected:
    LabelFile read(const std::string& bytes) {
        return read_labels(samples::write_bytes(folder.path() / "scan.mha", bytes));
    }
    void expect_refused(const std::string& bytes, const char* reason) {
        try {
            (void)read(bytes);
            ADD_FAILURE() << "read, but: " << reason;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("scan.mha"));
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    ::myotet::testing::TemporaryFolder folder;
};

TEST_F(MetaImage, PutsVoxelsInLps) {
    const LabelFile found = read(header() + kData);
    EXPECT_TRUE(found.warnings.empty());
    EXPECT_EQ(found.layers.front().index_to_lps * Vec3(1, 0, 0), Vec3(10, 22, 30));
    EXPECT_EQ(found.layers.front().index_to_lps * Vec3(0, 1, 1), Vec3(13, 20, 34));
    EXPECT_EQ(found.layers.front().values.back(), 7);
}

TEST_F(MetaImage, ReadsTextAndDetachedData) {
    EXPECT_EQ(read(header("BinaryData", "BinaryData = False") + "0 1 2 3 4 5 6 7")
                  .layers.front()
                  .values.back(),
              7);
    samples::write_bytes(folder.path() / "scan.raw", kData);
    EXPECT_EQ(
        read(header("ElementDataFile", "ElementDataFile = scan.raw")).layers.front().values.back(),
        7);
}

TEST_F(MetaImage, ReadsBothByteOrders) {
    std::string shorts = header("ElementType", "ElementType = MET_SHORT");
    std::string data;
    for (const char c : kData) data += std::string{'\1', c};
    shorts.replace(shorts.find("MSB = False"), 11, "MSB = True");
    EXPECT_EQ(read(shorts + data).layers.front().values.back(), 263);
}

TEST_F(MetaImage, RefusesWhatItCannotRead) {
    expect_refused("just text\n", "no MetaImage");
    expect_refused(header("DimSize") + kData, "DimSize");
    expect_refused(header("NDims", "NDims = two") + kData, "whole number");
    expect_refused(header("NDims", "NDims = 2") + kData, "2 dimensions");
    expect_refused(header("ElementDataFile", "ElementDataFile = absent.raw"), "does not exist");
    expect_refused(header("ElementDataFile", "ElementDataFile = LIST"), "several files");
    expect_refused(header("DimSize", "DimSize = 900 900 900") + kData, "too short to hold");
    expect_refused(header("DimSize", "DimSize = 2 0 2") + kData, "voxels along axis 1");
}

TEST_F(MetaImage, RefusesASpacingThatIsNone) {
    for (const char* spacing : {"0 1 1", "-1 1 1", "nan 1 1", "inf 1 1"})
        expect_refused(header("ElementSpacing", "ElementSpacing = " + std::string(spacing)) + kData,
                       "spacing");
    expect_refused(header("TransformMatrix", "TransformMatrix = 1 0 0 1 0 0 0 0 1") + kData,
                   "singular");
}

}  // namespace
}  // namespace myotet::segmentation
