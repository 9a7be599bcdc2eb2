// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ReadLabels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "Core/Errors.h"
#include "Samples.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;
using myotet::testing::TemporaryFolder;
using ::testing::HasSubstr;

// NIfTI keeps its transform in 32 bit, NRRD and MetaImage in some 10 digits of text.
constexpr double kStored = 1e-5;

void expect_same(const LabelVolume& a, const LabelVolume& b) {
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.values, b.values);
    EXPECT_LT((a.index_to_lps.matrix() - b.index_to_lps.matrix()).cwiseAbs().maxCoeff(), kStored);
}

class EveryFormat : public ::testing::TestWithParam<const char*> {
protected:
    TemporaryFolder folder;
    fs::path file = folder.path() / (std::string("labels") + GetParam());
};

INSTANTIATE_TEST_SUITE_P(Labels, EveryFormat,
                         ::testing::Values(".nii", ".nii.gz", ".nrrd", ".seg.nrrd", ".mha"));

TEST_P(EveryFormat, KeepsValuesAndPlaceOfAnyScan) {
    Mat3 mirrored = samples::oblique_axes();
    mirrored.col(1) *= -1;
    for (const Mat3& axes : {Mat3(Vec3(1, 2, 3).asDiagonal()), samples::oblique_axes(), mirrored}) {
        const LabelVolume volume = samples::make_volume(axes);
        write_labels(volume, file);
        expect_same(read_labels(file).layers.front(), volume);
    }
}

TEST_P(EveryFormat, KeepsLargeLabelValues) {
    for (const std::int32_t value : {255, 256, 32767, 32768, 200001, 2147483647}) {
        LabelVolume volume = samples::make_volume();
        volume.values[17] = value;
        write_labels(volume, file);
        EXPECT_EQ(read_labels(file).layers.front().values, volume.values);
    }
}

TEST_P(EveryFormat, KeepsOneSliceAndOneVoxel) {
    LabelVolume slice = samples::make_volume();
    slice.size = {10, 6, 1};
    LabelVolume voxel = samples::make_volume();
    voxel.size = {1, 1, 1};
    voxel.values = {3};
    for (const LabelVolume& volume : {slice, voxel}) {
        write_labels(volume, file);
        expect_same(read_labels(file).layers.front(), volume);
    }
}

TEST_P(EveryFormat, RefusesEveryFileThatIsCutShort) {
    write_labels(samples::make_volume(), file);
    const std::string whole = samples::read_bytes(file);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        samples::write_bytes(file, whole.substr(0, length));
        EXPECT_THROW((void)read_labels(file), Error) << length << " of " << whole.size();
    }
}

TEST_P(EveryFormat, MeetsEveryDamagedByteWithoutHarm) {
    write_labels(samples::make_volume(), file);
    const std::string whole = samples::read_bytes(file);
    // Past the checksum only gzip's own header may change without harm.
    const bool checksum_covers_all = std::string(GetParam()) == ".nii.gz";
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const int flip : {1, 0x80}) {
            std::string damaged = whole;
            damaged[at] = static_cast<char>(damaged[at] ^ flip);
            samples::write_bytes(file, damaged);
            try {
                const LabelVolume found = read_labels(file).layers.front();
                if (checksum_covers_all) expect_same(found, samples::make_volume());
            } catch (const Error&) {
            }
        }
}

TEST_P(EveryFormat, RefusesAVolumeWithoutLabels) {
    LabelVolume volume = samples::make_volume();
    volume.values.assign(60, 0);
    write_labels(volume, file);
    try {
        (void)read_labels(file);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(file.string()));
        EXPECT_THAT(error.what(), HasSubstr("holds no labels"));
    }
}

TEST_P(EveryFormat, WritesTheSameBytesAgain) {
    write_labels(samples::make_volume(), file);
    const std::string first = samples::read_bytes(file);
    write_labels(samples::make_volume(), file);
    EXPECT_EQ(samples::read_bytes(file), first);
}

TEST_P(EveryFormat, LeavesNothingBehindWhenItCannotBeWritten) {
    const fs::path elsewhere = folder.path() / "none" / file.filename();
    try {
        write_labels(samples::make_volume(), elsewhere);
        FAIL();
    } catch (const IoError& error) {
        EXPECT_THAT(error.what(), HasSubstr(elsewhere.string() + ": cannot be written"));
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ReadLabels, NamesTravelInNiftiAndNrrd) {
    const TemporaryFolder folder;
    const LabelVolume volume = samples::make_volume();
    for (const char* name : {"a.nii.gz", "b.nii", "c.nrrd", "d.seg.nrrd"}) {
        const fs::path file = folder.path() / name;
        write_labels(volume, file);
        const LabelFile found = read_labels(file);
        EXPECT_EQ(found.names_from, file);
        ASSERT_EQ(found.layers.front().names.size(), 3u) << name;
        for (const auto& [value, label] : volume.names) {
            EXPECT_EQ(found.layers.front().names.at(value).name, label.name);
            EXPECT_EQ(found.layers.front().names.at(value).colour, label.colour);
        }
    }
}

TEST(ReadLabels, ATableBesideNamesWhatTheFileDoesNot) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "scan.mha";
    write_labels(samples::make_volume(), file);
    EXPECT_TRUE(read_labels(file).layers.front().names.empty());
    samples::write_bytes(folder.path() / "scan_labels.txt", "1 brachialis\n3 triceps\n");
    const LabelFile found = read_labels(file);
    EXPECT_EQ(found.names_from, folder.path() / "scan_labels.txt");
    EXPECT_EQ(found.layers.front().name_of(3), "triceps");
}

