// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "Core/Errors.h"
#include "DicomSample.h"
#include "Samples.h"
#include "Segmentation/Census.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;
using samples::DicomSample;
using ::testing::HasSubstr;

const fs::path kLabels = fs::path(MYOTET_SHARED_DIR) / "data" / "labels";

class DicomSeg : public ::testing::Test {
protected:
    LabelFile read(const std::string& bytes) {
        return read_labels(samples::write_bytes(folder.path() / "scan.dcm", bytes));
    }
    void expect_refused(const std::string& bytes, const char* reason) {
        try {
            (void)read(bytes);
            ADD_FAILURE() << "read, but: " << reason;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("scan.dcm"));
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    ::myotet::testing::TemporaryFolder folder;
};

TEST_F(DicomSeg, HasPlaceNamesAndColours) {
    const LabelFile found = read(DicomSample().bytes());
    ASSERT_EQ(found.layers.size(), 1u);
    EXPECT_TRUE(found.warnings.empty());
    const LabelVolume& volume = found.layers.front();
    // Slices at 10, 12 and 16 mm: the one at 14 is empty.
    EXPECT_EQ(volume.size, (Index3{3, 2, 4}));
    EXPECT_EQ(volume.values, (std::vector<std::int32_t>{1, 0, 0, 0, 0, 2,  //
                                                        0, 1, 0, 0, 0, 0,  //
                                                        0, 0, 0, 0, 0, 0,  //
                                                        0, 0, 0, 2, 2, 2}));
    // Columns are 0.5 mm apart, rows 0.75 mm.
    constexpr double kRounding = 1e-9;
    EXPECT_LT((volume.index_to_lps * Vec3(1, 1, 3) - Vec3(-4.5, 20.75, 16)).norm(), kRounding);
    EXPECT_EQ(volume.name_of(1), "biceps");
    EXPECT_EQ(volume.name_of(2), "M\xc3\xbcller");  // written as ISO 8859-1
    ASSERT_TRUE(volume.names.at(1).colour);
    // 41661, 41167, 40792 is what dcmqi writes for its liver, (221, 130, 101) in 3D Slicer's table.
    constexpr double kColour = 0.01;
    const Vec3 colour(volume.names.at(1).colour->data());
    EXPECT_LT((colour - Vec3(221, 130, 101) / 255).cwiseAbs().maxCoeff(), kColour)
        << 255 * colour.transpose();
    EXPECT_FALSE(volume.names.at(2).colour);
}

TEST_F(DicomSeg, PutsOverlappingSegmentsIntoLayers) {
    DicomSample sample;
    sample.frames[3].mask = "110000";  // over the first frame of segment 1
    const LabelFile found = read(sample.bytes());
    ASSERT_EQ(found.layers.size(), 2u);
    EXPECT_EQ(count_labels(found.layers[0]).size(), 1u);
    EXPECT_EQ(found.layers[1].values[0], 2);
    EXPECT_EQ(found.layers[1].name_of(2), "M\xc3\xbcller");
    EXPECT_EQ(found.layers[0].names.size(), 1u);
}

TEST_F(DicomSeg, IsReadInEveryUncompressedTransferSyntax) {
    const LabelFile expected = read(DicomSample().bytes());
    DicomSample deflated;
    deflated.transfer_syntax = "1.2.840.10008.1.2.1.99";
    const LabelFile found = read(deflated.bytes());
    EXPECT_EQ(found.layers.front().values, expected.layers.front().values);
    DicomSample compressed;
    compressed.transfer_syntax = "1.2.840.10008.1.2.5";
    expect_refused(compressed.bytes(), "1.2.840.10008.1.2.5");
}

TEST_F(DicomSeg, RefusesOtherObjectsByName) {
    DicomSample fractional;
    fractional.type = "FRACTIONAL";
    expect_refused(fractional.bytes(), "fractional segmentation");
    DicomSample labelmap;
    labelmap.sop_class = "1.2.840.10008.5.1.4.1.1.66.7";
    expect_refused(labelmap.bytes(), "label map segmentation");
    DicomSample ct;
    ct.sop_class = "1.2.840.10008.5.1.4.1.1.2";
    expect_refused(ct.bytes(), "CTImageStorage");
    expect_refused(std::string(200, 'x'), "mark 'DICM'");
}

TEST_F(DicomSeg, RefusesFramesThatAreNotOnOneGrid) {
    DicomSample uneven;
    uneven.frames[1].position[2] = 17.1;
    expect_refused(uneven.bytes(), "frame 3 lies off the grid");
    DicomSample sideways;
    sideways.frames[2].position[0] += 0.2;
    expect_refused(sideways.bytes(), "off the grid");
    DicomSample twice;
    twice.frames[1] = twice.frames[0];
    expect_refused(twice.bytes(), "second one of segment 1");
    DicomSample unknown;
    unknown.frames[1].segment = 9;
    expect_refused(unknown.bytes(), "segment 9");
}

TEST_F(DicomSeg, RefusesPixelsThatAreNotAsManyAsItTells) {
    DicomSample sample;
    sample.rows = 200;
    expect_refused(sample.bytes(), "bytes of pixels");
    DicomSample frames;
    frames.number_of_frames = 3;
    expect_refused(frames.bytes(), "frames");
}

TEST_F(DicomSeg, RefusesPositionsThatMakeAHugeVolumeOfASmallFile) {
    DicomSample sample;
    sample.rows = 100;
    sample.columns = 100;
    for (auto& frame : sample.frames) frame.mask.assign(10000, '1');
    sample.frames.erase(sample.frames.begin() + 2);
    sample.frames[2].position[2] = 60010;  // 10 001 slices, 6 mm apart
    expect_refused(sample.bytes(), "100 x 100 x 10001 voxels, more than a file of its size");
    sample.frames[2].position[2] = 6e6;
    expect_refused(sample.bytes(), "more slices than any scan has");
}

TEST_F(DicomSeg, RefusesEveryFileThatIsCutShort) {
    const std::string whole = DicomSample().bytes();
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_THROW((void)read(whole.substr(0, length)), Error) << length;
}

TEST_F(DicomSeg, MeetsEveryDamagedByteWithoutHarm) {
    const std::string whole = DicomSample().bytes();
    ::testing::internal::CaptureStdout();  // a library prints nothing, DCMTK neither
    ::testing::internal::CaptureStderr();
    for (std::size_t at = 128; at < whole.size(); ++at)
        for (const int flip : {1, 0x80}) {
            std::string damaged = whole;
            damaged[at] = static_cast<char>(damaged[at] ^ flip);
            try {
                (void)read(damaged);
            } catch (const Error&) {
            }
        }
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(DicomSegOfOthers, AgreesWithItsNrrdVoxelByVoxel) {
    const fs::path folder = kLabels / "dcmqi";
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
    // Which layer of the .dcm holds which .nrrd: dcmqi's converter splits overlaps as we do.
    struct Pair {
        const char *dicom, *nrrd;
        std::size_t layer, layers;
    };
    for (const Pair& pair : {Pair{"liver.dcm", "liver_seg.nrrd", 0, 1},
                             {"partial_overlaps.dcm", "partial_overlaps-1.nrrd", 0, 3},
                             {"partial_overlaps.dcm", "partial_overlaps-2.nrrd", 1, 3},
                             {"partial_overlaps.dcm", "partial_overlaps-3.nrrd", 2, 3}}) {
        const LabelFile found = read_labels(folder / pair.dicom);
        const LabelVolume nrrd = read_labels(folder / pair.nrrd).layers.front();
        ASSERT_EQ(found.layers.size(), pair.layers);
        const LabelVolume& volume = found.layers[pair.layer];
        EXPECT_EQ(volume.size, nrrd.size);
        EXPECT_EQ(volume.values, nrrd.values) << pair.nrrd;
        constexpr double kWritten = 1e-5;  // the liver's positions have seven digits
        EXPECT_LT((volume.index_to_lps.matrix() - nrrd.index_to_lps.matrix()).cwiseAbs().maxCoeff(),
                  kWritten);
    }
    const LabelFile liver = read_labels(folder / "liver.dcm");
    EXPECT_EQ(liver.layers.front().name_of(1), "Liver");
    EXPECT_EQ(read_labels(folder / "partial_overlaps.dcm").layers[1].name_of(2), "ORANGE");
}

TEST(DicomSegOfOthers, RestoresSlicesThatAreAbsent) {
    const fs::path folder = kLabels / "highdicom";
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
    const auto read = [&](const char* name) { return read_labels(folder / name); };
    const LabelFile overlap = read("seg_image_ct_binary_overlap.dcm");
    ASSERT_EQ(overlap.layers.size(), 2u);
    // Frames at -99.48 and from 103.02 to 105.52 mm, 1.25 mm apart.
    EXPECT_EQ(overlap.layers[0].size, (Index3{16, 16, 165}));
    EXPECT_EQ(overlap.layers[0].name_of(1), "first segment");
    EXPECT_EQ(overlap.layers[1].name_of(2), "second segment");
    EXPECT_EQ(count_labels(overlap.layers[0]).front().voxels, 64);
    EXPECT_EQ(count_labels(overlap.layers[1]).front().voxels, 16);
    const LabelVolume one = read("seg_image_ct_binary_single_frame.dcm").layers.front();
    EXPECT_EQ(one.size, (Index3{128, 128, 1}));
    EXPECT_DOUBLE_EQ(one.spacing()[2], 5);
    EXPECT_EQ(count_labels(read("seg_image_ct_binary.dcm").layers.front()).front().voxels, 638);
    EXPECT_THROW((void)read("seg_image_ct_binary_fractional.dcm"), InputError);
}

}  // namespace
}  // namespace myotet::segmentation
