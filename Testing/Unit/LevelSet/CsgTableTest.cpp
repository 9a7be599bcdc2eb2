// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "CsgShapes.h"
#include "LevelSet/CsgMeasure.h"
#include "LevelSet/CsgTable.h"

namespace myotet::levelset {
namespace {

TEST(CsgTable, block_offset_counts_blocks) {
    const Band a = test::ball(Vec3(0, 0, 0), 5);
    Band b = a;
    b.origin += Vec3(16, -8, 24);
    EXPECT_EQ(block_offset(a, b), (Index3{2, -1, 3}));
}

TEST(CsgTable, bands_off_the_lattice_are_our_mistake) {
    const Band a = test::ball(Vec3(0, 0, 0), 5);
    Band b = a;
    b.origin.x() += 0.5;
    EXPECT_THROW((void)block_offset(a, b), LogicError);
}

TEST(CsgTable, framing_keeps_the_samples) {
    const Band a = test::ball(Vec3(0, 0, 0), 12);
    const Band wide = framed(a, 3);
    EXPECT_EQ(wide.values, a.values);
    EXPECT_EQ(volume_beyond(a, wide), 0);
    EXPECT_EQ(volume_beyond(wide, a), 0);
    for (const Index3& p : wide.position)
        for (int i = 0; i < 3; ++i) {
            EXPECT_GE(p[i], 3);
            EXPECT_LT(p[i], wide.blocks[i] - 3);
        }
}

TEST(CsgTable, a_crop_holds_the_same_samples_where_it_reaches) {
    const Band a = test::ball(Vec3(0, 0, 0), 20);
    const Box box{Vec3(10, -5, -5), Vec3(30, 5, 5)};
    const Band part = cropped(a, box);
    EXPECT_LT(part.values.size(), a.values.size() / 2);
    for (double x = 10; x < 29; x += 0.7)
        for (double y = -5; y < 4; y += 0.7)
            EXPECT_NEAR(sample(part, Vec3(x, y, 0.4)).value, sample(a, Vec3(x, y, 0.4)).value,
                        1e-6);  // another origin rounds otherwise
}

}  // namespace
}  // namespace myotet::levelset
