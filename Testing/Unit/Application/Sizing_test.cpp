// SPDX-License-Identifier: Apache-2.0
#include "Sizing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"

namespace myotet::app {
namespace {

/// A ball of the given radius in voxels of the given size.
Scan ball_scan(double radius, const Vec3& spacing) {
    Scan scan;
    scan.layers.emplace_back();
    scan.spacing = spacing;
    const double volume = 4.0 / 3 * M_PI * std::pow(radius, 3);
    scan.tissues = {{.label = 1,
                     .name = "ball",
                     .voxels = std::llround(volume / spacing.prod()),
                     .volume = volume,
                     .area = 4 * M_PI * radius * radius}};
    return scan;
}

TEST(ChooseSizes, TakesTheEdgeLengthAsAsked) {
    const Scan scan = ball_scan(50, {1, 1, 1});
    const meshing::Options sizes = choose_sizes(
        {.edge_length = 7, .interior_edge_length = 20, .curvature = 0.5, .max_aspect_ratio = 3.9},
        scan);
    EXPECT_EQ(sizes.edge_length, 7);
    EXPECT_EQ(sizes.interior_edge_length, 20);
    EXPECT_EQ(sizes.curvature_factor, 0.5);
    EXPECT_EQ(sizes.aspect_ratio, 3.9);
}

TEST(ChooseSizes, TheInsideIsNeverFinerThanTheSurface) {
    const Scan scan = ball_scan(50, {1, 1, 1});
    EXPECT_EQ(
        choose_sizes({.edge_length = 7, .interior_edge_length = 2}, scan).interior_edge_length, 7);
}

TEST(ChooseSizes, TwoVoxelsByDefault) {
    EXPECT_DOUBLE_EQ(choose_sizes({}, ball_scan(20, {1, 1, 1})).edge_length, 2);
    // As long as the voxel's cube root for slices.
    EXPECT_NEAR(choose_sizes({}, ball_scan(20, {0.5, 0.5, 4})).edge_length, 2, 0.01);
}

TEST(ChooseSizes, LongerWhereTheForecastWouldPassAMillion) {
    const Scan scan = ball_scan(200, {0.5, 0.5, 0.5});
    const meshing::Options sizes = choose_sizes({}, scan);
    EXPECT_GT(sizes.edge_length, 1);
    EXPECT_LE(forecast(sizes, scan).tets, 1e6);
    EXPECT_GT(forecast(sizes, scan).tets, 0.9e6);  // and no longer than needed
}

TEST(ChooseSizes, AGuessForTheTetrahedraAskedFor) {
    const Scan scan = ball_scan(50, {1, 1, 1});
    const Forecast made = forecast(choose_sizes({.tets = 30000}, scan), scan);
    constexpr double kBisection = 1e-3;  // forty halvings go far below
    EXPECT_NEAR(made.tets / 30000, 1, kBisection);
}

TEST(Forecast, GrowsAsTheEdgeLengthShrinks) {
    const Scan scan = ball_scan(50, {1, 1, 1});
    Forecast before = forecast(choose_sizes({.edge_length = 8}, scan), scan);
    for (const double edge : {4.0, 2.0, 1.0}) {
        const Forecast now = forecast(choose_sizes({.edge_length = edge}, scan), scan);
        EXPECT_GT(now.tets, before.tets);
        EXPECT_GT(now.bytes, before.bytes);
        EXPECT_GT(now.seconds, before.seconds);
        before = now;
    }
}

TEST(RequireRoomFor, RefusesWhatDoesNotFit) {
    const Forecast f{.edge_length = 2, .tets = 1e6, .bytes = 1e9, .seconds = 60};
    EXPECT_NO_THROW(require_room_for(f, 2e9));
    EXPECT_THROW(require_room_for(f, 0.5e9), ResourceError);
    Forecast huge = f;
    huge.tets = 1e12;
    EXPECT_THROW(require_room_for(huge, 1e30), ResourceError);
    huge.tets = std::nan("");
    EXPECT_THROW(require_room_for(huge, 1e30), ResourceError);
}

TEST(Rescaled, MovesTheEdgeLengthAgainstTheExcess) {
    meshing::Options sizes;
    sizes.edge_length = 2;
    EXPECT_DOUBLE_EQ(rescaled(sizes, 1).edge_length, 2);
    EXPECT_GT(rescaled(sizes, 1.5).edge_length, 2);
    EXPECT_LT(rescaled(sizes, 0.5).edge_length, 2);
}

TEST(OptionsFor, VoxelsGiveTheVolumeAndOnePiece) {
    meshing::Options sizes;
    sizes.edge_length = 2;
    sizes.components = 3;  // as a surface's shells
    levelset::Region region;
    region.voxels = 10;
    region.volume_labels = 12.5;
    EXPECT_EQ(options_for(region, sizes).volume, 12.5);
    EXPECT_EQ(options_for(region, sizes).components, 1);
    region.voxels = 0;  // a surface
    EXPECT_EQ(options_for(region, sizes).volume, 0);
    EXPECT_EQ(options_for(region, sizes).components, 3);
}

}  // namespace
}  // namespace myotet::app