TEST(ReadLabels, AnExplicitTableWinsOverTheFileAndKeepsItsOtherNames) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "scan.nii.gz", table = folder.path() / "mine.txt";
    write_labels(samples::make_volume(), file);
    samples::write_bytes(table, "1 brachialis\n");
    const LabelFile found = read_labels(file, {.names = table});
    EXPECT_EQ(found.layers.front().name_of(1), "brachialis");
    EXPECT_EQ(found.layers.front().name_of(4), "m. soleus");
    EXPECT_EQ(found.names_from, table);
}

TEST(ReadLabels, ABadTableBesideIsAWarningAndAnExplicitOneAnError) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "scan.mha";
    write_labels(samples::make_volume(), file);
    const fs::path table =
        samples::write_bytes(folder.path() / "scan.txt", "Notes: patient moved.\n");
    const LabelFile found = read_labels(file);
    EXPECT_TRUE(found.layers.front().names.empty());
    ASSERT_EQ(found.warnings.size(), 1u);
    EXPECT_THAT(found.warnings[0], HasSubstr("scan.txt"));
    EXPECT_THROW((void)read_labels(file, {.names = table}), InputError);
    EXPECT_THROW((void)read_labels(file, {.names = folder.path() / "absent.txt"}), IoError);
}

TEST(ReadLabels, RefusesWhatIsNoLabelFile) {
    const TemporaryFolder folder;
    EXPECT_THROW((void)read_labels(folder.path() / "absent.nii.gz"), IoError);
    EXPECT_THROW((void)read_labels(folder.path()), IoError);
    EXPECT_THROW((void)read_labels(samples::write_bytes(folder.path() / "empty.nrrd", "")),
                 IoError);
    EXPECT_THROW((void)read_labels(samples::write_bytes(folder.path() / "scan.dcm", "DICM")),
                 InputError);
    for (const char* name : {"scan.stl", "scan.dcm", "scan.nhdr"})
        EXPECT_THROW(write_labels(samples::make_volume(), folder.path() / name), InputError);
}

TEST(ReadLabels, RefusesOptionsThatAFormatDoesNotHave) {
    const TemporaryFolder folder;
    for (const char* name : {"scan.mha", "scan.nrrd"}) {
        const fs::path file = folder.path() / name;
        write_labels(samples::make_volume(), file);
        EXPECT_THROW((void)read_labels(file, {.orientation = Orientation::qform}), InputError);
    }
    EXPECT_THROW((void)read_labels(folder.path() / "scan.mha", {.one_hot = true}), InputError);
}

TEST(ReadLabels, ATableNamesAValueInEachLayerThatHoldsIt) {
    const TemporaryFolder folder;
    const fs::path table = samples::write_bytes(folder.path() / "mine.txt", "1 a\n2 b\n3 c\n");
    const fs::path file = samples::write_bytes(
        folder.path() / "scan.nrrd",
        "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 2 1 1\nencoding: ascii\nspace: LPS\n"
        "space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\n\n"
        "1 1 2 0\n");
    const LabelFile found = read_labels(file, {.names = table});
    ASSERT_EQ(found.layers.size(), 2u);
    EXPECT_EQ(found.layers[0].names.size(), 2u);
    EXPECT_EQ(found.layers[0].name_of(2), "b");
    EXPECT_EQ(found.layers[1].names.size(), 1u);
    EXPECT_EQ(found.layers[1].name_of(1), "a");
    EXPECT_THAT(found.warnings, ::testing::Contains(HasSubstr("value 1 is in several layers")));
}

TEST(ReadLabels, KnowsItsExtensions) {
    for (const char* name :
         {"a.nii", "b/a.NII.GZ", "a.nrrd", "a.seg.nrrd", "a.mha", "a.mhd", "a.dcm"})
        EXPECT_TRUE(is_label_file(name)) << name;
    for (const char* name : {"a.obj", "a.gz", ".nii", "nrrd", "a.jpg", ""})
        EXPECT_FALSE(is_label_file(name)) << name;
}

}  // namespace
}  // namespace myotet::segmentation
