// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "LabelShapes.h"
#include "LevelSet/LabelGrid.h"
#include "LevelSet/Partition.h"

namespace myotet::levelset {
namespace {

// Label 1 in a corner of label 2 in a corner of the volume.
LabelVolume nested() {
    return test::make_volume({16, 16, 16}, {1, 1, 2}, [](int i, int j, int k) {
        return i < 4 && j < 4 && k < 4 ? 1 : i < 10 && j < 10 && k < 10 ? 2 : 0;
    });
}

TEST(Partition, shared_walls_have_the_area_of_their_faces) {
    const LabelVolume volume = nested();
    const RegionMap map = map_regions(volume, std::vector<std::int32_t>{1, 2});
    const auto walls = shared_walls(map, face_area(volume));
    ASSERT_EQ(walls.size(), 3u);
    // Faces across i and j have area 2, across k area 1; the low sides are open.
    EXPECT_NEAR(walls[0].area, 2 * 4 * 4 * 2 + 4 * 4, 1e-9);  // background - 1
    EXPECT_NEAR(walls[1].area, 2 * 100 * 2 + 100 + 2 * (100 - 16) * 2 + (100 - 16), 1e-9);
    EXPECT_NEAR(walls[2].area, 2 * 4 * 4 * 2 + 4 * 4, 1e-9);  // 1 - 2
}

TEST(Partition, gives_volumes_and_leaves_neither_gap_nor_overlap) {
    const LabelVolume volume = nested();
    const RegionMap map = map_regions(volume, std::vector<std::int32_t>{1, 2});
    const auto walls = shared_walls(map, face_area(volume));
    LabelOptions options;
    options.spacing = 1;
    const LabelGrid grid = lay_grid(volume, walls, options);
    const auto claims = claim_samples(map, grid.lattice);
    std::vector<RegionBand> regions;
    for (int r = 0; r < 3; ++r) {
        regions.push_back(
            voxel_band({map, grid.lattice, claims, {1, 1}, 3}, static_cast<RegionMap::Owner>(r)));
        // Pushed apart: all claim too little.
        for (float& v : regions.back().band.values)
            if (std::abs(v) < regions.back().band.width) v += 0.2f;
    }
    // A tenth more than the voxels for the inner region.
    const std::vector<double> wanted{0, 1.1 * 4 * 4 * 8, 10 * 10 * 20.0 - 4 * 4 * 8};
    SilentProgress silent;
    const auto summary = make_partition(regions, map, grid.lattice, walls, {wanted, {}, 0}, silent);
    EXPECT_LT(summary.largest_error, 1e-3);
    // Two smallest values at every sample: opposite.
    for (int k = 3; k < 40; ++k)
        for (int j = 3; j < 20; ++j)
            for (int i = 3; i < 20; ++i) {
                const Vec3 x = Vec3(i, j, k) + Vec3::Constant(20);
                double first = 3, second = 3;
                for (const RegionBand& r : regions) {
                    const double v = sample(r.band, x).value;
                    second = std::min(second, std::max(first, v));
                    first = std::min(first, v);
                }
                // At the bands' edge values are clamped one by one.
                if (first > -2) {
                    EXPECT_NEAR(first, -second, 1e-5);
                }
            }
}

}  // namespace
}  // namespace myotet::levelset
