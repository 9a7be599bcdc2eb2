// SPDX-License-Identifier: Apache-2.0
#include "Surface/MakeSurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "SurfaceShapes.h"

namespace myotet::surface {
namespace {

constexpr double kPi = std::numbers::pi;

Result make(const Shape& shape, const Field& trim, double edge_length, int pieces = 0) {
    SilentProgress silent;
    return make_surface(shape.start, {.phi = shape.field(), .trim = trim},
                        {.edge_length = edge_length, .pieces = pieces}, silent);
}

/// What every mesh keeps.
void expect_good(const Result& r) {
    const Quality& q = r.quality;
    EXPECT_EQ(broken_promises(q), std::vector<std::string>{});
    EXPECT_EQ(shortfalls(q), std::vector<std::string>{});
    EXPECT_EQ(q.inner_edges_joining_boundary_points, 0);
    // Newton ends at 1e-4 of an edge.
    EXPECT_LT(q.points_off, 2e-4 * q.longest_edge);
}

TEST(MakeSurface, a_closed_sphere) {
    const Shape shape = ball(5.3, 0.25);
    const Result r = make(shape, {}, 0.7);
    expect_good(r);
    EXPECT_EQ(r.cut, Cut::none);
    EXPECT_EQ(r.quality.euler_characteristic, 2);
    EXPECT_EQ(r.quality.boundary_loops, 0);
    // Chords of length h fall short of an arc by h^2 / (8 R); areas by twice that over R.
    EXPECT_NEAR(r.quality.area / (4 * kPi * 5.3 * 5.3), 1, 0.7 * 0.7 / (2 * 5.3 * 5.3));
}

TEST(MakeSurface, a_hemisphere) {
    const Shape shape = ball(5.3, 0.25);
    const Result r = make(shape, half_space({0, 0, 0.1}, {0, 0, 1}), 0.7);
    expect_good(r);
    EXPECT_EQ(r.cut, Cut::some);
    EXPECT_EQ(r.quality.euler_characteristic, 1);
    EXPECT_EQ(r.quality.boundary_loops, 1);
    const double circle = 2 * kPi * std::sqrt(5.3 * 5.3 - 0.01);
    EXPECT_NEAR(r.quality.boundary_length / circle, 1, 0.01);
    for (const Vec3& p : r.mesh.points) EXPECT_GT(p[2], 0.1 - 0.007);
}

TEST(MakeSurface, a_sphere_trimmed_by_another) {
    const Shape shape = ball(5.3, 0.25);
    const Result r = make(shape, ball_field({4, 2, 1}, 3), 0.5);
    expect_good(r);
    EXPECT_EQ(r.quality.euler_characteristic, 1);
    EXPECT_EQ(r.quality.boundary_loops, 1);
}

TEST(MakeSurface, an_ellipsoid) {
    const Shape shape = ellipsoid({8, 4, 2.5}, 0.25);
    for (const bool cut : {false, true}) {
        const Result r = make(shape, cut ? half_space({1, 0, 0}, {-1, 0.3, 0.2}) : Field{}, 0.6);
        expect_good(r);
        EXPECT_EQ(r.quality.euler_characteristic, cut ? 1 : 2);
    }
}

TEST(MakeSurface, a_torus_whole_and_cut) {
    const Shape shape = torus(6, 2, 0.25);
    const Result whole = make(shape, {}, 0.5);
    expect_good(whole);
    EXPECT_EQ(whole.quality.euler_characteristic, 0);

    const Result half = make(shape, half_space({0.2, 0, 0}, {1, 0, 0}), 0.5);
    expect_good(half);
    EXPECT_EQ(half.quality.euler_characteristic, 0) << "a tube";
    EXPECT_EQ(half.quality.boundary_loops, 2);

    const Result bagel = make(shape, half_space({0, 0, 0.3}, {0, 0, 1}), 0.5);
    expect_good(bagel);
    EXPECT_EQ(bagel.quality.euler_characteristic, 0) << "an annulus";
    EXPECT_EQ(bagel.quality.boundary_loops, 2);
}

TEST(MakeSurface, a_hollow_shell) {
    const Shape shape = hollow_shell(5, 3, 0.25);
    const Result whole = make(shape, {}, 0.6);
    expect_good(whole);
    EXPECT_EQ(whole.quality.euler_characteristic, 4);
    EXPECT_EQ(whole.quality.pieces, 2);
    const Field trim = half_space({0, 0, 0}, {0, 0.6, 0.8});
    const Result halves = make(shape, trim, 0.6);
    expect_good(halves);
    EXPECT_EQ(halves.quality.euler_characteristic, 2);
    EXPECT_EQ(halves.quality.boundary_loops, 2);
    EXPECT_EQ(halves.quality.pieces, 2);
    const Result outer = make(shape, trim, 0.6, 1);
    expect_good(outer);
    EXPECT_EQ(outer.quality.pieces, 1);
    EXPECT_NEAR(outer.quality.area / (2 * kPi * 25), 1, 0.02);
}

TEST(MakeSurface, trims_that_discard_everything_or_nothing_are_said) {
    const Shape shape = ball(3, 0.25);
    const Result all = make(shape, half_space({0, 0, 9}, {0, 0, 1}), 0.6);
    EXPECT_EQ(all.cut, Cut::everything);
    EXPECT_TRUE(all.mesh.triangles.empty());
    const Result none = make(shape, half_space({0, 0, -9}, {0, 0, 1}), 0.6);
    EXPECT_EQ(none.cut, Cut::none);
    EXPECT_EQ(none.quality.euler_characteristic, 2);
}

TEST(MakeSurface, one_thread_and_many_give_the_same_bytes) {
    const Shape shape = ellipsoid({6, 4, 3}, 0.3);
    std::vector<TriMesh> meshes;
    for (const int threads : {1, 4}) {
        const ThreadLimit limit(threads);
        meshes.push_back(make(shape, half_space({0, 0, 0}, {1, 2, 3}), 0.7).mesh);
    }
    EXPECT_EQ(meshes[0].triangles, meshes[1].triangles);
    EXPECT_EQ(meshes[0].points, meshes[1].points);
}

TEST(MakeSurface, options_and_starts_are_checked) {
    const Shape shape = ball(3, 0.5);
    EXPECT_THROW(make(shape, {}, 0), InputError);
    EXPECT_THROW(make(shape, {}, NAN), InputError);
    Shape open = shape;
    open.start.triangles.pop_back();
    EXPECT_THROW(make(open, {}, 1), InputError);
    open.start.triangles.clear();
    EXPECT_THROW(make(open, {}, 1), InputError);
}

}  // namespace
}  // namespace myotet::surface
