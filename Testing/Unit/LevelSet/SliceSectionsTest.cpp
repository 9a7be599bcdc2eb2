// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LabelShapes.h"
#include "LevelSet/SliceSections.h"

namespace myotet::levelset {
namespace {

// A trunk of 6 x 6 pixels that parts into two branches above slice 3.
LabelVolume forked(int axis) {
    Index3 size;
    size[axis] = 8;
    size[(axis + 1) % 3] = 20;
    size[(axis + 2) % 3] = 14;
    return test::make_volume(size, {1, 1, 1}, [axis](int i, int j, int k) {
        const Index3 v{i, j, k};
        const int x = v[(axis + 1) % 3], y = v[(axis + 2) % 3], slice = v[axis];
        if (slice < 1 || slice > 6 || y < 4 || y > 9) return 0;
        if (slice <= 3) return x >= 7 && x <= 12 ? 1 : 0;
        return (x >= 5 && x <= 8) || (x >= 11 && x <= 14) ? 1 : 0;
    });
}

TEST(SliceSections, a_fork_has_its_sections_and_links_across_any_axis) {
    for (const int axis : {0, 1, 2}) {
        const RegionMap map = map_regions(forked(axis), std::vector<std::int32_t>{1});
        const SliceSections s = find_sections(map, 1, axis);
        ASSERT_EQ(s.sections.size(), 9u);
        EXPECT_EQ(s.sections[0].slice, 1);
        EXPECT_EQ(s.sections[0].area, 36);
        EXPECT_NEAR(s.sections[0].centre[0], 9.5, 1e-12);
        // Of six pixels in a row: (6^2 - 1) / 12.
        EXPECT_NEAR(s.sections[0].spread[0], 35.0 / 12, 1e-12);
        EXPECT_NEAR(s.sections[0].spread[1], 0, 1e-12);
        EXPECT_THAT(s.sections[0].below, testing::IsEmpty());
        EXPECT_THAT(s.sections[2].above, testing::ElementsAre(3, 4));
        EXPECT_THAT(s.sections[4].below, testing::ElementsAre(2));
        EXPECT_THAT(s.sections[8].above, testing::IsEmpty());
        EXPECT_EQ(s.at(11, 5, 4), 4);
        EXPECT_EQ(s.at(10, 5, 4), -1);
        EXPECT_EQ(s.at(-3, 5, 4), -1);
    }
}

TEST(SliceSections, masks_hold_what_is_asked_for_and_a_margin) {
    const RegionMap map = map_regions(forked(2), std::vector<std::int32_t>{1});
    const SliceSections s = find_sections(map, 1, 2);
    const SliceMask mask = s.mask_of(std::vector<int>{4}, 2);
    EXPECT_EQ(mask.first, (std::array<int, 2>{9, 2}));
    EXPECT_EQ(mask.size, (std::array<int, 2>{8, 10}));
    EXPECT_EQ(std::count(mask.inside.begin(), mask.inside.end(), 1), 24);
    EXPECT_EQ(mask.inside[mask.offset(11, 4)], 1);
    EXPECT_EQ(mask.inside[mask.offset(10, 4)], 0);
}

TEST(SliceSections, shared_pixels_follow_the_shift) {
    const RegionMap map = map_regions(forked(2), std::vector<std::int32_t>{1});
    const SliceSections s = find_sections(map, 1, 2);
    const std::vector<int> trunk{2}, left{3}, both{3, 4};
    EXPECT_EQ(shared_pixels(s, trunk, both, {0, 0}), 24);
    EXPECT_EQ(shared_pixels(s, trunk, left, {0, 0}), 12);
    EXPECT_EQ(shared_pixels(s, trunk, left, {-2, 0}), 24);
    EXPECT_EQ(shared_pixels(s, trunk, left, {0, 6}), 0);
}

}  // namespace
}  // namespace myotet::levelset
