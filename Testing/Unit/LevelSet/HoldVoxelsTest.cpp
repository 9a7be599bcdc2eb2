// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "Core/Errors.h"
#include "LabelShapes.h"
#include "LevelSet/FromLabels.h"
#include "LevelSet/HoldVoxels.h"

namespace myotet::levelset {
namespace {

SilentProgress silent;

// Labels 0 to 3 by the largest of four sums of random waves: blobs with necks,
// sheets and specks.
LabelVolume blobs(const Index3& size, const Vec3& spacing, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> phase(0, 2 * M_PI);
    std::array<std::array<std::pair<Vec3, double>, 6>, 4> waves;
    for (auto& field : waves)
        for (auto& [k, p] : field) {
            k = 0.5 * Vec3(normal(random), normal(random), normal(random));
            p = phase(random);
        }
    return test::sample_volume(size, spacing, [&](const Vec3& x) {
        int best = 0;
        double largest = -1e9;
        for (int f = 0; f < 4; ++f) {
            double sum = 0;
            for (const auto& [k, p] : waves[f]) sum += std::cos(k.dot(x) + p);
            if (sum > largest) {
                largest = sum;
                best = f;
            }
        }
        return best;
    });
}

LabelLevelSets constrained(const LabelVolume& volume, double smooth = -1) {
    LabelOptions options;
    options.smoothing = Smoothing::constrained;
    options.smooth = smooth;
    options.background = true;
    return from_labels(volume, std::vector<std::int32_t>{1, 2, 3}, options, silent);
}

// Voxels whose centre is not inside exactly a region of their label; by the
// result alone.
int wrong_voxels(const LabelVolume& volume, const LabelLevelSets& sets) {
    int wrong = 0;
    for (int k = 0; k < volume.size[2]; ++k)
        for (int j = 0; j < volume.size[1]; ++j)
            for (int i = 0; i < volume.size[0]; ++i) {
                const Vec3 x = sets.frame.to_local(volume.index_to_lps * Vec3(i, j, k));
                const std::int32_t label = volume.values[volume.offset(i, j, k)];
                int own = label == 0 && sets.background->value(x) < 0, others = 0;
                others += label != 0 && sets.background->value(x) < 0;
                for (const Region& r : sets.regions)
                    if (r.phi.value(x) < 0) ++(r.label == label ? own : others);
                wrong += own != 1 || others != 0;
            }
    return wrong;
}

TEST(HoldVoxels, no_centre_changes_sides_in_random_blobs) {
    for (const Vec3& spacing : {Vec3(1, 1, 1), Vec3(0.7, 1.1, 1.35), Vec3(0.5, 0.5, 0.9)})
        for (const unsigned seed : {1u, 2u}) {
            const LabelVolume volume = blobs({16, 15, 14}, spacing, seed);
            EXPECT_EQ(wrong_voxels(volume, constrained(volume)), 0)
                << spacing.transpose() << " seed " << seed;
        }
}

TEST(HoldVoxels, no_centre_changes_sides_in_oblique_and_sheared_volumes) {
    const Vec3 spacing(0.8, 1, 1.3);
    const Mat3 turn =
        (Eigen::AngleAxisd(0.5, Vec3::UnitY()) * Eigen::AngleAxisd(0.3, Vec3::UnitX()))
            .toRotationMatrix();
    Mat3 sheared = turn;
    sheared.col(1) += 0.2 * turn.col(0);
    for (const Mat3& directions : {turn, sheared}) {
        LabelVolume volume = blobs({16, 15, 14}, spacing, 3);
        volume.index_to_lps.linear() = directions * spacing.asDiagonal();
        volume.index_to_lps.translation() = Vec3(-100, 40, 7);
        EXPECT_EQ(wrong_voxels(volume, constrained(volume)), 0);
    }
}

TEST(HoldVoxels, the_report_says_so_however_long_the_flow) {
    const LabelVolume volume = blobs({16, 16, 16}, {1, 1, 1}, 4);
    for (const double smooth : {0.3, 2.0})
        for (const SmoothingReport& r : constrained(volume, smooth).smoothing)
            EXPECT_EQ(r.voxels_lost + r.voxels_gained, 0) << "label " << r.label;
    // Not so without the constraint, or the test could not fail.
    LabelOptions free;
    free.smooth = 2;
    std::int64_t lost = 0;
    for (const SmoothingReport& r :
         from_labels(volume, std::vector<std::int32_t>{1, 2, 3}, free, silent).smoothing)
        lost += r.voxels_lost;
    EXPECT_GT(lost, 0);
}

TEST(HoldVoxels, too_wide_a_spacing_is_refused) {
    LabelOptions options;
    options.smoothing = Smoothing::constrained;
    options.spacing = 1.2;
    const LabelVolume volume = blobs({8, 8, 8}, {1, 1, 1}, 1);
    EXPECT_THROW((void)from_labels(volume, std::vector<std::int32_t>{1}, options, silent),
                 InputError);
}

}  // namespace
}  // namespace myotet::levelset
