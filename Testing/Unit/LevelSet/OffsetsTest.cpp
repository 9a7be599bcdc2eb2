// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "LevelSet/Offsets.h"

namespace myotet::levelset {
namespace {

TEST(Offsets, give_each_region_what_it_misses) {
    // Background 0, a chain 1 - 2 - 3 and a pair 1 - 3.
    const std::vector<SharedWall> walls{{0, 1, 10}, {0, 2, 4}, {1, 2, 6}, {1, 3, 2}, {2, 3, 8}};
    const std::vector<double> missing{0, 3, -1, 0.5};
    const auto c = offsets_for(missing, walls);
    ASSERT_EQ(c.size(), 4u);
    EXPECT_EQ(c[0], 0);
    std::vector<double> gained(4, 0.0);
    for (const SharedWall& w : walls) {
        gained[w.a] += w.area * (c[w.b] - c[w.a]) / 2;
        gained[w.b] += w.area * (c[w.a] - c[w.b]) / 2;
    }
    for (int r = 1; r < 4; ++r) EXPECT_NEAR(gained[r], missing[r], 1e-4);
}

TEST(Offsets, one_region_alone_grows_by_the_volume_over_half_its_area) {
    const auto c = offsets_for(std::vector<double>{0, 5}, std::vector<SharedWall>{{0, 1, 20}});
    EXPECT_NEAR(c[1], -0.5, 1e-6);
}

}  // namespace
}  // namespace myotet::levelset
