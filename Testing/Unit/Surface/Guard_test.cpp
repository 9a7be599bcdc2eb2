// SPDX-License-Identifier: Apache-2.0
#include "Surface/Guard.h"

#include <gtest/gtest.h>

#include "Surface/Change.h"
#include "SurfaceShapes.h"

namespace myotet::surface {
namespace {

/// A triangle high above the north pole of a ball about the origin, edges `wide`.
TriMesh roof(double height, double wide) {
    TriMesh mesh;
    mesh.points = {{-wide, -wide, height}, {wide, -wide, height}, {0, wide, height}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

Fans coarse_ball(const Guide& guide, const Shape& shape) {
    SilentProgress silent;
    const Options options{.edge_length = 0.8};
    Fans fans = make_fans(make_surface(shape.start, {.phi = guide.phi}, options, silent).mesh);
    std::ranges::fill(fans.sizes, options.edge_length);
    place_all(fans, {.phi = guide.phi});
    return fans;
}

TEST(Guard, takes_back_what_crosses_a_mesh_beside_it) {
    const Shape shape = ball(3, 0.25);
    const Guide guide{.phi = shape.field(), .beside = {.phi = {}, .mesh = roof(3.5, 4)}};
    Fans fans = coarse_ball(guide, shape);
    const std::vector<Vec3> before = fans.points;
    CrossingGuard guard(fans, guide.beside.mesh);
    // Nothing watches this change, and no try of it is better: all is put back.
    guard.run([&] {
        for (Vec3& p : fans.points) p *= 1.3;
    });
    EXPECT_EQ(fans.points, before);
    // The guide's field asks where each point may go: those under the roof stay.
    const Guide grown{.phi = offset(guide.phi, 0.9), .beside = guide.beside};
    std::ranges::fill(fans.sizes, 2);
    guard.run([&] { place_all(fans, grown); });
    EXPECT_TRUE(crossings(fans.points, fans.triangles, guide.beside.mesh).empty());
    EXPECT_NE(fans.points, before);
    EXPECT_TRUE(fans.others.empty());
}

TEST(Guard, crossings_that_were_there_may_stay_but_no_more_come) {
    const Shape shape = ball(3, 0.25);
    const Guide guide{.phi = shape.field(), .beside = {.phi = {}, .mesh = roof(2.9, 4)}};
    Fans fans = coarse_ball(guide, shape);
    const std::size_t there = crossings(fans.points, fans.triangles, guide.beside.mesh).size();
    ASSERT_GT(there, 0u);
    CrossingGuard guard(fans, guide.beside.mesh);
    guard.run([&] { place_all(fans, {.phi = offset(guide.phi, 0.2)}); });
    EXPECT_LE(crossings(fans.points, fans.triangles, guide.beside.mesh).size(), there);
}

}  // namespace
}  // namespace myotet::surface
