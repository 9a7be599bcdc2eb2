// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/CleanName.h"

#include <gtest/gtest.h>

namespace myotet::segmentation {
namespace {

TEST(CleanName, KeepsUtf8) {
    for (const char* name : {"", "biceps", "M\xc3\xbcller", "\xe4\xba\x8c\xe9\xa0\xad\xe7\xad\x8b",
                             "\xf0\x9f\xa6\xb4"})
        EXPECT_EQ(clean_name(name), name);
}

TEST(CleanName, TakesOtherBytesAsLatin1) {
    EXPECT_EQ(clean_name("M\xfcller"), "M\xc3\xbcller");
    // Overlong, surrogate, past the last code point, unfinished: no UTF-8.
    EXPECT_EQ(clean_name("\xc0\xaf"), "\xc3\x80\xc2\xaf");
    EXPECT_EQ(clean_name("\xed\xa0\x80"), "\xc3\xad\xc2\xa0\xc2\x80");
    EXPECT_EQ(clean_name("\xf4\x90\x80\x80"), "\xc3\xb4\xc2\x90\xc2\x80\xc2\x80");
    EXPECT_EQ(clean_name("a\xc3"), "a\xc3\x83");
}

TEST(CleanName, IsOneLine) {
    EXPECT_EQ(clean_name("  m.\tbiceps\r\nbrachii \x7f"), "m. biceps  brachii");
    EXPECT_EQ(clean_name(" \n "), "");
}

}  // namespace
}  // namespace myotet::segmentation
