// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/NameTable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Samples.h"

namespace myotet::segmentation {
namespace {

using ::testing::HasSubstr;
using Colour = std::array<double, 3>;

class NameTable : public ::testing::Test {
protected:
    std::map<std::int32_t, LabelName> read(const std::string& text) {
        return read_name_table(samples::write_bytes(folder.path() / "table", text));
    }
    std::map<std::int32_t, std::string> names(const std::string& text) {
        std::map<std::int32_t, std::string> found;
        for (const auto& [value, label] : read(text)) found[value] = label.name;
        return found;
    }
    void expect_refused(const std::string& text, const char* reason) {
        try {
            (void)read(text);
            ADD_FAILURE() << "read, but: " << reason;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    ::myotet::testing::TemporaryFolder folder;
};

using Names = std::map<std::int32_t, std::string>;

TEST_F(NameTable, PlainLines) {
    EXPECT_EQ(
        names(
            "# muscles\n\n1 biceps brachii\n  7\ttriceps  \r\n// more\n9: soleus\n10, m. rectus\n"),
        (Names{{1, "biceps brachii"}, {7, "triceps"}, {9, "soleus"}, {10, "m. rectus"}}));
    EXPECT_EQ(names("\xef\xbb\xbf"
                    "3 \xce\xbcuscle"),
              (Names{{3, "\xce\xbcuscle"}}));
    EXPECT_EQ(names("0 background\n1 bone\n"), (Names{{1, "bone"}}));
}

TEST_F(NameTable, NamesMayEndInNumbers) {
    // As many words as in a table with codes, but the numbers tell the names apart.
    EXPECT_EQ(names("1 rib 1\n2 rib 2\n"), (Names{{1, "rib 1"}, {2, "rib 2"}}));
    EXPECT_EQ(names("1 C 1\n2 vertebra L 2\n"), (Names{{1, "C 1"}, {2, "vertebra L 2"}}));
}

TEST_F(NameTable, MricronsCodesAreNotPartOfTheNames) {
    EXPECT_EQ(names("1 Precentral_L 2001\n2 Precentral_R 2002\n3 Vermis_10 9170\n"),
              (Names{{1, "Precentral_L"}, {2, "Precentral_R"}, {3, "Vermis_10"}}));
}

TEST_F(NameTable, ItkSnap) {
    const auto found = read(
        "################\n# ITK-SnAP Label Description File\n# IDX   -R-  -G-  -B-  -A--  VIS MSH "
        " LABEL\n################\n    0     0    0    0        0  0  0    \"Clear Label\"\n    5  "
        " "
        "255    0   51        1  1  1    \"Label \"5\", left\"\n");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.at(5).name, "Label \"5\", left");
    EXPECT_EQ(found.at(5).colour, (Colour{1, 0, 0.2}));
}

TEST_F(NameTable, FreeSurferAndSlicer) {
    const auto found = read(
        "#No. Label Name:   R   G   B   A\n0 Unknown 0 0 0 0\n2  Left-Cerebral-White-Matter  245 "
        "245 "
        "245 0\n17 vastus lateralis 230 125 125 255\n30 three channels 0 51 255\n");
    EXPECT_EQ(found.at(2).name, "Left-Cerebral-White-Matter");
    EXPECT_EQ(found.at(17).name, "vastus lateralis");
    EXPECT_EQ(found.at(17).colour, (Colour{230 / 255.0, 125 / 255.0, 125 / 255.0}));
    EXPECT_EQ(found.at(30).name, "three channels");
    EXPECT_EQ(found.at(30).colour, (Colour{0, 0.2, 1}));
}

TEST_F(NameTable, Bids) {
    const auto found = read(
        "index\tname\tabbreviation\tcolor\tmapping\n0\tbackground\tBG\t#000000\t0\n"
        "3\tGray Matter\tGM\t#ff3300\t1\n4\tBone\tn/a\tn/a\t2\n");
    EXPECT_EQ(found.at(3).name, "Gray Matter");
    EXPECT_EQ(found.at(3).colour, (Colour{1, 0.2, 0}));
    EXPECT_FALSE(found.at(4).colour);
    EXPECT_EQ(names("name,index\n\"tibia\",4\n"), (Names{{4, "tibia"}}));
}

TEST_F(NameTable, RefusesLinesThatMakeNoSense) {
    expect_refused("1 biceps\nfoo bar\n", "line 2: 'foo bar'");
    expect_refused("1\n", "line 1: '1'");
    expect_refused("1.5 biceps\n", "line 1");
    expect_refused("99999999999 biceps\n", "line 1");
    expect_refused("index\tname\nx\tbone\n", "line 2");
    expect_refused("index\tname\n3\n", "line 2");
    expect_refused("# nothing\n\n", "no label names");
    expect_refused("3 tibia\n4 fibula\n3 femur\n", "line 3: names label 3 'femur'");
    expect_refused(std::string("\x1f\x8b\x00\x01", 4), "line 1");
    EXPECT_EQ(names("3 tibia\n3 tibia\n"), (Names{{3, "tibia"}}));
    EXPECT_THROW((void)read_name_table(folder.path() / "absent"), IoError);
    EXPECT_THROW((void)read_name_table(folder.path()), Error);
}

TEST_F(NameTable, IsFoundUnderTheUsualNames) {
    const auto file = [&](const char* name) { return folder.path() / name; };
    EXPECT_FALSE(find_name_table(file("scan.nii.gz")));
    const auto expect_found = [&](const char* labels, const char* table) {
        samples::write_bytes(file(table), "1 bone\n");
        EXPECT_EQ(find_name_table(file(labels)), file(table));
        std::filesystem::remove(file(table));
    };
    expect_found("scan.nii.gz", "scan_labels.txt");
    expect_found("sub-01_dseg.nii.gz", "sub-01_dseg.tsv");
    expect_found("aal.nii.gz", "aal.nii.txt");
    expect_found("aal.nii", "aal.nii.txt");
    expect_found("scan.seg.nrrd", "scan.ctbl");
    expect_found("scan.mha", "scan.label");
    expect_found("scan.nrrd", "scan_LUT.txt");
    expect_found("scan.nrrd", "knee.ctbl");  // the only one in the folder
    samples::write_bytes(file("a.ctbl"), "");
    samples::write_bytes(file("b.ctbl"), "");
    EXPECT_FALSE(find_name_table(file("scan.nrrd")));
}

TEST_F(NameTable, IsWrittenAsItIsRead) {
    const std::map<std::int32_t, LabelName> table{{3, {"tibia", {}}},
                                                  {10, {"vastus medialis", {}}}};
    write_name_table(table, folder.path() / "out.txt");
    EXPECT_EQ(samples::read_bytes(folder.path() / "out.txt"), "3 tibia\n10 vastus medialis\n");
    EXPECT_EQ(read_name_table(folder.path() / "out.txt").at(10).name, "vastus medialis");
}

}  // namespace
}  // namespace myotet::segmentation
