// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "LabelShapes.h"
#include "LevelSet/Changes.h"
#include "LevelSet/LabelGrid.h"
#include "LevelSet/Partition.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

SilentProgress silent;

// A slab of voxels whose level set is given as one shifted by `shift` mm along z.
RegionChanges changes_of_slab(double shift) {
    const auto volume = test::make_volume({16, 16, 20}, {1, 1, 1},
                                          [](int, int, int k) { return k > 5 && k < 14 ? 1 : 0; });
    const RegionMap map = map_regions(volume, std::vector<std::int32_t>{1});
    LabelOptions options;
    options.spacing = 1;
    const LabelGrid grid = lay_grid(volume, shared_walls(map, face_area(volume)), options);
    const auto claims = claim_samples(map, grid.lattice);
    const VoxelScene scene{map, grid.lattice, claims, {0, 0}, 3};
    RegionBand region = voxel_band(scene, 1);
    LevelSet phi = assemble(region.band);
    phi.origin.z() += shift;
    return measure_changes(map, 1, grid.lattice, phi);
}

TEST(Changes, distances_are_those_from_the_voxels_walls) {
    // The slab's ends are cut flat by the volume's border: only the two wide
    // faces of 256 voxels move, the four narrow ones of 16 x 8 do not but at
    // their rims; the shift is along a lattice axis, so that it is met exactly.
    const double shift = 0.3, bin = 1.0 / MovedAreas::kBinsPerVoxel;
    const RegionChanges still = changes_of_slab(0), moved = changes_of_slab(shift);
    EXPECT_NEAR(still.moved.largest, 0, 1e-5);
    EXPECT_NEAR(still.moved.total, 2 * 16 * 16 + 4 * 16 * 8, 30);  // edges are rounded in a cell
    EXPECT_NEAR(moved.moved.largest, shift, 1e-5);
    EXPECT_NEAR(moved.moved.quantile(0.95), shift, 2 * bin);
    EXPECT_NEAR(moved.moved.mean(), shift / 2, 0.1 * shift);
    EXPECT_EQ(moved.voxels_lost + moved.voxels_gained, 0);
}

TEST(Changes, voxels_whose_centre_changes_sides_are_counted) {
    const RegionChanges moved = changes_of_slab(0.7);
    EXPECT_EQ(moved.voxels_lost, 16 * 16);
    EXPECT_EQ(moved.voxels_gained, 16 * 16);
    const RegionChanges twice = changes_of_slab(-1.7);
    EXPECT_EQ(twice.voxels_lost, 2 * 16 * 16);
    EXPECT_EQ(twice.voxels_gained, 2 * 16 * 16);
}

TEST(Changes, a_label_is_reported_once_with_all_its_components) {
    const auto volume = test::sample_volume({40, 24, 24}, {1, 1, 1}, [](const Vec3& p) {
        if ((p - Vec3(11, 12, 12)).norm() < 7) return 3;
        return (p - Vec3(29, 12, 12)).norm() < 5 ? 3 : p.x() > 35 ? 9 : 0;
    });
    const auto sets = from_labels(volume, std::vector<std::int32_t>{3, 9}, {}, silent);
    ASSERT_EQ(sets.regions.size(), 3u);
    ASSERT_EQ(sets.smoothing.size(), 2u);
    const SmoothingReport& balls = sets.smoothing[0];
    EXPECT_EQ(balls.label, 3);
    EXPECT_EQ(balls.volume_before, sets.regions[0].volume_labels + sets.regions[1].volume_labels);
    EXPECT_NEAR(balls.volume_after, balls.volume_before, 2e-3 * balls.volume_before);
    // A ball's staircase strays half a voxel from it at most, a fifth on average.
    EXPECT_GT(balls.moved_mean, 0.1);
    EXPECT_LT(balls.moved_mean, balls.moved_95);
    EXPECT_LT(balls.moved_95, balls.moved_max);
    EXPECT_LE(balls.moved_max, 0.5);
    EXPECT_EQ(sets.smoothing[1].label, 9);
}

TEST(Changes, without_smoothing_walls_stay) {
    const auto volume = test::sample_volume({24, 24, 24}, {1, 1, 1}, [](const Vec3& p) {
        return (p - Vec3(11, 12, 12)).norm() < 8 ? 1 : 0;
    });
    LabelOptions options;
    options.smoothing = Smoothing::none;
    const auto sets = from_labels(volume, std::vector<std::int32_t>{1}, options, silent);
    // Edges of voxels are cut off within cells, and no more.
    EXPECT_LT(sets.smoothing[0].moved_mean, 0.05);
    EXPECT_LT(sets.smoothing[0].moved_max, 0.3);
    EXPECT_EQ(sets.smoothing[0].voxels_lost + sets.smoothing[0].voxels_gained, 0);
}

}  // namespace
}  // namespace myotet::levelset
