// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "LabelShapes.h"
#include "LevelSet/Necks.h"

namespace myotet::levelset {
namespace {

// Two blocks joined by a bar of one voxel, `length` long.
RegionMap dumbbell(int length) {
    const auto volume =
        test::make_volume({16 + length, 10, 10}, {1, 1, 1}, [=](int i, int j, int k) {
            const bool block = j > 1 && j < 8 && k > 1 && k < 8 && i > 0 && i < 15 + length &&
                               (i < 8 || i >= 8 + length);
            return block || (j == 4 && k == 4 && i > 0 && i < 15 + length) ? 1 : 0;
        });
    return map_regions(volume, std::vector<std::int32_t>{1});
}

TEST(Necks, bar_too_short_to_be_a_tube_is_kept) {
    for (const int length : {1, 2, 3}) {
        const RegionMap map = dumbbell(length);
        ASSERT_EQ(map.regions.size(), 1u);
        for (int i = 8; i < 8 + length; ++i)
            EXPECT_TRUE(map.flags[map.offset(i, 4, 4)] & RegionMap::kThin) << length;
    }
}

TEST(Necks, one_block_has_none) {
    const RegionMap map = dumbbell(0);
    for (const std::uint8_t flags : map.flags) EXPECT_FALSE(flags & RegionMap::kThin);
}

}  // namespace
}  // namespace myotet::levelset
