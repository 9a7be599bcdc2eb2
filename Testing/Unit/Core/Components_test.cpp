// SPDX-License-Identifier: Apache-2.0
#include "Core/Components.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "Core/Errors.h"

namespace myotet {
namespace {

LabelVolume make_volume(const Index3& size) {
    LabelVolume volume;
    volume.size = size;
    volume.values.assign(static_cast<std::size_t>(size[0]) * size[1] * size[2], 0);
    return volume;
}

Components of_whole(const LabelVolume& volume, std::int32_t label) {
    return label_components(volume, label, {0, 0, 0},
                            {volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1});
}

/// The plainest flood fill, as a second opinion.
std::vector<std::int32_t> flood(const LabelVolume& volume, std::int32_t label,
                                std::vector<std::int64_t>& sizes) {
    std::vector<std::int32_t> number(volume.values.size(), -1);
    const auto& s = volume.size;
    for (std::size_t seed = 0; seed < number.size(); ++seed) {
        if (volume.values[seed] != label || number[seed] >= 0) continue;
        const auto n = static_cast<std::int32_t>(sizes.size());
        sizes.push_back(0);
        std::vector<std::size_t> stack{seed};
        number[seed] = n;
        while (!stack.empty()) {
            const std::size_t at = stack.back();
            stack.pop_back();
            ++sizes[n];
            const int i = at % s[0], j = at / s[0] % s[1], k = at / s[0] / s[1];
            const int next[6][3] = {{i - 1, j, k}, {i + 1, j, k}, {i, j - 1, k},
                                    {i, j + 1, k}, {i, j, k - 1}, {i, j, k + 1}};
            for (const auto& p : next) {
                if (p[0] < 0 || p[1] < 0 || p[2] < 0 || p[0] >= s[0] || p[1] >= s[1] ||
                    p[2] >= s[2])
                    continue;
                const std::size_t to = volume.offset(p[0], p[1], p[2]);
                if (volume.values[to] != label || number[to] >= 0) continue;
                number[to] = n;
                stack.push_back(to);
            }
        }
    }
    return number;
}

TEST(Components, AgreeWithAFloodFillOnRandomVoxels) {
    std::mt19937 random(7);
    for (const double density : {0.15, 0.3117, 0.5, 0.85}) {  // below, at and above percolation
        LabelVolume volume = make_volume({17, 13, 11});
        std::bernoulli_distribution filled(density);
        for (auto& v : volume.values) v = filled(random) ? 4 : 9;
        const Components found = of_whole(volume, 4);
        std::vector<std::int64_t> sizes;
        const std::vector<std::int32_t> expected = flood(volume, 4, sizes);
        ASSERT_EQ(found.components.size(), sizes.size());
        // The numbering may differ, the partition may not.
        std::vector<std::int32_t> match(sizes.size(), -1);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            ASSERT_EQ(expected[i] < 0, found.number[i] < 0);
            if (expected[i] < 0) continue;
            if (match[expected[i]] < 0) match[expected[i]] = found.number[i];
            ASSERT_EQ(match[expected[i]], found.number[i]);
        }
        for (std::size_t n = 0; n < sizes.size(); ++n)
            EXPECT_EQ(found.components[match[n]].voxels, sizes[n]);
    }
}

TEST(Components, AreSortedBySizeThenByFirstVoxel) {
    LabelVolume volume = make_volume({9, 1, 1});
    volume.values = {3, 0, 3, 3, 0, 3, 3, 0, 3};
    const Components found = of_whole(volume, 3);
    ASSERT_EQ(found.components.size(), 4u);
    EXPECT_EQ(found.number, (std::vector<std::int32_t>{2, -1, 0, 0, -1, 1, 1, -1, 3}));
    EXPECT_EQ(found.components[1].min, (Index3{5, 0, 0}));
    EXPECT_EQ(found.components[1].max, (Index3{6, 0, 0}));
    EXPECT_EQ(found.components[1].voxels, 2);
}

TEST(Components, AreNotJoinedByEdgesOrCorners) {
    LabelVolume volume = make_volume({2, 2, 2});
    volume.values = {1, 0, 0, 1, 0, 1, 1, 0};
    EXPECT_EQ(of_whole(volume, 1).components.size(), 4u);
}

TEST(Components, OfAUJoinOnlyInsideTheBox) {
    LabelVolume volume = make_volume({3, 3, 1});
    volume.values = {5, 0, 5,  //
                     5, 0, 5,  //
                     5, 5, 5};
    EXPECT_EQ(of_whole(volume, 5).components.size(), 1u);
    const Components cut = label_components(volume, 5, {0, 0, 0}, {2, 1, 0});
    ASSERT_EQ(cut.components.size(), 2u);
    EXPECT_EQ(cut.components[1].min, (Index3{2, 0, 0}));
    EXPECT_EQ(cut.size, (Index3{3, 2, 1}));
}

TEST(Components, BoxesAreInTheVolumesIndices) {
    LabelVolume volume = make_volume({6, 5, 4});
    volume.values[volume.offset(3, 2, 1)] = 8;
    volume.values[volume.offset(3, 3, 1)] = 8;
    const Components found = label_components(volume, 8, {2, 1, 1}, {4, 4, 3});
    ASSERT_EQ(found.components.size(), 1u);
    EXPECT_EQ(found.origin, (Index3{2, 1, 1}));
    EXPECT_EQ(found.components[0].min, (Index3{3, 2, 1}));
    EXPECT_EQ(found.components[0].max, (Index3{3, 3, 1}));
    EXPECT_EQ(found.number[(0 * 4 + 1) * 3 + 1], 0);
}

TEST(Components, OfAnAbsentLabelAreNone) {
    EXPECT_TRUE(of_whole(make_volume({2, 2, 2}), 1).components.empty());
}

TEST(Components, RefuseABoxOutsideTheVolume) {
    const LabelVolume volume = make_volume({2, 2, 2});
    EXPECT_THROW((void)label_components(volume, 1, {0, 0, 0}, {2, 1, 1}), InputError);
    EXPECT_THROW((void)label_components(volume, 1, {1, 0, 0}, {0, 1, 1}), InputError);
    EXPECT_THROW((void)label_components(volume, 1, {-1, 0, 0}, {0, 1, 1}), InputError);
}

}  // namespace
}  // namespace myotet
