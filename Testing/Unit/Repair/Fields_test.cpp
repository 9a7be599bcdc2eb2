// SPDX-License-Identifier: Apache-2.0
#include "Repair/Fields.h"

#include <gmock/gmock.h>

#include "Core/Errors.h"

namespace myotet::repair {
namespace {

using ::testing::HasSubstr;

TEST(Fields, nearest_word_needs_half_the_letters) {
    const std::vector<std::string> words{"biceps", "triceps", "radius"};
    EXPECT_EQ(nearest_word("bicesp", words), "biceps");
    EXPECT_EQ(nearest_word("triceps_", words), "triceps");
    EXPECT_EQ(nearest_word("raduis", words), "radius");
    EXPECT_EQ(nearest_word("xyz", words), "");
    EXPECT_EQ(nearest_word("", words), "");
}

TEST(Fields, remedies_list_what_is_known_when_nothing_is_near) {
    EXPECT_THAT(remedy_for("bicesp", {"biceps"}), HasSubstr("did you mean 'biceps'?"));
    EXPECT_THAT(remedy_for("q", {"humerus", "scapula"}), HasSubstr("humerus, scapula"));
}

YamlTree number(const std::string& text) {
    YamlTree tree;
    tree.kind = YamlTree::Kind::scalar;
    tree.text = text;
    return tree;
}

TEST(Fields, numbers_are_whole_words_within_their_range) {
    YamlTree map;
    map.kind = YamlTree::Kind::map;
    for (const char* bad : {"", "1 mm", "nan", "inf", "0x10", "1,5", "-1", "0"}) {
        map.entries = {{"radius", number(bad)}};
        EXPECT_THROW((void)Fields(map, "here").number("radius", kLength), InputError) << bad;
    }
    for (const char* good : {"1", "1.5", "1e-3", "10000"}) {
        map.entries = {{"radius", number(good)}};
        EXPECT_GT(Fields(map, "here").number("radius", kLength), 0) << good;
    }
}

TEST(Fields, what_nobody_asked_for_is_refused) {
    YamlTree map;
    map.kind = YamlTree::Kind::map;
    map.entries = {{"radius", number("1")}, {"colour", number("2")}};
    Fields fields(map, "here");
    EXPECT_EQ(fields.number("radius", kLength), 1);
    EXPECT_THROW(fields.finish(), InputError);
    EXPECT_TRUE(fields.has("colour"));
    EXPECT_NO_THROW(fields.finish());
}

}  // namespace
}  // namespace myotet::repair
