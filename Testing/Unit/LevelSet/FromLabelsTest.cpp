// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "LabelShapes.h"
#include "LevelSet/FromLabels.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

SilentProgress silent;
// Volumes are matched to a thousandth by iteration; redistancing keeps them.
constexpr double kVolumeTolerance = 2e-3;

LabelLevelSets run(const LabelVolume& volume, const std::vector<std::int32_t>& labels,
                   const LabelOptions& options = {}) {
    return from_labels(volume, labels, options, silent);
}

double volume_error(const Region& r) { return r.volume_level_set / r.volume_labels - 1; }

// Centroid of {phi < 0} on the fine lattice, LPS.
Vec3 centroid_lps(const LabelLevelSets& sets, const Region& r) {
    const Box box = r.phi.box();
    Vec3 sum = Vec3::Zero();
    std::int64_t count = 0;
    const double h = sets.spacing;
    for (double z = box.min.z(); z < box.max.z(); z += h)
        for (double y = box.min.y(); y < box.max.y(); y += h)
            for (double x = box.min.x(); x < box.max.x(); x += h)
                if (r.phi.value({x, y, z}) < 0) {
                    sum += Vec3(x, y, z);
                    ++count;
                }
    return sets.frame.to_lps(sum / static_cast<double>(count));
}

Vec3 label_centroid(const LabelVolume& volume, int label) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int k = 0; k < volume.size[2]; ++k)
        for (int j = 0; j < volume.size[1]; ++j)
            for (int i = 0; i < volume.size[0]; ++i)
                if (volume.values[volume.offset(i, j, k)] == label) {
                    sum += Vec3(i, j, k);
                    ++count;
                }
    return volume.index_to_lps * Vec3(sum / count);
}

TEST(FromLabels, voxel_sphere_becomes_round_and_keeps_its_volume) {
    const Vec3 centre(20.2, 20.4, 20.3);
    const double radius = 12;
    const auto volume = test::sample_volume({41, 41, 41}, {1, 1, 1}, [&](const Vec3& p) {
        return (p - centre).norm() < radius ? 4 : 0;
    });
    const auto sets = run(volume, {4});
    ASSERT_EQ(sets.regions.size(), 1u);
    const Region& r = sets.regions[0];
    EXPECT_NEAR(volume_error(r), 0, kVolumeTolerance);
    // The sample nearest to the centre lies up to half a cell's diagonal away.
    EXPECT_NEAR(r.inscribed_radius, radius, 0.9);
    // The staircase strays by 0.18 of a voxel (rms) and 22 degrees; measured
    // after smoothing: 0.05 and 3.
    double square = 0, angle = 0;
    const auto directions = test::directions(1000);
    for (const Vec3& u : directions) {
        const Sample s = r.phi.sample(sets.frame.to_local(centre + radius * u));
        square += s.value * s.value;
        const Vec3 n = (sets.frame.rotation * s.gradient).normalized();
        angle += std::pow(std::acos(std::min(1.0, n.dot(u))), 2);
        EXPECT_NEAR(s.gradient.norm(), 1, 0.25);
    }
    EXPECT_LT(std::sqrt(square / 1000), 0.07);
    EXPECT_LT(std::sqrt(angle / 1000) * 180 / M_PI, 4.5);
}

TEST(FromLabels, thick_slices_are_levelled) {
    const Vec3 centre(15.2, 15.4, 20.3);
    const auto volume = test::sample_volume({60, 60, 20}, {0.5, 0.5, 2}, [&](const Vec3& p) {
        return (p - centre).norm() < 10 ? 1 : 0;
    });
    const auto sets = run(volume, {1});
    const Region& r = sets.regions[0];
    EXPECT_NEAR(volume_error(r), 0, kVolumeTolerance);
    double square = 0;
    for (const Vec3& u : test::directions(1000))
        square += std::pow(r.phi.value(sets.frame.to_local(centre + 10 * u)), 2);
    // Slices two wide stray by 0.24 (rms) before, 0.04 after.
    EXPECT_LT(std::sqrt(square / 1000), 0.1);
}

TEST(FromLabels, no_smoothing_keeps_the_voxels_walls) {
    const auto volume = test::make_volume({16, 16, 16}, {1, 1, 1}, [](int i, int j, int k) {
        return i > 3 && i < 12 && j > 3 && j < 12 && k > 3 && k < 12 ? 1 : 0;
    });
    LabelOptions options;
    options.smooth = 0;
    const auto sets = run(volume, {1}, options);
    for (const double x : {3.0, 3.5, 4.0})
        EXPECT_NEAR(sets.regions[0].phi.value(sets.frame.to_local({x, 7.5, 7.5})), 3.5 - x, 0.05);
    EXPECT_FALSE(sets.regions[0].smoothed_less);
}

