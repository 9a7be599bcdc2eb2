// SPDX-License-Identifier: Apache-2.0
// What a header tells of a patient stays in it: files are marked wherever their
// format keeps free text, read and written again, and the mark is looked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "Core/Errors.h"
#include "DicomSample.h"
#include "Samples.h"
#include "Segmentation/ByteStream.h"
#include "Segmentation/NameTable.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

const std::string kMark = "Archibald";

/// Inflated when it is a gzip file, so that a mark can be found.
std::string plain_bytes(const fs::path& file) {
    if (!starts_as_gzip(file)) return samples::read_bytes(file);
    ByteStream stream(file, Coding::deflate);
    std::string all;
    char piece[4096];
    while (const std::size_t got = stream.read(piece, sizeof piece)) all.append(piece, got);
    return all;
}

class Privacy : public ::testing::Test {
protected:
    /// Reads a marked file, and looks for the mark in all that comes of it.
    void expect_no_mark(const char* name, const std::string& bytes,
                        const ReadOptions& options = {}) {
        SCOPED_TRACE(name);
        ASSERT_NE(bytes.find(kMark), std::string::npos) << "the file is not marked";
        const LabelFile found =
            read_labels(samples::write_bytes(folder.path() / name, bytes), options);
        std::ostringstream said;
        for (const std::string& warning : found.warnings) said << warning;
        for (const LabelVolume& layer : found.layers)
            for (const auto& [value, label] : layer.names) said << label.name;
        EXPECT_EQ(said.str().find(kMark), std::string::npos) << said.str();
        for (const char* out : {"out.nii.gz", "out.nii", "out.seg.nrrd", "out.mha"}) {
            write_labels(found.layers.front(), folder.path() / out);
            EXPECT_EQ(plain_bytes(folder.path() / out).find(kMark), std::string::npos) << out;
        }
        write_name_table(found.layers.front().names, folder.path() / "out.txt");
        EXPECT_EQ(samples::read_bytes(folder.path() / "out.txt").find(kMark), std::string::npos);
    }
    void expect_unmarked_refusal(const char* name, const std::string& bytes) {
        try {
            (void)read_labels(samples::write_bytes(folder.path() / name, bytes));
            ADD_FAILURE() << name << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find(kMark), std::string::npos) << error.what();
        }
    }
    ::myotet::testing::TemporaryFolder folder;
};

void put(std::string& bytes, std::size_t at, const std::string& text) {
    bytes.replace(at, text.size(), text);
}

TEST_F(Privacy, OfNifti) {
    std::string bytes = samples::nifti_bytes();
    put(bytes, 4, kMark);                // data_type, of Analyze
    put(bytes, 14, kMark);               // db_name
    put(bytes, 148, kMark + " born 9");  // descrip
    put(bytes, 228, kMark);              // aux_file
    put(bytes, 328, kMark);              // intent_name
    expect_no_mark("scan.nii", bytes);
    // Extensions: a comment (code 6), and label names with metadata of the study beside them.
    const std::string xml = "<CaretExtension><Date>" + kMark +
                            "</Date><VolumeInformation><LabelTable><Label Key=\"1\">bone</Label>"
                            "</LabelTable><VolumeMetaData><MD><Name>Patient</Name><Value>" +
                            kMark +
                            "</Value></MD></VolumeMetaData></VolumeInformation>"
                            "</CaretExtension>";
    std::string extensions(4, '\0');
    extensions[0] = 1;
    for (const auto& [code, text] : {std::pair<int, std::string>{6, kMark}, {0, xml}}) {
        std::string block(8, '\0');
        block += text;
        block.resize((block.size() + 15) / 16 * 16);
        block[0] = static_cast<char>(block.size() & 0xFF);
        block[1] = static_cast<char>(block.size() >> 8);
        block[4] = static_cast<char>(code);
        extensions += block;
    }
    std::string extended = bytes.substr(0, 348) + extensions + bytes.substr(352);
    extended = samples::with(extended, 108, static_cast<float>(348 + extensions.size()));
    expect_no_mark("extended.nii", extended);
    EXPECT_EQ(read_labels(folder.path() / "extended.nii").layers.front().name_of(1), "bone");
}

TEST_F(Privacy, OfNrrd) {
    const std::string head =
        "NRRD0004\n# " + kMark + "\ncontent: " + kMark + "\ntype: uint8\ndimension: 3\n" +
        "sizes: 2 2 1\nencoding: ascii\nspace: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
        "labels: \"" +
        kMark + "\" \"\" \"\"\nsample units: " + kMark + "\nPatientName:=" + kMark +
        "\nSegment0_ID:=" + kMark +
        "\nSegment0_Name:=bone\nSegment0_LabelValue:=1\n"
        "Segment0_Tags:=TrackingID:" +
        kMark + "|\nSegmentation_ConversionParameters:=" + kMark + "\n\n";
    expect_no_mark("scan.nrrd", head + "0 1 1 0\n");
    expect_unmarked_refusal("short.nrrd", head + "0 1 1\n");
}

TEST_F(Privacy, OfMetaImage) {
    const std::string head = "ObjectType = Image\nComment = " + kMark + "\nName = " + kMark +
                             "\nPatientName = " + kMark +
                             "\nNDims = 3\nDimSize = 2 2 1\nElementSpacing = 1 1 1\n"
                             "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
    expect_no_mark("scan.mha", head + std::string("\0\1\1\0", 4));
    expect_unmarked_refusal("short.mha", head + std::string("\0\1\1", 3));
}

TEST_F(Privacy, OfDicom) {
    samples::DicomSample sample;
    sample.mark = kMark + "^Doe";
    expect_no_mark("scan.dcm", sample.bytes());
    EXPECT_EQ(read_labels(folder.path() / "scan.dcm").layers.front().name_of(1), "biceps");
    const std::string whole = sample.bytes();
    // Cut short, and damaged byte by byte: what is said of it holds no mark either.
    expect_unmarked_refusal("short.dcm", whole.substr(0, whole.size() - 1));
    for (std::size_t at = 128; at < whole.size(); at += 3) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        try {
            (void)read_labels(samples::write_bytes(folder.path() / "damaged.dcm", damaged));
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find(kMark), std::string::npos) << error.what();
        }
    }
}

TEST_F(Privacy, OfDcmqiTables) {
    const fs::path table = samples::write_bytes(
        folder.path() / "table.json",
        "{\"ContentCreatorName\": \"" + kMark + "\", \"SeriesDescription\": \"" + kMark +
            "\", \"segmentAttributes\": [[{\"labelID\": 1, \"SegmentLabel\": \"bone\", "
            "\"SegmentDescription\": \"" +
            kMark + "\"}]]}");
    for (const auto& [value, label] : read_name_table(table))
        EXPECT_EQ(label.name.find(kMark), std::string::npos);
}

}  // namespace
}  // namespace myotet::segmentation
