// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Xml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::skeleton {
namespace {

using myotet::testing::TemporaryFolder;
using myotet::testing::write_bytes;
using ::testing::HasSubstr;

XmlElement read(const std::string& text) {
    const TemporaryFolder folder;
    write_bytes(folder / "x.xml", text);
    return read_xml(folder / "x.xml");
}

TEST(Xml, ElementsWithTextNameAndLine) {
    const XmlElement root = read(
        "<?xml version=\"1.0\"?>\n<!-- not this -->\n<a name=\"n\">\n  <b>  1 2\t</b>\n"
        "<c name='x'><!-- nor this --><d/></c></a>\n");
    EXPECT_EQ(root.kind, "a");
    EXPECT_EQ(root.name, "n");
    EXPECT_EQ(root.line, 3);
    ASSERT_EQ(root.children.size(), 2u);
    EXPECT_EQ(root.children[0].text, "1 2");
    EXPECT_EQ(root.children[0].line, 4);
    EXPECT_EQ(root.children[1].name, "x");
    EXPECT_EQ(root.children[1].children.at(0).kind, "d");
}

TEST(Xml, EntitiesAndWindowsLinesAreUnderstood) {
    const XmlElement root = read("<a>\r\n<b>x &amp; y</b>\r\n<c/>\r\n</a>");
    EXPECT_EQ(root.children[0].text, "x & y");
    EXPECT_EQ(root.children[1].line, 3);
}

TEST(Xml, WhatIsNoneIsRefusedWithItsLine) {
    try {
        (void)read("<a>\n<b>\n</a>\n");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("x.xml:3: is not valid XML"));
    }
    EXPECT_THROW((void)read_xml("/nowhere/x.xml"), IoError);
}

}  // namespace
}  // namespace myotet::skeleton