TEST(FromLabels, three_touching_blocks_leave_neither_gap_nor_overlap) {
    // Walls meet in a line at (12, 12); the background is far from it.
    const auto volume = test::make_volume({24, 24, 24}, {1, 1, 1}, [](int i, int j, int k) {
        if (i < 3 || j < 3 || k < 3 || i > 20 || j > 20 || k > 20) return 0;
        return i < 12 ? 1 : j < 12 ? 2 : 3;
    });
    const auto sets = run(volume, {1, 2, 3});
    ASSERT_EQ(sets.regions.size(), 3u);
    double gap = 0, overlap = 0;
    for (double z = 6; z < 18; z += 0.37)
        for (double y = 6; y < 18; y += 0.31)
            for (double x = 6; x < 18; x += 0.29) {
                std::array<double, 3> v;
                for (int r = 0; r < 3; ++r)
                    v[r] = sets.regions[r].phi.value(sets.frame.to_local({x, y, z}));
                std::sort(v.begin(), v.end());
                gap = std::max(gap, v[0]);
                overlap = std::max(overlap, -v[1]);
            }
    // At samples both are zero; between them, only a cell with three walls
    // can err, by what the corner of a wall rises within it.
    EXPECT_LT(gap, 0.25);
    EXPECT_LT(overlap, 0.25);
    for (const Region& r : sets.regions) EXPECT_NEAR(volume_error(r), 0, kVolumeTolerance);
    // Away from the line the wall is one: opposite values.
    for (const double d : {-0.7, -0.2, 0.0, 0.4}) {
        const Vec3 x = sets.frame.to_local({11.5 + d, 7, 12});
        EXPECT_NEAR(sets.regions[0].phi.value(x), -sets.regions[1].phi.value(x), 1e-4);
    }
}

TEST(FromLabels, specks_tubes_and_sheets_survive_on_fine_and_wide_lattices) {
    const auto volume = test::make_volume({30, 30, 30}, {1, 1, 1}, [](int i, int j, int k) {
        if (i == 5 && j > 4 && j < 25 && k > 4 && k < 25) return 1;  // sheet
        if (i == 12 && j == 12 && k > 4 && k < 25) return 2;         // tube
        if (i == 20 && j == 20 && k == 20) return 3;                 // speck
        return 0;
    });
    for (const double spacing : {0.5, 1.0, 1.3}) {
        LabelOptions options;
        options.spacing = spacing;
        const auto sets = run(volume, {1, 2, 3}, options);
        ASSERT_EQ(sets.regions.size(), 3u);
        // On the wide lattice a sheet is as thick as a sample is wide.
        const double tolerance = spacing > 1 ? 0.3 : 0.01;
        for (const Region& r : sets.regions) {
            EXPECT_NEAR(volume_error(r), 0, tolerance) << "label " << r.label << " at " << spacing;
            EXPECT_TRUE(r.smoothed_less) << "label " << r.label << " at " << spacing;
        }
        if (spacing > 1) continue;
        // No hole: inside along the whole sheet and the whole tube.
        for (double y = 6; y < 24; y += 0.5) {
            EXPECT_LT(sets.regions[0].phi.value(sets.frame.to_local({5, y, 14.3})), 0);
            EXPECT_LT(sets.regions[1].phi.value(sets.frame.to_local({12, 12, y})), 0);
        }
    }
}

TEST(FromLabels, label_cut_by_the_border_is_closed_flat) {
    const auto volume = test::make_volume({12, 32, 32}, {1, 1, 1}, [](int i, int j, int k) {
        return i < 8 && j > 3 && j < 28 && k > 3 && k < 28 ? 1 : 0;
    });
    const auto sets = run(volume, {1});
    const Region& r = sets.regions[0];
    EXPECT_NEAR(volume_error(r), 0, kVolumeTolerance);
    // The image ends at x = -0.5; flat to a seventh of a voxel away from edges.
    for (double y = 10; y < 22; y += 0.5)
        EXPECT_NEAR(r.phi.value(sets.frame.to_local({-0.5, y, 15.5})), 0, 0.15);
}

TEST(FromLabels, centroids_are_kept_in_any_orientation) {
    const auto shape = [](int i, int j, int k) {
        return i > 3 && i < 14 && j > 3 && j < 10 && k > 3 && k < 4 + i / 2 ? 1 : 0;
    };
    const Vec3 spacing(1, 0.8, 2);
    const Mat3 turn =
        (Eigen::AngleAxisd(0.5, Vec3::UnitY()) * Eigen::AngleAxisd(0.3, Vec3::UnitX()))
            .toRotationMatrix();
    Mat3 left = turn;
    left.col(2) = -left.col(2);
    Mat3 sheared = turn;
    sheared.col(1) += 0.3 * turn.col(0);
    for (const Mat3& directions : {turn, left, sheared}) {
        auto volume = test::make_volume({18, 14, 14}, spacing, shape);
        volume.index_to_lps.linear() = directions * spacing.asDiagonal();
        volume.index_to_lps.translation() = Vec3(-100, 40, 7);
        const auto sets = run(volume, {1});
        const double off = (centroid_lps(sets, sets.regions[0]) - label_centroid(volume, 1)).norm();
        EXPECT_LT(off, 0.25 * spacing.minCoeff());
        EXPECT_NEAR(volume_error(sets.regions[0]), 0, kVolumeTolerance);
    }
}

