// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/InspectRuns.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "Core/Components.h"

namespace myotet::segmentation {
namespace {

LabelVolume random_volume(const Index3& size, int labels, unsigned seed) {
    LabelVolume volume;
    volume.size = size;
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> label(0, labels);
    volume.values.resize(static_cast<std::size_t>(size[0]) * size[1] * size[2]);
    for (auto& v : volume.values) v = 10 * label(random);
    return volume;
}

TEST(InspectRuns, FindsTheComponentsThatASearchLabelByLabelFinds) {
    for (const Index3& size : {Index3{9, 8, 7}, Index3{1, 13, 5}, Index3{17, 1, 1}}) {
        const LabelVolume volume = random_volume(size, 2, 5);
        const RunMap map = map_runs(volume);
        std::multiset<std::pair<std::int32_t, std::int64_t>> found, expected;
        for (const RunComponent& c : map.components) found.emplace(c.value, c.voxels);
        for (const std::int32_t value : {0, 10, 20})
            for (const ComponentBox& c :
                 label_components(volume, value, {0, 0, 0}, {size[0] - 1, size[1] - 1, size[2] - 1})
                     .components)
                expected.emplace(value, c.voxels);
        EXPECT_EQ(found, expected);
    }
}

TEST(InspectRuns, CountsEveryFaceBetweenTwoComponents) {
    const LabelVolume volume = random_volume({9, 8, 7}, 3, 6);
    const RunMap map = map_runs(volume);
    std::vector<std::int32_t> component(volume.values.size());
    for (std::size_t row = 0; row + 1 < map.row_start.size(); ++row)
        for (std::int32_t r = map.row_start[row]; r < map.row_start[row + 1]; ++r)
            for (int i = map.runs[r].first; i <= map.runs[r].last; ++i)
                component[row * volume.size[0] + i] = map.runs[r].component;
    std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::int64_t, 3>> expected;
    const auto count = [&](std::size_t here, std::size_t there, int axis) {
        const auto [a, b] = std::minmax(component[here], component[there]);
        if (a != b) ++expected[{a, b}][axis];
    };
    for (int k = 0; k < 7; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 9; ++i) {
                if (i > 0) count(volume.offset(i, j, k), volume.offset(i - 1, j, k), 0);
                if (j > 0) count(volume.offset(i, j, k), volume.offset(i, j - 1, k), 1);
                if (k > 0) count(volume.offset(i, j, k), volume.offset(i, j, k - 1), 2);
            }
    ASSERT_EQ(map.contacts.size(), expected.size());
    auto next = expected.begin();
    for (const RunContact& c : map.contacts) {
        EXPECT_EQ(std::pair(c.a, c.b), next->first);
        EXPECT_EQ(c.faces, next->second);
        ++next;
    }
}

}  // namespace
}  // namespace myotet::segmentation
