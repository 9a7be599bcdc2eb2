// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/DcmqiTable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Samples.h"
#include "Segmentation/NameTable.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTable = R"({"ContentCreatorName": "Doe^Archibald", "segmentAttributes": [
  [{"labelID": 1, "SegmentLabel": "Liver", "recommendedDisplayRGBValue": [255, 0, 51]},
   {"labelID": 7, "SegmentDescription": "of Mr Doe",
    "SegmentedPropertyTypeCodeSequence": {"CodeMeaning": "Kidney"},
    "SegmentedPropertyTypeModifierCodeSequence": {"CodeMeaning": "Left"}}],
  [{"labelID": 3, "SegmentLabel": "Spleen", "recommendedDisplayRGBValue": [1, 2]},
   {"labelID": 4}]]})";

TEST(DcmqiTable, GivesLabelsOrTheMeaningOfCodes) {
    const auto entries = parse_dcmqi_table(kTable, "table.json");
    ASSERT_EQ(entries.size(), 4u);
    EXPECT_EQ(entries[0].first, 1);
    EXPECT_EQ(entries[0].second.name, "Liver");
    EXPECT_EQ(entries[0].second.colour, (std::array<double, 3>{1, 0, 0.2}));
    EXPECT_EQ(entries[1].second.name, "Kidney Left");
    EXPECT_EQ(entries[2].second.name, "Spleen");
    EXPECT_FALSE(entries[2].second.colour);
    EXPECT_EQ(entries[3].second.name, "");
}

TEST(DcmqiTable, IsToldFromOtherTablesByItsContent) {
    const myotet::testing::TemporaryFolder folder;
    const auto names = read_name_table(samples::write_bytes(folder.path() / "any.txt", kTable));
    EXPECT_EQ(names.size(), 3u);  // label 4 has no name
    EXPECT_EQ(names.at(7).name, "Kidney Left");
}

TEST(DcmqiTable, IsFoundBesideAFileButNotTakenForAnyJson) {
    const myotet::testing::TemporaryFolder folder;
    const auto file = folder.path() / "scan.mha";
    write_labels(samples::make_volume(), file);
    samples::write_bytes(folder.path() / "scan.json", R"({"Manual": true})");
    EXPECT_TRUE(read_labels(file).warnings.empty());
    samples::write_bytes(folder.path() / "scan.json", kTable);
    EXPECT_EQ(read_labels(file).layers.front().name_of(1), "Liver");
}

TEST(DcmqiTable, RefusesWhatMakesNoSense) {
    const auto reason = [](const std::string& text) -> std::string {
        try {
            (void)parse_dcmqi_table(text, "table.json");
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(reason("{"), HasSubstr("table.json: is no valid JSON"));
    EXPECT_THAT(reason("[]"), HasSubstr("no list segmentAttributes"));
    EXPECT_THAT(reason(R"({"segmentAttributes": {}})"), HasSubstr("no list segmentAttributes"));
    EXPECT_THAT(reason(R"({"segmentAttributes": [{}]})"), HasSubstr("something else than lists"));
    EXPECT_THAT(reason(R"({"segmentAttributes": [[1]]})"), HasSubstr("no object"));
    EXPECT_THAT(reason(R"({"segmentAttributes": [[{"labelID": 1.5}]]})"), HasSubstr("labelID"));
    EXPECT_THAT(reason(R"({"segmentAttributes": [[{"labelID": -1}]]})"), HasSubstr("from 0"));
    EXPECT_THAT(reason(R"({"segmentAttributes": [[{"labelID": 2147483648}]]})"),
                HasSubstr("from 0"));
}

}  // namespace
}  // namespace myotet::segmentation
