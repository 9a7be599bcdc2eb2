// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "LevelSet/SliceMap.h"

namespace myotet::levelset {
namespace {

SliceMask make_mask(int nx, int ny, const std::function<bool(int, int)>& inside) {
    SliceMask mask{.first = {3, -2}, .size = {nx, ny}};
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) mask.inside.push_back(inside(x, y));
    return mask;
}

// Evening out rounds ridges by less than a third of a pixel and hardly moves walls.
constexpr double kWall = 0.01, kRidge = 0.2;

TEST(SliceMap, straight_walls_stay_and_are_told_in_mm) {
    const auto mask =
        make_mask(20, 16, [](int x, int y) { return x > 4 && x < 15 && y > 3 && y < 12; });
    const SliceMap map = slice_distances(mask, {0.5, 2});
    // Walls at 4.5 and 14.5 pixels of half a millimetre, 3.5 and 11.5 of two.
    for (const double x : {3.2, 3.7, 4.5, 5.2})
        EXPECT_NEAR(map.value({3 + x, -2 + 7.5}), 0.5 * (4.5 - x), kWall);
    EXPECT_NEAR(map.value({3 + 9.0, -2 + 3.0}), 1, kRidge);
    EXPECT_NEAR(map.depth, 2.5 - 0.25, kRidge);
    // Beyond the map the way to it is added.
    EXPECT_NEAR(map.value({3 - 4.0, -2 + 7.0}), 0.5 * 4.5 + 0.5 * 4, kRidge);
}

TEST(SliceMap, stairs_of_a_slope_are_evened_out_and_centres_keep_their_side) {
    constexpr double kSlope = 0.22;
    const auto height = [](double x) { return 12 + kSlope * (x - 20); };
    const auto mask =
        make_mask(40, 24, [&](int x, int y) { return y < height(x) && x > 0 && x < 39 && y > 0; });
    const SliceMap map = slice_distances(mask, {1, 1});
    double square = 0;
    int count = 0;
    for (double x = 8; x < 32; x += 0.25, ++count)
        square += std::pow(map.value({3 + x, -2 + height(x)}), 2);
    // A staircase strays by 0.29 of a pixel (rms), as pixels' centres tell it.
    EXPECT_LT(std::sqrt(square / count), 0.15);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 40; ++x)
            EXPECT_EQ(map.value({3.0 + x, -2.0 + y}) < 0, mask.inside[y * 40 + x] != 0);
}

TEST(SliceMap, a_line_one_pixel_wide_keeps_its_width) {
    const auto mask = make_mask(20, 9, [](int x, int y) { return y == 4 && x > 2 && x < 17; });
    const SliceMap map = slice_distances(mask, {1, 1});
    EXPECT_NEAR(map.value({3 + 10.0, -2 + 4.0}), -0.5, 1e-6);
    EXPECT_NEAR(map.value({3 + 10.0, -2 + 4.5}), 0, 0.1);
}

}  // namespace
}  // namespace myotet::levelset
