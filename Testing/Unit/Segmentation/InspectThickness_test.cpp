// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/InspectThickness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "Core/Parallel.h"

namespace myotet::segmentation {
namespace {

// Distances are 32-bit numbers of a few digits.
constexpr double kRounding = 1e-5;

LabelVolume make_volume(const Index3& size, const Vec3& spacing,
                        const std::function<bool(const Vec3&)>& inside) {
    LabelVolume volume;
    volume.size = size;
    volume.index_to_lps.linear() = spacing.asDiagonal();
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i)
                volume.values.push_back(inside(spacing.cwiseProduct(Vec3(i, j, k))) ? 7 : 0);
    return volume;
}

std::vector<float> radii_of(const LabelVolume& volume) {
    std::vector<float> radii;
    for (const MedialVoxel& m : measure_thickness(volume, map_runs(volume)).medial)
        radii.push_back(m.radius);
    std::ranges::sort(radii);
    return radii;
}

TEST(SquaredDistances, AreTheLeastOfAllParabolas) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> height(0, 60);
    for (const double step : {0.5, 1.0, 3.0})
        for (int n = 1; n <= 40; ++n) {
            std::vector<float> before(n);
            for (float& h : before) h = height(random);
            std::vector<float> after = before;
            squared_distances(after, step);
            for (int x = 0; x < n; ++x) {
                const double left = step * (x + 1), right = step * (n - x);
                double least = std::min(left * left, right * right);
                for (int q = 0; q < n; ++q)
                    least = std::min(least, before[q] + step * step * (x - q) * (x - q));
                EXPECT_NEAR(after[x], least, kRounding * (1 + least));
            }
        }
}

TEST(Thickness, OfASlabIsHalfItsWidth) {
    const Vec3 spacing(0.7, 1.1, 2.5);
    for (int axis = 0; axis < 3; ++axis)
        for (int width = 1; width <= 5; ++width) {
            const double low = 2.5 * spacing[axis], high = (2.5 + width) * spacing[axis];
            Index3 size{80, 51, 23};
            size[axis] = 9;
            const std::vector<float> radii = radii_of(make_volume(
                size, spacing, [&](const Vec3& p) { return p[axis] > low && p[axis] < high; }));
            ASSERT_FALSE(radii.empty());
            EXPECT_NEAR(radii[radii.size() / 2], 0.5 * width * spacing[axis], kRounding)
                << axis << " " << width;
            EXPECT_LE(radii.back(), 0.5 * width * spacing[axis] + kRounding);
        }
}

TEST(Thickness, OfABallIsItsRadiusAtItsCentre) {
    for (const Vec3& spacing : {Vec3(1, 1, 1), Vec3(0.6, 0.8, 2)}) {
        const double radius = 12;
        Index3 size{};
        for (int a = 0; a < 3; ++a) size[a] = static_cast<int>(30 / spacing[a]);
        const Vec3 centre(14.2, 14.6, 14.9);
        const std::vector<float> radii = radii_of(make_volume(
            size, spacing, [&](const Vec3& p) { return (p - centre).norm() < radius; }));
        ASSERT_FALSE(radii.empty());
        // Balls end half a voxel before the others' centres, and the centre
        // itself lies up to half a voxel from a voxel's.
        EXPECT_LE(radii.back(), radius + kRounding);
        EXPECT_GE(radii.back(), radius - spacing.norm());
        // What is neither tip nor step has its middle there and nowhere else.
        EXPECT_GE(radii[radii.size() / 2], radius - spacing.norm());
        EXPECT_LT(radii.size(), 30u);
    }
}

TEST(Thickness, OfARodIsItsRadius) {
    const Vec3 from(10, 10, 10), to(35, 50, 70), axis = (to - from).normalized();
    for (const double radius : {2.0, 3.0, 4.5, 8.0}) {
        const auto rod = [&](const Vec3& p) {
            const double along = std::clamp((p - from).dot(axis), 0.0, (to - from).norm());
            return (p - from - along * axis).norm() < radius;
        };
        const std::vector<float> radii = radii_of(make_volume({46, 60, 80}, Vec3(1, 1, 1), rod));
        ASSERT_FALSE(radii.empty());
        EXPECT_LE(radii.back(), radius + kRounding);
        // Half a voxel for the wall, half a diagonal of the cross-section for the middle.
        constexpr double kLost = 0.5 + 0.71;
        EXPECT_GE(radii[radii.size() / 2], radius - kLost) << radius;
    }
}

TEST(Thickness, CountsWhatIsOneVoxelThick) {
    // A block of 5 x 5 x 5, a fin of 5 x 1 x 5 on it and a voxel apart.
    const LabelVolume volume = make_volume({12, 12, 12}, Vec3(1, 1, 1), [](const Vec3& p) {
        const auto within = [&](const Vec3& low, const Vec3& high) {
            return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
        };
        return within({1, 1, 1}, {5, 5, 5}) || within({6, 3, 1}, {10, 3, 5}) ||
               within({10, 10, 10}, {10, 10, 10});
    });
    const std::vector<std::int64_t> thin =
        measure_thickness(volume, map_runs(volume)).one_voxel_thick;
    EXPECT_EQ(thin.size(), 3u);
    EXPECT_EQ(thin[1], 25);
    EXPECT_EQ(thin[2], 1);
}

TEST(Thickness, IsTheSameForAnyNumberOfThreads) {
    const LabelVolume volume = make_volume({40, 40, 40}, Vec3(1, 1, 2), [](const Vec3& p) {
        return std::sin(p[0] / 3) + std::sin(p[1] / 4) + std::sin(p[2] / 5) > 0;
    });
    const auto with = [&](int threads) {
        const ThreadLimit limit(threads);
        return radii_of(volume);
    };
    EXPECT_EQ(with(1), with(2));
}

}  // namespace
}  // namespace myotet::segmentation
