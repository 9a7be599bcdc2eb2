// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "BandShapes.h"
#include "Core/Errors.h"
#include "LevelSet/Flow.h"
#include "LevelSet/Redistance.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

SilentProgress silent;
std::vector<std::int8_t> no_locks;

double mean_radius(const Band& band, const Vec3& centre, double longest) {
    double sum = 0;
    const auto directions = test::directions(200);
    for (const Vec3& u : directions) sum += test::distance_to_zero(band, centre, u, longest);
    return sum / static_cast<double>(directions.size());
}

TEST(Flow, sphere_shrinks_as_the_square_of_its_radius) {
    // R^2 = R0^2 - 4 b t; explicit steps and central differences err by a few
    // hundredths of a sample on a radius of eight to ten samples.
    const double tolerance = 0.1;
    const Vec3 centre(16.2, 15.9, 16.4);
    for (const double time : {4.0, 9.0}) {
        Band band = test::make_band(test::sphere_field(centre, 10), 4, 1);
        flow_by_mean_curvature(band, {no_locks, 0}, {.time = time, .wanders = true}, silent);
        EXPECT_NEAR(mean_radius(band, centre, 14), std::sqrt(100 - 4 * time), tolerance);
    }
}

TEST(Flow, with_volume_given_back_a_sphere_stays) {
    const double tolerance = 0.05;  // of a sample
    const Vec3 centre(16.2, 15.9, 16.4);
    Band band = test::make_band(test::sphere_field(centre, 8), 4, 1);
    flow_by_mean_curvature(band, {no_locks, 0}, {.time = 2, .give_back_radius = 2, .wanders = true},
                           silent);
    EXPECT_NEAR(mean_radius(band, centre, 14), 8, tolerance);
}

TEST(Flow, right_angle_moves_by_the_distance_asked_for) {
    const double distance = 2, tolerance = 0.15;  // mm; the edge is sharp at first
    // The middle of a cube's edge, far from the corners.
    const auto cube = [](const Vec3& p) {
        return (p - Vec3(24.3, 24.3, 24.3)).cwiseAbs().maxCoeff() - 16;
    };
    Band band = test::make_band(cube, 6, 1);
    redistance(band, Seeds::keep_cells, 0);
    flow_by_mean_curvature(band, {no_locks, 0}, {.time = flow_time(distance), .wanders = true},
                           silent);
    const Vec3 diagonal = Vec3(0, 1, 1).normalized();
    const double now = test::distance_to_zero(band, Vec3(24.3, 30.3, 30.3), diagonal, 18);
    EXPECT_NEAR(10 * std::sqrt(2.0) - now, distance, tolerance);
}

TEST(Flow, plane_is_at_rest) {
    const Vec3 normal = Vec3(1, 2, 3).normalized();
    const auto plane = [&](const Vec3& p) { return (p - Vec3(16, 16, 16)).dot(normal); };
    Band band = test::make_band(plane, 4, 1);
    flow_by_mean_curvature(band, {no_locks, 0}, {.time = 3}, silent);
    EXPECT_NEAR(sample(band, {16, 16, 16}).value, 0, 1e-3);
}

TEST(Flow, locked_samples_keep_their_side) {
    // A bar that the flow alone takes away: R^2 = R0^2 - 2 b t.
    const auto bar = [](const Vec3& p) { return std::hypot(p.y() - 16.3, p.z() - 16.4) - 2; };
    Band band = test::make_band(bar, 4, 1), free = band;
    std::vector<std::int8_t> locks(band.values.size(), 0);
    for (std::size_t i = 0; i < locks.size(); ++i)
        if (band.values[i] < -1.4f) locks[i] = -51;
    const auto stopped = flow_by_mean_curvature(band, {locks, 0.01}, {.time = 3}, silent);
    flow_by_mean_curvature(free, {no_locks, 0}, {.time = 3}, silent);
    EXPECT_GT(stopped, 0);
    EXPECT_LT(sample(band, {16, 16, 16}).value, -0.4);
    EXPECT_GT(sample(free, {16, 16, 16}).value, 0);
}

TEST(Flow, stops_when_interrupted) {
    struct Stop final : ProgressSink {
        void report(std::string_view, double) override {}
        void warn(std::string_view) override {}
        void note(std::string_view) override {}
        [[nodiscard]] bool interrupted() const override { return true; }
    } stop;
    Band band = test::make_band(test::sphere_field({16, 16, 16}, 8), 4, 1);
    EXPECT_THROW(flow_by_mean_curvature(band, {no_locks, 0}, {.time = 1}, stop), Interrupted);
}

}  // namespace
}  // namespace myotet::levelset
