// SPDX-License-Identifier: Apache-2.0
#include "Surface/Crossings.h"

#include <gtest/gtest.h>

#include "SurfaceShapes.h"

namespace myotet::surface {
namespace {

using Pairs = std::vector<std::array<std::int32_t, 2>>;

/// A triangle in the plane z = 0 and one whose lowest corner is at `depth`.
TriMesh two_triangles(double depth) {
    TriMesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, depth}, {2, 1, 3}, {1, 2, 3}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    return mesh;
}

TEST(Crossings, a_triangle_that_dips_through_another) {
    const TriMesh through = two_triangles(-1), above = two_triangles(0.5);
    EXPECT_EQ(crossings(through.points, through.triangles), (Pairs{{0, 1}}));
    EXPECT_EQ(crossings(above.points, above.triangles), Pairs{});
}

TEST(Crossings, removed_triangles_and_neighbours_do_not_count) {
    TriMesh mesh = two_triangles(-1);
    mesh.triangles.push_back({0, 2, 1});
    EXPECT_EQ(crossings(mesh.points, mesh.triangles), (Pairs{{0, 1}, {1, 2}})) << "not (0, 2)";
    mesh.triangles[0] = {-1, -1, -1};
    EXPECT_EQ(crossings(mesh.points, mesh.triangles), (Pairs{{1, 2}}));
}

TEST(Crossings, triangles_that_share_a_point) {
    TriMesh mesh;
    // The second one's far edge passes through the first, or beside it.
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {-1, -1, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
    EXPECT_EQ(crossings(mesh.points, mesh.triangles), (Pairs{{0, 1}}));
    mesh.triangles[1] = {0, 4, 5};
    EXPECT_EQ(crossings(mesh.points, mesh.triangles), Pairs{});
}

TEST(Crossings, with_a_mesh_beside_by_their_numbers_after_one_another) {
    TriMesh both = two_triangles(-1), beside = two_triangles(-1);
    const TriMesh own{.points = both.points, .triangles = {both.triangles[0]}};
    // That within the mesh beside is its own affair.
    EXPECT_EQ(crossings(own.points, own.triangles, beside), (Pairs{{0, 2}}));
    EXPECT_EQ(crossings(own.points, own.triangles, TriMesh{}), Pairs{});
    const TriMesh all = joined(own.points, own.triangles, beside);
    EXPECT_EQ(all.points.size(), 12u);
    EXPECT_EQ(all.triangles[2], (Triangle{9, 10, 11}));
}

TEST(Crossings, a_ball_has_none_and_two_that_overlap_have_a_ring) {
    const Shape shape = ball(3, 0.5);
    EXPECT_EQ(crossings(shape.start.points, shape.start.triangles), Pairs{});
    TriMesh both = shape.start;
    const auto shift = static_cast<std::int32_t>(shape.start.points.size());
    for (const Vec3& p : shape.start.points) both.points.emplace_back(p + Vec3(2, 0.1, 0.03));
    for (const Triangle& t : shape.start.triangles)
        both.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    const Pairs pairs = crossings(both.points, both.triangles);
    EXPECT_GT(pairs.size(), 20u);
    for (const auto& pair : pairs)
        EXPECT_TRUE(pair[0] < static_cast<std::int32_t>(shape.start.triangles.size()) &&
                    pair[1] >= static_cast<std::int32_t>(shape.start.triangles.size()));
}

}  // namespace
}  // namespace myotet::surface
