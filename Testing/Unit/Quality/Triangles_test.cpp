// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "Quality/Quality.h"

namespace myotet::quality {
namespace {

// A handful of roundings of numbers near 100.
constexpr double kRounding = 1e-9;

/// The corner tetrahedron with legs of 2, 3 and 4 mm: 4 mm^3.
TriMesh corner() {
    return {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A ring of n squares around the third axis, each of two triangles.
TriMesh tube(int n) {
    TriMesh mesh;
    for (int i = 0; i < n; ++i)
        for (const double z : {0.0, 1.0})
            mesh.points.emplace_back(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), z);
    for (int i = 0; i < n; ++i) {
        const std::int32_t a = 2 * i, b = a + 1, c = 2 * ((i + 1) % n), d = c + 1;
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({c, d, b});
    }
    return mesh;
}

TEST(MeasureSurface, ClosedOne) {
    const SurfaceShape s = measure_surface(corner());
    EXPECT_EQ(s.components, 1);
    EXPECT_EQ(s.euler_characteristic, 2);
    EXPECT_EQ(s.boundary_edges + s.boundary_loops, 0);
    EXPECT_EQ(s.non_manifold_edges + s.non_manifold_vertices, 0);
    EXPECT_NEAR(s.volume, 4, kRounding);
    const double slanted = 0.5 * std::sqrt(6.0 * 6 + 8.0 * 8 + 12.0 * 12);
    EXPECT_NEAR(s.area, 3 + 4 + 6 + slanted, kRounding);
    EXPECT_NEAR(s.max_angle_deg, 90, kRounding);
    EXPECT_NEAR(s.min_angle_deg, std::atan2(2, 4) * 180 / M_PI, kRounding);
    EXPECT_NEAR(s.edges.min, 2, kRounding);
    EXPECT_NEAR(s.edges.max, 5, kRounding);
}

TEST(MeasureSurface, TubeHasTwoLoopsAndNoEulerCharacteristic) {
    const SurfaceShape s = measure_surface(tube(7));
    EXPECT_EQ(s.euler_characteristic, 0);
    EXPECT_EQ(s.boundary_edges, 14);
    EXPECT_EQ(s.boundary_loops, 2);
    EXPECT_EQ(s.components, 1);
    EXPECT_EQ(s.non_manifold_edges + s.non_manifold_vertices, 0);
}

TEST(MeasureSurface, FinAndTurnedTriangleAreBadEdges) {
    TriMesh fin = corner();
    fin.points.emplace_back(1, 1, -1);
    fin.triangles.push_back({0, 1, 4});
    EXPECT_EQ(measure_surface(fin).non_manifold_edges, 1);
    TriMesh turned = corner();
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    EXPECT_EQ(measure_surface(turned).non_manifold_edges, 3);
}

TEST(MeasureSurface, TwoThatTouchAtAPointAreOnePieceWithABadPoint) {
    TriMesh two = corner();
    const TriMesh one = corner();
    for (std::size_t p = 1; p < 4; ++p) two.points.push_back(-one.points[p]);
    for (const Triangle& t : one.triangles) {
        const auto other = [](std::int32_t n) { return n == 0 ? 0 : n + 3; };
        two.triangles.push_back({other(t[0]), other(t[2]), other(t[1])});
    }
    const SurfaceShape s = measure_surface(two);
    EXPECT_EQ(s.components, 1);
    EXPECT_EQ(s.non_manifold_vertices, 1);
    EXPECT_EQ(s.non_manifold_edges, 0);
    EXPECT_EQ(s.euler_characteristic, 3);
    EXPECT_NEAR(s.volume, 8, kRounding);
}

TEST(MeasureSurface, PointsOfNoTriangleDoNotCount) {
    TriMesh more = corner();
    more.points.emplace_back(99, 99, 99);
    const SurfaceShape s = measure_surface(more);
    EXPECT_EQ(s.euler_characteristic, 2);
    EXPECT_EQ(s.components, 1);
    EXPECT_EQ(measure_surface({}).components, 0);
}

}  // namespace
}  // namespace myotet::quality
