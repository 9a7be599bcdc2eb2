// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "BandShapes.h"
#include "LabelShapes.h"
#include "LevelSet/FromLabels.h"
#include "LevelSet/PartitionError.h"

namespace myotet::levelset {
namespace {

SilentProgress silent;

LevelSet ball(const Vec3& centre, double radius) {
    return assemble(test::make_band(test::sphere_field(centre, radius), 5, 1));
}

LevelSet outside_of(const Vec3& a, const Vec3& b, double radius) {
    Band band = test::make_band(
        [&](const Vec3& p) { return std::max(radius - (p - a).norm(), radius - (p - b).norm()); },
        5, 1);
    band.beyond = Band::kInside;
    mark_unstored_blocks(band);
    return assemble(band);
}

PartitionError partition_of(const LabelVolume& volume, const LabelOptions& options) {
    std::vector<std::int32_t> labels;
    for (std::int32_t label = 1; label <= 8; ++label)
        if (std::count(volume.values.begin(), volume.values.end(), label)) labels.push_back(label);
    LabelOptions with_background = options;
    with_background.background = true;
    const LabelLevelSets sets = from_labels(volume, labels, with_background, silent);
    std::vector<const LevelSet*> regions{&*sets.background};
    for (const Region& r : sets.regions) regions.push_back(&r.phi);
    return measure_partition(regions);
}

TEST(PartitionError, overlap_of_two_balls_is_their_lens) {
    const Vec3 a(15.3, 19.9, 20.2), b(23.3, 19.9, 20.2);
    const double radius = 6, distance = 8;
    const LevelSet first = ball(a, radius), second = ball(b, radius);
    const LevelSet rest = outside_of(a, b, radius);
    const PartitionError error = measure_partition(std::vector{&first, &second, &rest});
    // pi (4 R + d) (2 R - d)^2 / 12
    const double lens = M_PI * (4 * radius + distance) * std::pow(2 * radius - distance, 2) / 12;
    // Interpolants of a ball's distance lie spacing^2 / (6 R) inside of it, or 0.5 %
    // of R, which takes the lens, 2 mm thick on either side, 3 %.
    EXPECT_NEAR(error.overlap, lens, 0.04 * lens);
    ASSERT_FALSE(error.pairs.empty());
    EXPECT_EQ(error.pairs[0].a, 0);
    EXPECT_EQ(error.pairs[0].b, 1);
    EXPECT_NEAR(error.largest_share, lens / (4.0 / 3 * M_PI * std::pow(radius, 3)), 0.01);
}

TEST(PartitionError, what_nobody_claims_is_a_gap) {
    const Vec3 a(14.3, 19.9, 20.2), b(25.3, 19.9, 20.2);
    const LevelSet first = ball(a, 5), second = ball(b, 5), rest = outside_of(a, b, 5.3);
    const PartitionError error = measure_partition(std::vector{&first, &second, &rest});
    const double shell = 4.0 / 3 * M_PI * (std::pow(5.3, 3) - std::pow(5.0, 3));
    EXPECT_NEAR(error.gap, 2 * shell, 0.1 * shell);
    EXPECT_NEAR(error.overlap, 0, 0.01 * shell);
}

// The rule is a thousandth of the smaller tissue; in fact nothing is left but
// rounding, so that a hundredth of that is asked.
constexpr double kLargestShare = 1e-5;

TEST(PartitionError, balls_cut_in_sectors_are_partitioned_within_cells_too) {
    for (const int sectors : {3, 4, 8})
        for (const double radius : {5.0, 12.0}) {
            const Vec3 centre = Vec3::Constant(radius + 4) - Vec3(0.3, 0.1, 0.4);
            const int size = static_cast<int>(2 * radius + 9);
            const auto volume =
                test::sample_volume({size, size, size}, {1, 1, 1}, [&](const Vec3& x) {
                    const Vec3 p = x - centre;
                    if (p.norm() > radius) return 0;
                    const double y = p.y() + 0.3 * p.z(), z = p.z() - 0.25 * p.x();
                    const double u = p.x() + 0.2 * y;
                    if (sectors == 8) return 1 + (u > 0) + 2 * (y > 0) + 4 * (z > 0);
                    const double turn = (std::atan2(y, u) / M_PI + 1) / 2;
                    return 1 + std::min(sectors - 1, static_cast<int>(turn * sectors));
                });
            const PartitionError error = partition_of(volume, {});
            EXPECT_LT(error.largest_share, kLargestShare) << sectors << " of radius " << radius;
        }
}

TEST(PartitionError, oblong_voxels_and_all_kinds_of_smoothing_are_partitioned) {
    const Vec3 spacing(0.6, 0.8, 1.4);
    const auto volume = test::sample_volume({40, 30, 18}, spacing, [](const Vec3& p) {
        if ((p - Vec3(12, 12, 12)).norm() > 9) return 0;
        return (p - Vec3(9, 10, 14)).norm() < 5 ? 1 : p.x() + 0.3 * p.y() < 15 ? 2 : 3;
    });
    for (const Smoothing kind : {Smoothing::curvature, Smoothing::constrained, Smoothing::none}) {
        const PartitionError error = partition_of(volume, {.smoothing = kind});
        EXPECT_LT(error.largest_share, kLargestShare) << static_cast<int>(kind);
    }
}

}  // namespace
}  // namespace myotet::levelset
