// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "Segmentation/Formats.h"

namespace myotet::segmentation {
namespace {

TEST(CaretLabels, AreFoundInTheTableOfAnExtension) {
    const auto found = parse_caret_labels(
        "<?xml version=\"1.0\"?><CaretExtension><LabelTable>\n"
        "<Label Key=\"1\" Red=\"0.25\" Green=\"1\" Blue=\"0\" Alpha=\"1\"><![CDATA[left "
        "<hip>]]></Label>\n"
        "<Label Key='0'>background</Label><Label Red=\"1\" Key=\"12\"> a &amp; b </Label>\n"
        "</LabelTable></CaretExtension>");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found.at(1).name, "left <hip>");
    EXPECT_EQ(found.at(1).colour, (std::array<double, 3>{0.25, 1, 0}));
    EXPECT_EQ(found.at(12).name, "a & b");
    EXPECT_FALSE(found.at(12).colour);
}

TEST(CaretLabels, ComeBackFromTheirOwnXml) {
    const std::map<std::int32_t, LabelName> names{
        {3, {"m. <soleus> & 'co' \"x\"", std::array<double, 3>{0.1, 0.2, 0.3}}},
        {2147483647, {"last", {}}}};
    const auto found = parse_caret_labels(format_caret_labels(names));
    ASSERT_EQ(found.size(), 2u);
    for (const auto& [value, label] : names) {
        EXPECT_EQ(found.at(value).name, label.name);
        EXPECT_EQ(found.at(value).colour, label.colour);
    }
}

TEST(CaretLabels, BrokenXmlGivesWhatIsWhole) {
    const std::string whole = format_caret_labels({{3, {"tibia", {}}}, {4, {"fibula", {}}}});
    for (std::size_t length = 0; length <= whole.size(); ++length)
        for (const auto& [value, label] : parse_caret_labels(whole.substr(0, length)))
            EXPECT_EQ(label.name, value == 3 ? "tibia" : "fibula");
    EXPECT_TRUE(parse_caret_labels("<Label Key=\"x\">a</Label><Label Key=\"3\"/>").empty());
}

}  // namespace
}  // namespace myotet::segmentation
