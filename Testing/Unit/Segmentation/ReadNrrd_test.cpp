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
const std::string kPlace =
    "space: left-posterior-superior\nspace directions: (0,2,0) (3,0,0) (0,0,4)\n"
    "space origin: (10,20,30)\n";

std::string header(const std::string& more, const std::string& encoding = "raw",
                   const std::string& sizes = "2 2 2") {
    return "NRRD0004\n# made by a test\ntype: unsigned char\ndimension: 3\nsizes: " + sizes +
           "\nencoding: " + encoding + "\n" + more;
}

class Nrrd : public ::testing::Test {
protected:
    LabelFile read(const std::string& bytes, const ReadOptions& options = {}) {
        return read_labels(samples::write_bytes(folder.path() / "scan.nrrd", bytes), options);
    }
    void expect_refused(const std::string& bytes, const char* reason) {
        try {
            (void)read(bytes);
            ADD_FAILURE() << "read, but: " << reason;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("scan.nrrd"));
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    ::myotet::testing::TemporaryFolder folder;
};

TEST_F(Nrrd, PutsVoxelsInLpsWhateverItsOwnSpace) {
    EXPECT_EQ(read(header(kPlace + "\n") + kData).layers.front().index_to_lps * Vec3(1, 1, 1),
              Vec3(13, 22, 34));
    std::string ras = kPlace;
    ras.replace(ras.find("left-posterior-superior"), 23, "right-anterior-superior");
    EXPECT_EQ(read(header(ras + "\n") + kData).layers.front().index_to_lps * Vec3(1, 1, 1),
              Vec3(-13, -22, 34));
}

TEST_F(Nrrd, KeepsAShearedTransform) {
    const LabelFile found = read(header("space: LPS\nspace directions: (2,1,0) (0,3,0) (0,1,4)\n"
                                        "space origin: (0,0,0)\n\n") +
                                 kData);
    EXPECT_LT((found.layers.front().index_to_lps * Vec3(1, 1, 1) - Vec3(2, 5, 4)).norm(), 1e-12);
}

TEST_F(Nrrd, ReadsTextAndDetachedData) {
    EXPECT_EQ(
        read(header(kPlace + "\n", "ascii") + "0 1 2 3\n4 5 6 7\n").layers.front().values.back(),
        7);
    samples::write_bytes(folder.path() / "data.raw", "skip\nxy" + kData);
    const auto detached =
        samples::write_bytes(folder.path() / "scan.nhdr",
                             header(kPlace + "line skip: 1\nbyte skip: 2\ndata file: data.raw\n"));
    EXPECT_EQ(read_labels(detached).layers.front().values.back(), 7);
    samples::write_bytes(detached, header(kPlace + "byte skip: -1\ndata file: data.raw\n"));
    EXPECT_EQ(read_labels(detached).layers.front().values.back(), 7);
}

TEST_F(Nrrd, ReadsSegmentNamesOfSlicer) {
    const LabelFile found =
        read(header(kPlace + "Segment0_ID:=Segment_1\nSegment0_LabelValue:=3\n"
                             "Segment0_Name:=cervical column\nSegment0_Color:=1 0.5 0\n"
                             "Segment1_ID:=ribs\nSegment1_LabelValue:=5\n\n") +
             kData);
    EXPECT_EQ(found.layers.front().name_of(3), "cervical column");
    EXPECT_EQ(found.layers.front().names.at(3).colour, (std::array<double, 3>{1, 0.5, 0}));
    EXPECT_EQ(found.layers.front().name_of(5), "ribs");
    EXPECT_EQ(found.names_from, folder.path() / "scan.nrrd");
}

TEST_F(Nrrd, TakesTheUnitFromTheHeader) {
    const std::string cm = kPlace + "space units: \"cm\" \"cm\" \"cm\"\n\n";
    EXPECT_EQ(read(header(cm) + kData).layers.front().spacing(), Vec3(20, 30, 40));
    expect_refused(header(kPlace + "space units: \"inch\" \"inch\" \"inch\"\n\n") + kData, "inch");
}

TEST_F(Nrrd, WarnsWhenThePlaceIsUnknown) {
    const LabelFile found = read(header("\n") + kData);
    EXPECT_EQ(found.layers.front().spacing(), Vec3(1, 1, 1));
    EXPECT_THAT(found.warnings, ::testing::ElementsAre(HasSubstr("1 mm was assumed")));
    const LabelFile spaced = read(header("spacings: 2 3 4\n\n") + kData);
    EXPECT_EQ(spaced.layers.front().spacing(), Vec3(2, 3, 4));
    EXPECT_THAT(spaced.warnings, ::testing::ElementsAre(HasSubstr("nothing of its place")));
}

TEST_F(Nrrd, RefusesWhatItCannotRead) {
    expect_refused("NRRX0004\n", "does not start with 'NRRD'");
    expect_refused(header(kPlace + "\n", "bzip2") + kData, "bzip2");
    expect_refused(header(kPlace + "byte skip: -5\n\n") + kData, "byte skip is -5");
    expect_refused(header("space: LPS\nspace directions: (1,0,0) (0,1,0\n\n") + kData, "(x,y,z)");
    expect_refused(header("space: LPS\nspace directions: (1,0) (0,1) (1,1)\n\n") + kData, "three");
    expect_refused(header(kPlace + "space directions: (1,0,0) (0,1,0)\n\n") + kData, "one entry");
    expect_refused(header(kPlace + "data file: LIST\na.raw\n"), "several files");
    expect_refused(header(kPlace + "data file: slice%03d.raw 1 9 1\n"), "several files");
    expect_refused(header(kPlace + "data file: absent.raw\n"), "does not exist");
    expect_refused(header(kPlace + "\n", "raw", "400 400 400") + kData, "too short to hold");
    expect_refused(header(kPlace + "\n", "raw", "2 -2 2") + kData, "header");
    expect_refused(header(kPlace + "\n", "ascii") + "0 1 2 x 4 5 6 7", "'x'");
    expect_refused(header(kPlace + "\n", "ascii") + "0 1 2", "cut short");
}

TEST_F(Nrrd, RefusesASpacingThatIsNone) {
    for (const char* spacings : {"nan 1 1", "1 inf 1", "0 1 1", "1 -2 1"})
        expect_refused(header("spacings: " + std::string(spacings) + "\n\n") + kData, "header");
    expect_refused(header("space: LPS\nspace directions: (1,0,0) (1,0,0) (0,0,1)\n\n") + kData,
                   "singular");
    expect_refused(header("space: LPS\nspace directions: (nan,0,0) (0,1,0) (0,0,1)\n\n") + kData,
                   "finite");
}

TEST_F(Nrrd, TakesASoleLayer) {
    const LabelFile found = read(
        "NRRD0004\ntype: uint8\ndimension: 5\nsizes: 1 2 2 2 1\nencoding: raw\n"
        "space: left-anterior-superior\nspace directions: none (2,0,0) (0,3,0) (0,0,+4e0) none\n"
        "kinds: list domain domain domain none\nspace origin: (1,2,3)\n\n" +
        kData);
    EXPECT_EQ(found.layers.front().size, (Index3{2, 2, 2}));
    EXPECT_EQ(found.layers.front().index_to_lps * Vec3(1, 1, 1), Vec3(3, -5, 7));
}

/// Two values a voxel of 2 x 2 x 1 voxels: layer 0 is 1 1 2 0, layer 1 is 0 1 1 0.
std::string layered(const std::string& kind, const std::string& more = "") {
    return "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 2 2 1\nencoding: raw\nspace: LPS\n"
           "space directions: none (1,0,0) (0,2,0) (0,0,3)\nkinds: " +
           kind + " domain domain domain\nspace origin: (4,5,6)\n" + more + "\n" +
           std::string("\1\0\1\1\2\1\0\0", 8);
}

TEST_F(Nrrd, KeepsLayersApartWithTheirNames) {
    const LabelFile found =
        read(layered("list",
                     "Segment0_ID:=a\nSegment0_Name:=bone\nSegment0_LabelValue:=1\n"
                     "Segment0_Layer:=0\nSegment1_ID:=b\nSegment1_Name:=tendon\n"
                     "Segment1_LabelValue:=1\nSegment1_Layer:=1\nSegment1_Color:=0 0.5 1\n"
                     "Segment2_ID:=c\nSegment2_Name:=muscle\nSegment2_LabelValue:=2\n"
                     "Segment2_Layer:=0\n"));
    ASSERT_EQ(found.layers.size(), 2u);
    EXPECT_EQ(found.layers[0].values, (std::vector<std::int32_t>{1, 1, 2, 0}));
    EXPECT_EQ(found.layers[1].values, (std::vector<std::int32_t>{0, 1, 1, 0}));
    EXPECT_EQ(found.layers[0].name_of(1), "bone");
    EXPECT_EQ(found.layers[0].name_of(2), "muscle");
    EXPECT_EQ(found.layers[1].name_of(1), "tendon");
    EXPECT_EQ(found.layers[1].names.at(1).colour, (std::array<double, 3>{0, 0.5, 1}));
    EXPECT_EQ(found.layers[1].index_to_lps * Vec3(1, 1, 1), Vec3(5, 7, 9));
    EXPECT_TRUE(found.warnings.empty());
}

TEST_F(Nrrd, ReadsSegmentsOfSlicersFirstFormWithoutValueAndLayer) {
    const LabelFile found =
        read(layered("vector", "Segment0_ID:=a\nSegment0_Name:=bone\nSegment1_ID:=b\n"));
    ASSERT_EQ(found.layers.size(), 2u);
    EXPECT_EQ(found.layers[0].name_of(1), "bone");
    EXPECT_EQ(found.layers[1].name_of(1), "b");
}

TEST_F(Nrrd, TellsWhenItTakesValuesForLayers) {
    EXPECT_THAT(read(layered("list")).warnings,
                ::testing::ElementsAre(HasSubstr("taken as layers")));
}

TEST_F(Nrrd, ReadsLayersThatComeLast) {
    const LabelFile found = read(
        "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 2 1 2\nencoding: ascii\nspace: LPS\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1) none\nkinds: domain domain domain list\n\n"
        "1 1 2 0  0 1 1 0\n");
    ASSERT_EQ(found.layers.size(), 2u);
    EXPECT_EQ(found.layers[0].values, (std::vector<std::int32_t>{1, 1, 2, 0}));
    EXPECT_EQ(found.layers[1].values, (std::vector<std::int32_t>{0, 1, 1, 0}));
}

TEST_F(Nrrd, ReadsMasksOfLabelsWhenAsked) {
    expect_refused(layered("none"), "--one-hot");
    std::string masks = layered("none", "Segment1_Name:=passed over, for there is no Segment0\n");
    masks[masks.size() - 4] = 1;  // voxel 2 of the first: 1 1 1 0
    const LabelFile found = read(masks, {.one_hot = true});
    ASSERT_EQ(found.layers.size(), 2u);
    EXPECT_EQ(found.layers[0].values, (std::vector<std::int32_t>{1, 1, 1, 0}));
    EXPECT_EQ(found.layers[1].values, (std::vector<std::int32_t>{0, 2, 2, 0}));
}

TEST_F(Nrrd, RefusesColoursAndVectors) {
    expect_refused(layered("RGB-color"), "colours");
    expect_refused(layered("covariant-vector"), "covariant-vector");
    expect_refused(
        "NRRD0004\ntype: uint8\ndimension: 5\nsizes: 2 1 1 1 2\nencoding: ascii\nspace: LPS\n"
        "space directions: none (1,0,0) (0,1,0) (0,0,1) none\n"
        "kinds: list domain domain domain list\n\n1 1 1 1\n",
        "several");
}

TEST_F(Nrrd, FollowsAHeaderOnlyIntoItsOwnFolder) {
    std::filesystem::create_directories(folder.path() / "case" / "data");
    samples::write_bytes(folder.path() / "secret.raw", kData);
    samples::write_bytes(folder.path() / "case" / "data" / "own.raw", kData);
    std::filesystem::create_symlink("../secret.raw", folder.path() / "case" / "link.raw");
    const auto file = folder.path() / "case" / "scan.nhdr";
    const auto read_with = [&](const std::string& data) {
        return read_labels(
            samples::write_bytes(file, header(kPlace + "data file: " + data + "\n")));
    };
    EXPECT_EQ(read_with("data/own.raw").layers.front().values.back(), 7);
    EXPECT_EQ(read_with("data/../data/own.raw").layers.front().values.back(), 7);
    EXPECT_EQ(
        read_with((folder.path() / "case/data/own.raw").string()).layers.front().values.back(), 7);
    for (const std::string& data :
         {std::string("../secret.raw"), (folder.path() / "secret.raw").string(),
          std::string("data/../../secret.raw"), std::string("link.raw"), std::string("/dev/zero")})
        EXPECT_THROW((void)read_with(data), InputError) << data;
}

}  // namespace
}  // namespace myotet::segmentation
