// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "LevelSet/WindingTree.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

// Sums of solid angles of some ten thousand triangles round by less than this.
constexpr double kExact = 1e-9;
// What the expansion of far nodes promises.
constexpr double kExpansion = 0.02;

std::vector<Vec3> random_points(int count, double range, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-range, range);
    std::vector<Vec3> points(count);
    for (Vec3& p : points) p = Vec3(place(random), place(random), place(random));
    return points;
}

double distance_to_torus(double major, double minor, const Vec3& p) {
    return std::hypot(std::hypot(p.x(), p.y()) - major, p.z()) - minor;
}

TEST(WindingTree, a_closed_surface_winds_once_inside_and_not_outside) {
    const WindingTree tree = build_winding_tree(test::torus_surface(10, 4, 80, 40));
    int inside = 0;
    double worst = 0;
    for (const Vec3& p : random_points(2000, 15, 1)) {
        const double d = distance_to_torus(10, 4, p);
        if (std::abs(d) < 0.1) continue;  // the polyhedron's sagitta
        const double expected = d < 0 ? 1 : 0;
        inside += d < 0;
        EXPECT_NEAR(exact_winding_number(tree, p), expected, kExact);
        worst = std::max(worst, std::abs(winding_number(tree, p) - expected));
    }
    EXPECT_LT(worst, kExpansion);
    EXPECT_GT(inside, 100);
}

TEST(WindingTree, the_expansion_stays_near_the_sum_for_open_surfaces) {
    TriMesh surface = test::sphere_surface(Vec3::Zero(), 10, 40);
    surface.triangles.resize(surface.triangles.size() / 2);
    const WindingTree tree = build_winding_tree(surface);
    double worst = 0;
    for (const Vec3& p : random_points(3000, 14, 2))
        worst = std::max(worst, std::abs(winding_number(tree, p) - exact_winding_number(tree, p)));
    EXPECT_LT(worst, kExpansion);
    EXPECT_GT(worst, 0);  // an expansion, not the sum itself
}

TEST(WindingTree, half_a_sphere_winds_half_about_its_centre) {
    TriMesh surface = test::sphere_surface(Vec3::Zero(), 10, 41);
    std::erase_if(surface.triangles, [&](const Triangle& t) {
        return surface.points[t[0]].z() + surface.points[t[1]].z() + surface.points[t[2]].z() < 0;
    });
    EXPECT_NEAR(exact_winding_number(build_winding_tree(surface), Vec3::Zero()), 0.5, kExact);
}

TEST(WindingTree, nothing_winds_around_nothing) {
    EXPECT_EQ(winding_number(build_winding_tree({}), Vec3::Zero()), 0);
    EXPECT_EQ(distance_to_triangles(build_winding_tree({}), Vec3::Zero(), 3), 3);
}

TEST(WindingQueries, distances_are_those_of_the_nearest_place_on_any_triangle) {
    TriMesh surface;
    surface.points = random_points(30, 5, 3);
    for (int n = 0; n < 10; ++n) surface.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    const WindingTree tree = build_winding_tree(surface);
    constexpr int kSteps = 60;  // a raster on each triangle, of sides up to 17 mm
    constexpr double kRaster = 17.0 / kSteps;
    for (const Vec3& p : random_points(60, 8, 4)) {
        double nearest = 1e9;
        for (const Triangle& t : surface.triangles)
            for (int u = 0; u <= kSteps; ++u)
                for (int v = 0; u + v <= kSteps; ++v)
                    nearest = std::min(
                        nearest, (surface.points[t[0]] +
                                  (surface.points[t[1]] - surface.points[t[0]]) * u / kSteps +
                                  (surface.points[t[2]] - surface.points[t[0]]) * v / kSteps - p)
                                     .norm());
        const double d = distance_to_triangles(tree, p, 100);
        EXPECT_LE(d, nearest + kExact);
        EXPECT_GE(d, nearest - kRaster);
        EXPECT_EQ(distance_to_triangles(tree, p, 0.5 * d), 0.5 * d);
    }
}

TEST(WindingQueries, a_mask_leaves_triangles_out) {
    TriMesh surface;
    for (const double z : {0.0, 3.0}) {
        const auto n = static_cast<std::int32_t>(surface.points.size());
        for (const Vec3& p : {Vec3(-5, -5, z), Vec3(5, -5, z), Vec3(0, 5, z)})
            surface.points.push_back(p);
        surface.triangles.push_back({n, n + 1, n + 2});
    }
    const WindingTree tree = build_winding_tree(surface);
    const std::vector<std::uint8_t> upper{0, 1};
    const Vec3 low(0, 0, -1), middle(0, 0, 1), high(0, 0, 5);
    EXPECT_DOUBLE_EQ(distance_to_triangles(tree, low, 10), 1);
    EXPECT_DOUBLE_EQ(distance_to_triangles(tree, low, 10, upper), 4);
    EXPECT_TRUE(crosses_triangle(tree, low, middle));
    EXPECT_FALSE(crosses_triangle(tree, low, middle, upper));
    EXPECT_TRUE(crosses_triangle(tree, middle, high, upper));
    EXPECT_FALSE(crosses_triangle(tree, Vec3(9, 0, -1), Vec3(9, 0, 1)));
}

TEST(WindingQueries, crossing_pairs_are_counted_once_and_neighbours_never) {
    EXPECT_EQ(count_crossing_pairs(build_winding_tree(test::torus_surface(10, 4, 40, 20))), 0);
    TriMesh surface;  // three sheets, each across each other along z
    for (int n = 0; n < 3; ++n) {
        const double angle = n * 1.0471975511965976;
        const Vec3 along(std::cos(angle), std::sin(angle), 0);
        surface.points.insert(surface.points.end(),
                              {-9 * along, 9 * along + 0.1 * n * Vec3::UnitZ(),
                               9 * Vec3::UnitZ() + (0.1 + 0.1 * n) * along});
        surface.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    EXPECT_EQ(count_crossing_pairs(build_winding_tree(surface)), 3);
}

}  // namespace
}  // namespace myotet::levelset
