// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "LabelShapes.h"
#include "LevelSet/RegionMap.h"

namespace myotet::levelset {
namespace {

const std::vector<std::int32_t> kOne{1};

std::int64_t count_thin(const RegionMap& map, RegionMap::Owner owner) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < map.owner.size(); ++i)
        count += map.owner[i] == owner && map.flags[i] & RegionMap::kThin;
    return count;
}

TEST(RegionMap, components_come_by_label_then_size) {
    const auto volume = test::make_volume({12, 4, 4}, {1, 1, 1}, [](int i, int, int) {
        return i < 1 ? 7 : i < 3 ? 0 : i < 6 ? 7 : i < 8 ? 0 : i < 10 ? 3 : 5;
    });
    const std::vector<std::int32_t> asked{7, 3, 7};
    const RegionMap map = map_regions(volume, asked);
    ASSERT_EQ(map.regions.size(), 3u);
    EXPECT_EQ(map.regions[0].label, 3);
    EXPECT_EQ(map.regions[1].label, 7);
    EXPECT_EQ(map.regions[1].voxels, 48);
    EXPECT_EQ(map.regions[2].component, 1);
    EXPECT_EQ(map.owner_at(0, 0, 0), 3);
    EXPECT_EQ(map.owner_at(11, 0, 0), 0);  // not asked for
    EXPECT_EQ(map.owner_at(-1, 0, 0), 0);
}

TEST(RegionMap, sheets_tubes_and_specks_are_thin_and_blocks_are_not) {
    const auto thin = [](const std::function<bool(int, int, int)>& inside) {
        const auto volume = test::make_volume(
            {24, 24, 24}, {1, 1, 1}, [&](int i, int j, int k) { return inside(i, j, k) ? 1 : 0; });
        return count_thin(map_regions(volume, kOne), 1);
    };
    const auto within = [](int x, int a, int b) { return x >= a && x < b; };
    EXPECT_EQ(thin([&](int i, int j, int k) { return i == 9 && j == 9 && k == 9; }), 1);
    EXPECT_EQ(thin([&](int i, int j, int k) { return i == 9 && j == 9 && within(k, 4, 20); }), 16);
    EXPECT_EQ(thin([&](int i, int j, int k) {
                  return within(i, 9, 11) && within(j, 4, 20) && within(k, 4, 20);
              }),
              2 * 16 * 16);
    EXPECT_EQ(thin([&](int i, int j, int k) {
                  return within(i, 4, 20) && within(j, 4, 20) && within(k, 9, 12);
              }),
              0);
    // A bump of two voxels on a block is what smoothing is for.
    EXPECT_EQ(thin([&](int i, int j, int k) {
                  return (within(i, 4, 12) && within(j, 4, 12) && within(k, 4, 12)) ||
                         (i == 8 && j == 8 && within(k, 12, 14));
              }),
              0);
    // A fin of six voxels on it is not.
    EXPECT_GT(thin([&](int i, int j, int k) {
                  return (within(i, 4, 12) && within(j, 4, 12) && within(k, 4, 12)) ||
                         (i == 8 && within(j, 4, 12) && within(k, 12, 18));
              }),
              0);
}

TEST(RegionMap, block_cut_by_the_border_is_not_thin) {
    const auto volume =
        test::make_volume({8, 8, 8}, {1, 1, 1}, [](int i, int, int) { return i < 4 ? 1 : 0; });
    const RegionMap map = map_regions(volume, kOne);
    EXPECT_EQ(count_thin(map, 1), 0);
    EXPECT_EQ(count_thin(map, 0), 0);
}

TEST(RegionMap, absent_label_background_and_nothing_are_refused) {
    const auto volume = test::make_volume({4, 4, 4}, {1, 1, 1}, [](int, int, int) { return 1; });
    for (const std::vector<std::int32_t>& asked :
         {std::vector<std::int32_t>{2}, std::vector<std::int32_t>{0}, std::vector<std::int32_t>{}})
        EXPECT_THROW((void)map_regions(volume, asked), InputError);
}

}  // namespace
}  // namespace myotet::levelset
