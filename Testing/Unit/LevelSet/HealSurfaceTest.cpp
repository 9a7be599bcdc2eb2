// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "CrackedShapes.h"
#include "LevelSet/HealSurface.h"

namespace myotet::levelset {
namespace {

TriMesh sphere() { return test::sphere_surface({1, 2, 3}, 10, 20); }

/// How many triangles look towards the centre of the sphere.
std::size_t inward(const TriMesh& surface) {
    return std::ranges::count_if(surface.triangles, [&](const Triangle& t) {
        return signed_volume({1, 2, 3}, surface.points[t[0]], surface.points[t[1]],
                             surface.points[t[2]]) < 0;
    });
}

TEST(HealSurface, a_good_surface_stays_as_it_is) {
    HealSummary summary;
    const TriMesh healed = orient_surface(sphere(), summary);
    EXPECT_EQ(healed.triangles, sphere().triangles);
    EXPECT_EQ(summary.open_edges, 0);
    EXPECT_EQ(summary.holes, 0);
    EXPECT_EQ(summary.turned_triangles, 0);
    EXPECT_EQ(summary.doubled_triangles, 0);
}

TEST(HealSurface, triangles_that_face_the_wrong_way_are_turned) {
    TriMesh surface = sphere();
    std::mt19937 random(1);
    std::int64_t flipped = 0;
    for (Triangle& t : surface.triangles)
        if (random() % 10 < 3) {
            std::swap(t[0], t[1]);
            ++flipped;
        }
    HealSummary summary;
    EXPECT_EQ(inward(orient_surface(surface, summary)), 0u);
    EXPECT_EQ(summary.turned_triangles, flipped);
}

TEST(HealSurface, a_surface_inside_out_is_turned_and_a_cavity_is_not) {
    TriMesh surface = sphere();
    surface.triangles.pop_back();
    test::turn_all(surface);
    HealSummary summary;
    EXPECT_EQ(inward(orient_surface(surface, summary)), 0u);
    EXPECT_EQ(summary.open_edges, 3);
    EXPECT_EQ(summary.holes, 1);

    TriMesh cavity = test::sphere_surface({1, 2, 3}, 4, 10);
    test::turn_all(cavity);
    const std::size_t hollow = cavity.triangles.size();
    HealSummary second;
    EXPECT_EQ(inward(orient_surface(test::together(sphere(), cavity), second)), hollow);
    EXPECT_EQ(second.turned_triangles, 0);
}

TEST(HealSurface, pieces_with_points_of_their_own_follow_their_neighbours) {
    TriMesh surface = test::cut_into_patches(sphere(), 4);
    const std::size_t all = surface.triangles.size();
    // Every third patch, by its octant, turned.
    std::int64_t flipped = 0;
    for (std::size_t n = 0; n < all; ++n)
        if (test::patch_of(sphere(), n, 4) % 3 == 0) {
            std::swap(surface.triangles[n][0], surface.triangles[n][1]);
            ++flipped;
        }
    ASSERT_GT(flipped, 0);
    HealSummary summary;
    EXPECT_EQ(inward(orient_surface(surface, summary)), 0u);
    EXPECT_EQ(summary.turned_triangles, flipped);
    EXPECT_GT(summary.open_edges, 0);
}

TEST(HealSurface, doubled_triangles_are_left_out) {
    TriMesh surface = sphere();
    const std::size_t all = surface.triangles.size();
    for (int n = 0; n < 5; ++n) surface.triangles.push_back(surface.triangles[10 * n]);
    std::swap(surface.triangles.back()[0], surface.triangles.back()[1]);  // either way round
    HealSummary summary;
    EXPECT_EQ(orient_surface(surface, summary).triangles.size(), all);
    EXPECT_EQ(summary.doubled_triangles, 5);
    EXPECT_EQ(summary.open_edges, 0);
}

TEST(HealSurface, a_moebius_strip_is_left_alone) {
    TriMesh strip;
    constexpr int kParts = 24;
    for (int n = 0; n < kParts; ++n) {
        const double u = 2 * std::numbers::pi * n / kParts;
        for (const double v : {-1.0, 1.0})
            strip.points.push_back(Vec3((5 + v * std::cos(u / 2)) * std::cos(u),
                                        (5 + v * std::cos(u / 2)) * std::sin(u),
                                        v * std::sin(u / 2)));
    }
    for (int n = 0; n < kParts; ++n) {
        const bool last = n + 1 == kParts;
        const int a = 2 * n, b = 2 * n + 1, c = last ? 1 : 2 * n + 2, d = last ? 0 : 2 * n + 3;
        strip.triangles.push_back({a, c, b});
        strip.triangles.push_back({b, c, d});
    }
    HealSummary summary;
    EXPECT_EQ(orient_surface(strip, summary).triangles, strip.triangles);
    EXPECT_EQ(summary.holes, 1);
}

}  // namespace
}  // namespace myotet::levelset
