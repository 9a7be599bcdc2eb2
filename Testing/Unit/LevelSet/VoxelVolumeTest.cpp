// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "LabelShapes.h"
#include "LevelSet/LabelGrid.h"
#include "LevelSet/VoxelVolume.h"

namespace myotet::levelset {
namespace {

TEST(VoxelVolume, voxels_fill_cells_exactly) {
    // A plate thinner than the bands: every voxel lies in a stored block.
    const auto volume = test::make_volume({20, 20, 8}, {0.7, 0.7, 2}, [](int i, int j, int k) {
        return i > 3 && i < 16 && j > 2 && j < 17 && k == 3 ? 1 : 0;
    });
    const RegionMap map = map_regions(volume, std::vector<std::int32_t>{1});
    LabelOptions options;
    options.spacing = 0.9;
    const LabelGrid grid = lay_grid(volume, shared_walls(map, face_area(volume)), options);
    const auto claims = claim_samples(map, grid.lattice);
    const VoxelScene scene{map, grid.lattice, claims, {}, 3};
    const RegionBand plate = voxel_band(scene, 1), rest = voxel_band(scene, 0);
    double sum = 0;
    const double cell = std::pow(kVolumeStep * 0.9, 3);
    for (const auto& cells : voxel_volumes(scene, 1, plate))
        for (const float v : cells) {
            EXPECT_GE(v, 0);
            EXPECT_LE(v, cell * 1.0001);
            sum += v;
        }
    EXPECT_NEAR(sum, 12 * 14 * volume.voxel_volume(), 1e-3);
    double outside = 0;
    const CellVolumes background = voxel_volumes(scene, 0, rest);
    for (const auto& cells : background)
        for (const float v : cells) outside += v;
    EXPECT_NEAR(outside, background.size() * 8 * cell - sum, 1e-2);
}

}  // namespace
}  // namespace myotet::levelset
