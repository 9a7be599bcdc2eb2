// SPDX-License-Identifier: Apache-2.0
#include "Core/Text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet {
namespace {

TEST(Text, NumbersReadBackTheSame) {
    for (const double number : {0.0, -1.5, 0.1, 1e-300, 1.7976931348623157e308, M_PI})
        EXPECT_EQ(to_number(shown(number)), number) << shown(number);
    EXPECT_TRUE(std::isnan(to_number(shown(NAN)).value()));
    EXPECT_EQ(to_number("+2.5"), 2.5);
    for (const char* no : {"", "2,5", "2.5 mm", "0x10", "two"}) EXPECT_FALSE(to_number(no)) << no;
}

TEST(Text, FormattedIsAsLongAsItTakes) {
    EXPECT_EQ(formatted("%d of %.2f %s", 3, 0.125, "mm"), "3 of 0.12 mm");
    EXPECT_EQ(formatted("%%"), "%");
    const std::string name(1000, 'n');
    EXPECT_EQ(formatted("<%s>", name.c_str()), "<" + name + ">");
}

TEST(Text, TrimmedAndLower) {
    EXPECT_EQ(trimmed(" \ta b\r\n"), "a b");
    EXPECT_EQ(trimmed(" \t "), "");
    EXPECT_EQ(lower("Biceps Brachii \xC3\x84"), "biceps brachii \xC3\x84");
}

TEST(Text, LongListsAreCutShort) {
    EXPECT_EQ(list_of({}), "");
    EXPECT_EQ(list_of({"a", "b"}), "a, b");
    const std::string list = list_of(std::vector<std::string>(57, "x"));
    EXPECT_TRUE(list.ends_with("x and 17 more")) << list;
}

TEST(Text, WhatCannotBeReadIsNamed) {
    const myotet::testing::TemporaryFolder folder;
    try {
        (void)read_whole(folder.path() / "none.txt");
        FAIL();
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("none.txt"), std::string::npos);
    }
    EXPECT_THROW((void)read_whole(folder.path()), IoError);
}

}  // namespace
}  // namespace myotet
