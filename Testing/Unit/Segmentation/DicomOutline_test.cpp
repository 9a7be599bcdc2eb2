// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/DicomOutline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "DicomSample.h"
#include "Samples.h"

namespace myotet::segmentation {
namespace {

using samples::element;
using ::testing::HasSubstr;

class DicomOutline : public ::testing::Test {
protected:
    static std::string file_of(const std::string& set,
                               const std::string& syntax = "1.2.840.10008.1.2.1") {
        return std::string(128, '\0') + "DICM" + element(0x00020010, "UI", syntax) + set;
    }
    DicomBytes read(const std::string& bytes) {
        return read_dicom_bytes(samples::write_bytes(folder.path() / "scan.dcm", bytes));
    }
    std::string reason(const std::string& bytes) {
        try {
            (void)read(bytes);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    ::myotet::testing::TemporaryFolder folder;
};

const std::string kNoLength = "\xff\xff\xff\xff";
const std::string kItem("\xfe\xff\x00\xe0", 4), kItemEnd("\xfe\xff\x0d\xe0\0\0\0\0", 8),
    kSequenceEnd("\xfe\xff\xdd\xe0\0\0\0\0", 8), kSequence("\x08\0\x15\x11SQ\0\0", 8);

TEST_F(DicomOutline, GivesTheDataSetAndItsSyntax) {
    const std::string set = element(0x00080060, "CS", "SEG") +
                            samples::sequence(0x00081115, {element(0x00080060, "CS", "CT")});
    const DicomBytes found = read(file_of(set));
    EXPECT_EQ(found.transfer_syntax, "1.2.840.10008.1.2.1");
    EXPECT_EQ(std::string(found.data.begin(), found.data.end()), set);
}

TEST_F(DicomOutline, InflatesADeflatedDataSet) {
    const std::string set = element(0x00080060, "CS", std::string(5000, 'S'));
    const std::string packed = file_of(samples::deflated(set), "1.2.840.10008.1.2.1.99");
    const DicomBytes found = read(packed);
    EXPECT_EQ(found.transfer_syntax, "1.2.840.10008.1.2.1");
    EXPECT_EQ(std::string(found.data.begin(), found.data.end()), set);
    EXPECT_THAT(reason(packed.substr(0, packed.size() - 1)), HasSubstr("cut short"));
    EXPECT_THAT(reason(file_of("\xff\xff\xff", "1.2.840.10008.1.2.1.99")), HasSubstr("damaged"));
}

TEST_F(DicomOutline, FollowsSequencesWithAndWithoutLength) {
    const std::string inner = element(0x00080060, "CS", "CT");
    const std::string open = kSequence + kNoLength + kItem + kNoLength + inner + kItemEnd +
                             element(0xFFFEE000, "", inner) + kSequenceEnd;
    EXPECT_EQ(reason(file_of(open)), "");
    EXPECT_EQ(reason(file_of(samples::sequence(0x00081115, {open, inner}))), "");
    EXPECT_THAT(reason(file_of(open.substr(0, open.size() - 8))), HasSubstr("cut short"));
    EXPECT_THAT(reason(file_of(kSequenceEnd)), HasSubstr("not open"));
    EXPECT_THAT(reason(file_of(kSequence + kNoLength + kItemEnd)), HasSubstr("not open"));
    EXPECT_THAT(reason(file_of(kSequence + kNoLength + inner + kSequenceEnd)),
                HasSubstr("where an item"));
}

TEST_F(DicomOutline, ReadsImplicitAndBigEndianElements) {
    const std::string implicit("\x08\0\x60\0\4\0\0\0SEG ", 12);
    EXPECT_EQ(reason(file_of(implicit, "1.2.840.10008.1.2")), "");
    EXPECT_THAT(reason(file_of(implicit.substr(0, 11), "1.2.840.10008.1.2")),
                HasSubstr("cut short"));
    const std::string big(
        "\0\x08\0\x60"
        "CS\0\4SEG ",
        12);
    EXPECT_EQ(reason(file_of(big, "1.2.840.10008.1.2.2")), "");
}

// DCMTK takes four bytes of length behind such a mark, and asks for that much memory.
TEST_F(DicomOutline, RefusesAnUnknownValueRepresentation) {
    const std::string unknown("\x08\0\x3e\x10L\0\0\0\0\0\0\x68", 12);
    EXPECT_THAT(reason(file_of(unknown)), HasSubstr("value representation"));
    EXPECT_THAT(reason(file_of(element(0x00080060, "ZZ", "SEG"))),
                HasSubstr("value representation"));
}

TEST_F(DicomOutline, RefusesNestingThatWouldFillAStack) {
    // In all three forms: with lengths, without, and with neither lengths nor representations.
    std::string closed = element(0x00080060, "CS", "CT"), open, implicit;
    for (int n = 0; n < 40; ++n) closed = samples::sequence(0x00081115, {closed});
    for (int n = 0; n < 100000; ++n) {
        open += kSequence + kNoLength + kItem + kNoLength;
        implicit += kSequence.substr(0, 4) + kNoLength + kItem + kNoLength;
    }
    EXPECT_THAT(reason(file_of(closed)), HasSubstr("nest deeper"));
    EXPECT_THAT(reason(file_of(open)), HasSubstr("nest deeper"));
    EXPECT_THAT(reason(file_of(implicit, "1.2.840.10008.1.2")), HasSubstr("nest deeper"));
}

TEST_F(DicomOutline, RefusesWhatIsNoUncompressedDicom) {
    EXPECT_THAT(reason("DICM"), HasSubstr("mark 'DICM'"));
    EXPECT_THAT(reason(file_of("", "1.2.840.10008.1.2.4.50")), HasSubstr("1.2.840.10008.1.2.4.50"));
    EXPECT_THAT(reason(std::string(128, '\0') + "DICM"), HasSubstr("transfer syntax ''"));
    const std::string packed("\xe0\x7f\x10\0OB\0\0\xff\xff\xff\xff", 12);
    EXPECT_THAT(reason(file_of(packed)), HasSubstr("pixels are compressed"));
}

}  // namespace
}  // namespace myotet::segmentation
