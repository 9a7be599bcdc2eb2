// SPDX-License-Identifier: Apache-2.0
#include "Surface/TurnBack.h"

#include <gtest/gtest.h>

#include "Surface/Change.h"
#include "Surface/Facing.h"
#include "SurfaceShapes.h"

namespace myotet::surface {
namespace {

Fans fans_of(const Shape& shape, double edge_length) {
    SilentProgress silent;
    const Guide guide{.phi = shape.field()};
    Fans fans =
        make_fans(make_surface(shape.start, guide, {.edge_length = edge_length}, silent).mesh);
    std::ranges::fill(fans.sizes, edge_length);
    place_all(fans, guide);
    return fans;
}

std::int64_t turned(const Fans& fans, const Field& phi) {
    return std::ranges::count_if(
        fans.triangles, [&](const Triangle& t) { return t[0] >= 0 && turned_over(fans, phi, t); });
}

TEST(TurnBack, a_point_pulled_over_its_neighbours_returns) {
    const Shape shape = ball(3, 0.25);
    const Guide guide{.phi = shape.field()};
    Fans fans = fans_of(shape, 0.7);
    for (const std::int32_t v : {5, 40, 90}) {
        const std::int32_t n = neighbours(fans, v).front();
        const auto over = landing(fans, guide, v, 2.2 * fans.points[n] - 1.2 * fans.points[v]);
        ASSERT_TRUE(over);
        fans.points[v] = over->point;
        fans.normals[v] = over->normal;
    }
    ASSERT_GT(turned(fans, guide.phi), 0);
    CrossingGuard guard(fans, guide.beside.mesh);
    turn_back(fans, guide, guard);
    EXPECT_EQ(turned(fans, guide.phi), 0);
    const Quality q = measure(to_mesh(fans), guide);
    EXPECT_EQ(q.euler_characteristic, 2);
    EXPECT_EQ(q.bad_edges + q.bad_points + q.crossing_triangles, 0);
}

TEST(TurnBack, nothing_changes_where_nothing_is_turned_over) {
    const Shape shape = torus(4, 1.5, 0.25);
    const Guide guide{.phi = shape.field()};
    Fans fans = fans_of(shape, 0.6);
    const Fans before = fans;
    CrossingGuard guard(fans, guide.beside.mesh);
    turn_back(fans, guide, guard);
    EXPECT_EQ(fans.points, before.points);
    EXPECT_EQ(fans.triangles, before.triangles);
}

}  // namespace
}  // namespace myotet::surface