TEST(FromLabels, mass_stays_where_it_was_in_a_part_thick_and_thin) {
    // A ball with a long tail one voxel thick, between two other tissues.
    const auto volume = test::sample_volume({48, 24, 24}, {1, 1, 1}, [](const Vec3& p) {
        if ((p - Vec3(9, 12, 12)).norm() < 6) return 1;
        if (std::abs(p.y() - 12) < 0.5 && p.x() > 9 && p.x() < 44 && std::abs(p.z() - 12) < 4)
            return 1;
        const bool around = (p - Vec3(26, 12, 12)).cwiseQuotient(Vec3(22, 10, 10)).norm() < 1;
        return !around ? 0 : p.y() < 12 ? 2 : 3;
    });
    const auto sets = run(volume, {1, 2, 3});
    // A tail that loses a fifth of its volume to the ball moves it by a voxel.
    for (const Region& r : sets.regions)
        EXPECT_LT((centroid_lps(sets, r) - label_centroid(volume, r.label)).norm(), 0.5);
}

TEST(FromLabels, wide_smoothing_moves_corners_further) {
    const auto volume = test::make_volume({40, 40, 40}, {1, 1, 1}, [](int i, int j, int k) {
        return i > 7 && i < 32 && j > 7 && j < 32 && k > 7 && k < 32 ? 1 : 0;
    });
    const auto edge = [&](double smooth) {
        LabelOptions options;
        options.smooth = smooth;
        const auto sets = run(volume, {1}, options);
        EXPECT_NEAR(volume_error(sets.regions[0]), 0, kVolumeTolerance);
        return sets.regions[0].phi.value(sets.frame.to_local({31.5, 31.5, 19.5}));
    };
    EXPECT_NEAR(edge(0), 0, 0.3);
    // Less than three, as volume is given back around the edge too.
    EXPECT_GT(edge(3), 1.5);
    EXPECT_LT(edge(3), 3.2);
}

TEST(FromLabels, same_bytes_for_any_number_of_threads) {
    const auto volume = test::sample_volume({30, 30, 30}, {1, 1, 1}, [](const Vec3& p) {
        const double a = (p - Vec3(11, 14, 14)).norm(), b = (p - Vec3(19, 15, 13)).norm();
        return a < 7 && a < b ? 1 : b < 8 ? 2 : 0;
    });
    const auto make = [&](int threads) {
        const ThreadLimit limit(threads);
        return run(volume, {1, 2});
    };
    const auto one = make(1), two = make(2);
    for (int r = 0; r < 2; ++r) {
        EXPECT_EQ(one.regions[r].phi.values, two.regions[r].phi.values);
        EXPECT_EQ(one.regions[r].phi.coarse_values, two.regions[r].phi.coarse_values);
        EXPECT_EQ(one.regions[r].volume_level_set, two.regions[r].volume_level_set);
    }
}

TEST(FromLabels, bad_options_and_labels_are_refused) {
    const auto volume =
        test::make_volume({8, 8, 8}, {1, 1, 1}, [](int i, int, int) { return i < 4 ? 1 : 0; });
    EXPECT_THROW((void)run(volume, {2}), InputError);
    for (const double bad : {-1.0, std::nan("")}) {
        LabelOptions options;
        options.spacing = bad;
        EXPECT_THROW((void)run(volume, {1}, options), InputError);
    }
    LabelOptions options;
    options.max_memory = 1000;
    EXPECT_THROW((void)run(volume, {1}, options), ResourceError);
}

TEST(FromLabels, stages_are_reported_in_order) {
    struct Listener final : ProgressSink {
        std::vector<std::string> stages;
        void report(std::string_view stage, double fraction) override {
            EXPECT_GE(fraction, 0);
            EXPECT_LE(fraction, 1);
            if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
        }
        void warn(std::string_view) override {}
        void note(std::string_view) override {}
    } listener;
    const ThreadLimit limit(1);
    const auto volume =
        test::make_volume({8, 8, 8}, {1, 1, 1}, [](int i, int, int) { return i < 4 ? 1 : 0; });
    (void)from_labels(volume, std::vector<std::int32_t>{1}, {}, listener);
    EXPECT_THAT(listener.stages,
                testing::ElementsAre("distances", "smoothing", "partition", "level sets"));
}

}  // namespace
}  // namespace myotet::levelset
