// SPDX-License-Identifier: Apache-2.0
// Scans in thick slices, from labels to level sets.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "LabelShapes.h"
#include "LevelSet/FromLabels.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

SilentProgress silent;
constexpr double kThick = 4, kPixel = 1;
// Pixels tell a smooth surface to a quarter or so; the poles lie up to a slice
// beyond the last one that shows the body.
constexpr double kMean = 0.2 * kPixel, kMost = 0.3 * kThick;

LabelLevelSets run(const LabelVolume& volume, const std::vector<std::int32_t>& labels) {
    return from_labels(volume, labels, {}, silent);
}

struct Deviation {
    double mean = 0, most = 0;
};

Deviation of_ball(const LabelLevelSets& sets, const Vec3& centre, double radius) {
    Deviation d;
    for (const Vec3& u : test::directions(2000)) {
        const double off =
            std::abs(sets.regions[0].phi.value(sets.frame.to_local(centre + radius * u)));
        d.mean += off / 2000;
        d.most = std::max(d.most, off);
    }
    return d;
}

TEST(ThickSlices, a_ball_is_round_whichever_way_it_is_scanned) {
    const Mat3 turn =
        (Eigen::AngleAxisd(0.5, Vec3::UnitY()) * Eigen::AngleAxisd(0.3, Vec3::UnitX()))
            .toRotationMatrix();
    Mat3 left = turn;
    left.col(2) = -left.col(2);
    const Vec3 centre(-80, 35, 12);
    for (const Mat3& directions : {Mat3(Mat3::Identity()), turn, left})
        for (const int axis : {0, 1, 2}) {
            Vec3 spacing = Vec3::Constant(kPixel);
            spacing[axis] = kThick;
            Index3 size{36, 36, 36};
            size[axis] = 10;
            LabelVolume volume = test::make_volume(size, spacing, [](int, int, int) { return 0; });
            volume.index_to_lps.linear() = directions * spacing.asDiagonal();
            volume.index_to_lps.translation() =
                centre - volume.index_to_lps.linear() *
                             (Vec3(size[0], size[1], size[2]) / 2 + Vec3::Constant(0.4));
            for (int k = 0; k < size[2]; ++k)
                for (int j = 0; j < size[1]; ++j)
                    for (int i = 0; i < size[0]; ++i)
                        volume.values[volume.offset(i, j, k)] =
                            (volume.index_to_lps * Vec3(i, j, k) - centre).norm() < 12;
            const Deviation d = of_ball(run(volume, {1}), centre, 12);
            EXPECT_LT(d.mean, kMean) << "axis " << axis;
            EXPECT_LT(d.most, kMost) << "axis " << axis;
        }
}

TEST(ThickSlices, volumes_and_middles_of_voxels_are_kept) {
    const auto volume =
        test::sample_volume({40, 40, 10}, {kPixel, kPixel, kThick}, [](const Vec3& p) {
            const double a = (p - Vec3(15, 19, 17)).norm(), b = (p - Vec3(26, 20, 20)).norm();
            return a < 11 && a < b ? 1 : b < 11 ? 2 : 0;
        });
    const auto sets = run(volume, {1, 2});
    for (const Region& r : sets.regions) {
        EXPECT_NEAR(r.volume_level_set / r.volume_labels, 1, 2e-3);
        int changed = 0;
        for (int k = 0; k < 10; ++k)
            for (int j = 0; j < 40; ++j)
                for (int i = 0; i < 40; ++i) {
                    const Vec3 x = sets.frame.to_local(volume.index_to_lps * Vec3(i, j, k));
                    changed +=
                        (r.phi.value(x) < 0) != (volume.values[volume.offset(i, j, k)] == r.label);
                }
        // Middles on the surface may fall to either side.
        EXPECT_LT(changed, 0.01 * static_cast<double>(r.voxels));
    }
    // One wall: opposite values where the two touch.
    for (double z = 13; z < 24; z += 0.7) {
        const double x = 0.5 * (15 + 26) - 3 / 11.0 * (z - 18.5);
        const Vec3 at = sets.frame.to_local({x, 19.5, z});
        EXPECT_NEAR(sets.regions[0].phi.value(at), -sets.regions[1].phi.value(at), 0.05);
        EXPECT_NEAR(sets.regions[0].phi.value(at), 0, 0.5 * kPixel);
    }
}

TEST(ThickSlices, slanted_tubes_and_thin_sheets_hang_together) {
    // A tube that moves by more than its width every other slice, a sheet at 45 degrees.
    const auto tube = [](double z) { return 12 + 0.9 * (z - 4); };
    const auto volume =
        test::sample_volume({60, 40, 12}, {kPixel, kPixel, kThick}, [&](const Vec3& p) {
            if (p.z() < 3 || p.z() > 41) return 0;
            if (std::hypot(p.x() - tube(p.z()), p.y() - 10) < 2.8) return 1;
            return std::abs(p.y() - 28 - 0.2 * (p.z() - 22)) < 1.6 && p.x() > 8 && p.x() < 50 ? 2
                                                                                              : 0;
        });
    const auto sets = run(volume, {1, 2});
    ASSERT_EQ(sets.regions.size(), 2u);
    for (double z = 5; z < 39; z += 0.25) {
        EXPECT_LT(sets.regions[0].phi.value(sets.frame.to_local({tube(z), 10, z})), -1) << z;
        for (double x = 12; x < 46; x += 2)
            EXPECT_LT(sets.regions[1].phi.value(sets.frame.to_local({x, 28 + 0.2 * (z - 22), z})),
                      -0.3)
                << x << " " << z;
    }
}

TEST(ThickSlices, two_tissues_that_fill_space_leave_no_gap_between_slices) {
    // The wall runs askew; everything within a box belongs to one of two.
    const auto volume =
        test::sample_volume({48, 30, 10}, {kPixel, kPixel, kThick}, [](const Vec3& p) {
            if (p.x() < 4 || p.x() > 43 || p.y() < 4 || p.y() > 25 || p.z() < 3 || p.z() > 33)
                return 0;
            const double wall = 24 + 8 * std::sin(0.22 * p.z()) + 0.4 * (p.y() - 15);
            return p.x() < wall ? 1 : 2;
        });
    const auto sets = run(volume, {1, 2});
    for (double z = 8; z < 28; z += 0.5)
        for (double y = 8; y < 22; y += 0.5)
            for (double x = 8; x < 40; x += 0.5) {
                const Vec3 at = sets.frame.to_local({x, y, z});
                EXPECT_LT(std::min(sets.regions[0].phi.value(at), sets.regions[1].phi.value(at)),
                          0.05 * kPixel);
            }
}

TEST(ThickSlices, specks_of_one_voxel_stay) {
    for (const double spacing : {1.0, 1.1, 1.3}) {
        LabelVolume volume = test::make_volume({24, 24, 9}, {1, 1, 3}, [](int i, int j, int k) {
            return (i == 7 && j == 8 && k == 4) || (i > 14 && i < 17 && j == 15 && k == 5) ? 1 : 0;
        });
        LabelOptions options;
        options.spacing = spacing;
        const auto sets = from_labels(volume, std::vector<std::int32_t>{1}, options, silent);
        ASSERT_EQ(sets.regions.size(), 2u);
        for (const Region& r : sets.regions)
            EXPECT_NEAR(r.volume_level_set / r.volume_labels, 1, 0.3) << spacing;
    }
}

}  // namespace
}  // namespace myotet::levelset
