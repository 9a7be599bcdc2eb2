// SPDX-License-Identifier: Apache-2.0
#include "Report/Html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Support/Markup.h"
#include "Support/TemporaryFolder.h"

namespace myotet::report {
namespace {

using ::testing::HasSubstr;

TEST(Escaped, MarkupAndQuotesBecomeEntities) {
    EXPECT_EQ(escaped("<b>\"5' & up\"</b>"), "&lt;b&gt;&quot;5&#39; &amp; up&quot;&lt;/b&gt;");
    EXPECT_EQ(escaped("M. bíceps\n\t肌"), "M. bíceps\n\t肌");
}

TEST(Escaped, WhatIsNoTextIsReplaced) {
    const std::string unknown = "\xEF\xBF\xBD";
    EXPECT_EQ(escaped(std::string("a\0b\x1B", 4)), "a" + unknown + "b" + unknown);
    EXPECT_EQ(escaped("\xFF"), unknown);
    EXPECT_EQ(escaped("\xC0\xAF"), unknown + unknown) << "longer than needed";
    EXPECT_EQ(escaped("\xED\xA0\x80"), unknown + unknown + unknown) << "half a character";
    EXPECT_EQ(escaped("\xE2\x82"), unknown + unknown) << "cut off";
}

TEST(JsonText, IsATextOfJsonThatMayStandInAScript) {
    EXPECT_EQ(json_text("a \"b\" \\ c"), "\"a \\\"b\\\" \\\\ c\"");
    EXPECT_EQ(json_text("</script>\n"), "\"\\u003c/script>\\u000a\"");
    EXPECT_EQ(json_text("bíceps 肌"), "\"bíceps 肌\"");
    EXPECT_EQ(json_text("\xFF"), "\"\xEF\xBF\xBD\"");
}

TEST(Base64, AsTheStandardsOwnExamples) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

TEST(Png, InMemoryAsInAFile) {
    Picture picture = blank(31, 17, {0.2, 0.4, 0.6});
    set_pixel(picture, 3, 4, kBlack);
    const myotet::testing::TemporaryFolder folder;
    write_png(picture, folder / "a.png");
    EXPECT_EQ(encode_png(picture), myotet::testing::read_bytes(folder / "a.png"));
}

TEST(Number, HasItsWholeValueAndIsReadable) {
    EXPECT_EQ(number_html(27.513551477924977), "<data value=\"27.513551477924977\">27.51</data>");
    EXPECT_THAT(number_html(1234567), HasSubstr("1\xE2\x80\xAF"
                                                "234\xE2\x80\xAF"
                                                "567<"));
    EXPECT_THAT(number_html(-12345.6), HasSubstr(">-12\xE2\x80\xAF"
                                                 "346<"));
    EXPECT_THAT(number_html(0.0123456), HasSubstr(">0.0123<"));
    EXPECT_EQ(number_html(NAN), "\xE2\x80\x93");
}

TEST(Table, IsWellFormedAndEscaped) {
    const HtmlTable table{.caption = "a <caption>",
                          .columns = {"x & y", "n", "rule"},
                          .rows = {{text_cell("<i>"), number_cell(3), kept_cell(true)},
                                   {text_cell("\"q\""), number_cell(NAN), kept_cell(false)}}};
    const std::string html = to_html(table);
    EXPECT_EQ(myotet::testing::markup_mistake(html), "");
    EXPECT_THAT(html, HasSubstr("x &amp; y"));
    EXPECT_THAT(html, HasSubstr("<th scope=\"row\">&lt;i&gt;</th>"));
    EXPECT_THAT(html, HasSubstr("kept"));
    EXPECT_THAT(html, HasSubstr("broken"));
}

}  // namespace
}  // namespace myotet::report
