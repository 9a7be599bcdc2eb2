// SPDX-License-Identifier: Apache-2.0
#include "Surface/Faults.h"

#include <gtest/gtest.h>

#include "Surface/Fans.h"
#include "SurfaceShapes.h"

namespace myotet::surface {
namespace {

double nearest(const std::vector<Vec3>& places, const Vec3& p) {
    double least = 1e9;
    for (const Vec3& q : places) least = std::min(least, (p - q).norm());
    return least;
}

TEST(Faults, a_good_mesh_has_none) {
    const Shape shape = torus(4, 1.5, 0.25);
    SilentProgress silent;
    const Result r =
        make_surface(shape.start, {.phi = shape.field(), .trim = {}}, {.edge_length = 0.6}, silent);
    EXPECT_TRUE(faults(r.mesh, {.phi = shape.field()}).empty());
    EXPECT_TRUE(start_faults(shape.start, {.phi = shape.field()}, 0.25).empty());
}

TEST(Faults, each_is_found_where_it_is) {
    const Shape shape = ball(3, 0.25);
    SilentProgress silent;
    const TriMesh good =
        make_surface(shape.start, {.phi = shape.field(), .trim = {}}, {.edge_length = 0.7}, silent)
            .mesh;
    const Fans fans = make_fans(good);
    // A point pulled over a neighbour: triangles turned over, and sharp.
    TriMesh over = good;
    const std::int32_t n = neighbours(fans, 7).front();
    over.points[7] += 2.2 * (over.points[n] - over.points[7]);
    EXPECT_LT(nearest(faults(over, {.phi = shape.field()}), over.points[n]), 0.7);
    // A point off the surface, by 2 % of an edge.
    TriMesh off = good;
    off.points[7] *= 1 + 0.014 / 3;
    const std::vector<Vec3> places = faults(off, {.phi = shape.field()});
    ASSERT_EQ(places.size(), 1u);
    EXPECT_EQ(places[0], off.points[7]);
}

/// Two samples inside, across the diagonal of a face; between them phi is positive.
Shape specks(bool along_the_joined_diagonal) {
    const Vec3 a = along_the_joined_diagonal ? Vec3(0, 0, 0) : Vec3(1, 0, 0);
    const Vec3 b = along_the_joined_diagonal ? Vec3(1, 1, 0) : Vec3(0, 1, 0);
    return make_shape(
        8, 1, [=](const Vec3& p) { return std::min((p - a).norm(), (p - b).norm()) - 0.3; });
}

TEST(Faults, a_start_that_joins_what_phi_keeps_apart) {
    // Of a face's diagonals extraction joins the one from its lowest corner, whatever
    // phi is at the face's middle.
    const Shape joined = specks(true), apart = specks(false);
    ASSERT_EQ(count_pieces(joined.start), 1);
    ASSERT_EQ(count_pieces(apart.start), 2);
    const std::vector<Vec3> places = start_faults(joined.start, {.phi = joined.field()}, 1);
    EXPECT_FALSE(places.empty());
    for (const Vec3& p : places) EXPECT_LT((p - Vec3(0.5, 0.5, 0)).norm(), 0.5);
    EXPECT_TRUE(start_faults(apart.start, {.phi = apart.field()}, 1).empty());
}

TEST(Faults, not_at_a_boundary) {
    const Shape shape = ball(3, 0.25);
    SilentProgress silent;
    TriMesh half =
        make_surface(shape.start, {.phi = shape.field(), .trim = half_space({0, 0, 0}, {0, 0, 1})},
                     {.edge_length = 0.7}, silent)
            .mesh;
    const Fans fans = make_fans(half);
    for (std::size_t v = 0; v < half.points.size(); ++v)
        if (fans.rim[v]) half.points[v] *= 1.02;
    EXPECT_TRUE(faults(half, {.phi = shape.field()}).empty());
}

}  // namespace
}  // namespace myotet::surface
