// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "LabelShapes.h"
#include "LevelSet/LabelGrid.h"

namespace myotet::levelset {
namespace {

LabelVolume cube_volume(const Mat3& directions, const Vec3& spacing) {
    auto volume = test::make_volume({12, 12, 12}, spacing, [](int i, int j, int k) {
        return i > 2 && i < 9 && j > 2 && j < 9 && k > 2 && k < 9 ? 1 : 0;
    });
    volume.index_to_lps.linear() = directions * spacing.asDiagonal();
    volume.index_to_lps.translation() = Vec3(-40, 25, 310);
    return volume;
}

LabelGrid grid_of(const LabelVolume& volume, const LabelOptions& options = {}) {
    const RegionMap map = map_regions(volume, std::vector<std::int32_t>{1});
    return lay_grid(volume, shared_walls(map, face_area(volume)), options);
}

const Mat3 kOblique =
    (Eigen::AngleAxisd(0.4, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.3, Vec3::UnitX()))
        .toRotationMatrix();

TEST(LabelGrid, frame_is_right_handed_along_the_scan_and_positive_inside) {
    Mat3 left = kOblique;
    left.col(1) = -left.col(1);
    for (const Mat3& directions : {Mat3(Mat3::Identity()), kOblique, left}) {
        const LabelVolume volume = cube_volume(directions, {1, 1, 2});
        const LabelGrid grid = grid_of(volume);
        EXPECT_NEAR(grid.frame.rotation.determinant(), 1, 1e-12);
        const Mat3 turn = grid.frame.rotation.transpose() * directions;
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(turn.col(a).cwiseAbs().maxCoeff(), 1, 1e-12);
        for (const double i : {-0.5, 11.5})
            for (const double k : {-0.5, 11.5}) {
                const Vec3 p = grid.frame.to_local(volume.index_to_lps * Vec3(i, 11.5 - i, k));
                EXPECT_GT(p.minCoeff(), 0);
                const Vec3 index = grid.lattice.local_to_index * p;
                EXPECT_LT((index - Vec3(i, 11.5 - i, k)).norm(), 1e-9);
            }
    }
}

TEST(LabelGrid, cubic_voxels_have_a_sample_in_each_middle) {
    const LabelVolume volume = cube_volume(kOblique, {1.5, 1.5, 1.5});
    const LabelGrid grid = grid_of(volume);
    EXPECT_NEAR(grid.lattice.spacing, 1.5, 1e-12);
    EXPECT_NEAR(grid.smooth, 0.75, 1e-12);
    const Vec3 sample = grid.frame.to_local(volume.index_to_lps * Vec3(3, 5, 7)) / 1.5;
    EXPECT_LT((sample - sample.array().round().matrix()).norm(), 1e-9);
}

TEST(LabelGrid, chosen_spacing_lies_between_smallest_side_and_geometric_mean) {
    const LabelGrid grid = grid_of(cube_volume(Mat3::Identity(), {0.5, 0.5, 2}));
    EXPECT_GE(grid.lattice.spacing, 0.5);
    EXPECT_LE(grid.lattice.spacing, std::cbrt(0.5) + 1e-12);
    // Half a pixel: between thick slices shape is interpolated.
    EXPECT_NEAR(grid.smooth, 0.25, 1e-12);
    EXPECT_EQ(grid.lattice.thick_axis, 2);
}

TEST(LabelGrid, more_memory_than_allowed_is_refused) {
    LabelOptions options;
    options.spacing = 0.001;
    EXPECT_THROW((void)grid_of(cube_volume(Mat3::Identity(), {1, 1, 1}), options), ResourceError);
}

TEST(LabelGrid, faces_and_planes_of_a_sheared_voxel) {
    auto volume = cube_volume(Mat3::Identity(), {1, 2, 3});
    volume.index_to_lps.linear()(0, 1) = 1;  // the j axis leans towards i
    EXPECT_NEAR(volume.voxel_volume(), 6, 1e-12);
    EXPECT_NEAR(plane_spacing(volume)[1], 2, 1e-12);
    EXPECT_NEAR(face_area(volume)[0], 3 * std::sqrt(5.0), 1e-12);
    EXPECT_NEAR(plane_spacing(volume)[0] * face_area(volume)[0], 6, 1e-12);
}

}  // namespace
}  // namespace myotet::levelset
