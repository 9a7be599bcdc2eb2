// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "Core/Components.h"
#include "Core/Errors.h"
#include "LabelShapes.h"
#include "LevelSet/Gaps.h"

namespace myotet::levelset {
namespace {

// Two blocks of 8 x 12 x 12 voxels with `slit` empty layers between them.
LabelVolume two_blocks(int slit, const Vec3& spacing = Vec3::Ones()) {
    return test::make_volume({30, 20, 20}, spacing, [&](int i, int j, int k) {
        if (j < 4 || j > 15 || k < 4 || k > 15 || i < 4 || i >= 20 + slit) return 0;
        return i < 12 ? 5 : i >= 12 + slit ? 9 : 0;
    });
}

std::int64_t count(const LabelVolume& volume, int label) {
    return std::count(volume.values.begin(), volume.values.end(), label);
}

TEST(Gaps, slit_between_two_blocks_is_measured_and_closed_in_half) {
    LabelVolume volume = two_blocks(2, {0.5, 1, 2});
    // Two layers of half a millimetre.
    EXPECT_EQ(find_gaps(volume, 0.9).narrow_voxels, 0);
    const GapReport found = find_gaps(volume, 1);
    EXPECT_EQ(found.narrow_voxels, 2 * 12 * 12);
    EXPECT_NEAR(found.narrow_volume, 2 * 12 * 12 * 1.0, 1e-9);
    EXPECT_EQ(found.pockets, 0);
    EXPECT_TRUE(found.gained.empty());
    const GapReport closed = close_gaps(volume, 1);
    EXPECT_EQ(closed.gained, (std::map<std::int32_t, std::int64_t>{{5, 144}, {9, 144}}));
    EXPECT_EQ(count(volume, 5), 9 * 144);
    EXPECT_EQ(count(volume, 9), 9 * 144);
    EXPECT_EQ(find_gaps(volume, 1).narrow_voxels, 0);
}

TEST(Gaps, middle_layer_of_a_tie_goes_to_the_smaller_label) {
    LabelVolume volume = two_blocks(3);
    const GapReport closed = close_gaps(volume, 3);
    EXPECT_EQ(closed.gained.at(5), 2 * 144);
    EXPECT_EQ(closed.gained.at(9), 144);
}

TEST(Gaps, outside_and_hollows_of_one_tissue_stay) {
    // A block with a groove two voxels wide, open to the outside.
    LabelVolume volume = test::make_volume({20, 20, 20}, {1, 1, 1}, [](int i, int j, int k) {
        if (i < 4 || j < 4 || k < 4 || i > 15 || j > 15 || k > 15) return 0;
        return (i == 9 || i == 10) && j > 9 ? 0 : 3;
    });
    const LabelVolume before = volume;
    EXPECT_EQ(close_gaps(volume, 5).narrow_voxels, 0);
    EXPECT_EQ(volume.values, before.values);
    // Two blocks side by side on one plane: the outside above their seam stays.
    LabelVolume touching = two_blocks(0);
    EXPECT_EQ(close_gaps(touching, 5).narrow_voxels, 0);
}

TEST(Gaps, pockets_between_tissues_close_and_cavities_do_not) {
    LabelVolume volume = test::make_volume({24, 24, 24}, {1, 1, 1}, [](int i, int j, int k) {
        if (i < 2 || j < 2 || k < 2 || i > 21 || j > 21 || k > 21) return 0;
        const bool pocket = i >= 11 && i <= 12 && j >= 8 && j <= 10 && k >= 8 && k <= 9;
        const bool wide = i >= 9 && i <= 14 && j >= 14 && j <= 19 && k >= 12 && k <= 17;
        const bool cavity = i == 5 && j == 5 && k == 5;
        return pocket || wide || cavity ? 0 : i < 12 ? 1 : 2;
    });
    const GapReport found = find_gaps(volume, 0);
    EXPECT_EQ(found.pockets, 2);
    EXPECT_EQ(found.pocket_voxels, 2 * 3 * 2 + 6 * 6 * 6);
    EXPECT_EQ(found.cavities, 1);
    EXPECT_EQ(found.cavity_voxels, 1);
    EXPECT_EQ(found.narrow_voxels, 0);
    const GapReport closed = close_gaps(volume, 2);
    EXPECT_EQ(closed.gained.at(1) + closed.gained.at(2), closed.narrow_voxels);
    const GapReport after = find_gaps(volume, 2);
    EXPECT_EQ(after.pockets, 1);
    EXPECT_EQ(after.cavities, 1);
    EXPECT_GE(closed.narrow_voxels, 12);
    EXPECT_EQ(volume.values[volume.offset(5, 5, 5)], 0);
    EXPECT_EQ(volume.values[volume.offset(11, 9, 8)], 1);
    EXPECT_EQ(volume.values[volume.offset(12, 9, 8)], 2);
    EXPECT_EQ(volume.values[volume.offset(11, 16, 14)], 0);
}

TEST(Gaps, slanted_slit_closes_along_its_whole_length) {
    // Two halves of a ball parted by a slit of 1.5 mm across (1, 1, 1).
    const Vec3 normal = Vec3(1, 1, 1).normalized(), centre(15, 15, 15);
    LabelVolume volume = test::sample_volume({31, 31, 31}, {1, 1, 1}, [&](const Vec3& p) {
        const double side = (p - centre).dot(normal);
        if ((p - centre).norm() > 12 || std::abs(side) < 0.75) return 0;
        return side < 0 ? 1 : 2;
    });
    (void)close_gaps(volume, 3);
    for (int k = 0; k < 31; ++k)
        for (int j = 0; j < 31; ++j)
            for (int i = 0; i < 31; ++i)
                if ((Vec3(i, j, k) - centre).norm() < 10) {
                    EXPECT_NE(volume.values[volume.offset(i, j, k)], 0)
                        << i << " " << j << " " << k;
                }
    for (const int label : {1, 2})
        EXPECT_EQ(label_components(volume, label, {0, 0, 0}, {30, 30, 30}).components.size(), 1u);
}

TEST(Gaps, closing_leaves_no_loose_pieces_in_thick_slices) {
    const auto shape = [](const Vec3& p) {
        const double r = (p - Vec3(12, 12, 20)).norm();
        if (r > 10 || std::abs(p.x() - 12 - 0.3 * (p.z() - 20)) < 0.7) return 0;
        return p.x() < 12 + 0.3 * (p.z() - 20) ? 1 : 2;
    };
    LabelVolume volume = test::sample_volume({30, 30, 10}, {0.8, 0.8, 4}, shape);
    const auto parts = [&](int label) {
        return label_components(volume, label, {0, 0, 0}, {29, 29, 9}).components.size();
    };
    const auto before = parts(1) + parts(2);
    EXPECT_GT(close_gaps(volume, 2).narrow_voxels, 50);
    EXPECT_LE(parts(1) + parts(2), before);
}

TEST(Gaps, bad_widths_are_refused) {
    LabelVolume volume = two_blocks(1);
    EXPECT_THROW((void)find_gaps(volume, -1), InputError);
    EXPECT_THROW((void)close_gaps(volume, std::nan("")), InputError);
}

}  // namespace
}  // namespace myotet::levelset
