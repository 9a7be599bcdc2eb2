// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Overlaps.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Membrane/Levels.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

TEST(Overlaps, NeighboursInAPlaneDoNotOverlap) {
    EXPECT_FALSE(overlap_in_plane(sheet(8, 8, 5)));
    EXPECT_FALSE(overlap_in_plane(even_sphere(50, 60)));
    const TriMesh box{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 2}},
                      {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    EXPECT_FALSE(overlap_in_plane(box));
}

TEST(Overlaps, FoldedFlatIsFound) {
    const TriMesh folded{{{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {2, 2, 0}}, {{0, 1, 2}, {1, 0, 3}}};
    ASSERT_TRUE(overlap_in_plane(folded));
    EXPECT_EQ(*overlap_in_plane(folded), (std::array<std::int32_t, 2>{0, 1}));
    EXPECT_THROW((void)make_levels(folded, 1), InputError);
}

// A sheet that lies on itself a quarter of a triangle aside, in a slanting plane.
TEST(Overlaps, ASheetThatLiesOnAnotherIsFound) {
    TriMesh mesh = sheet(3, 3, 5);
    const auto count = static_cast<std::int32_t>(mesh.points.size());
    const TriMesh once = mesh;
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (const Vec3& p : once.points) mesh.points.push_back(p + Vec3(1.3, 0.4, 0));
    for (const auto& [a, b, c] : once.triangles)
        mesh.triangles.push_back({a + count, b + count, c + count});
    for (Vec3& p : mesh.points) p = turn * p;
    EXPECT_TRUE(overlap_in_plane(mesh));
    EXPECT_THROW((void)make_levels(mesh, 0), InputError);
    for (std::int32_t v = count; v < 2 * count; ++v) mesh.points[v] += turn * Vec3(0, 0, 1e-3);
    EXPECT_FALSE(overlap_in_plane(mesh));
    EXPECT_NO_THROW((void)make_levels(mesh, 0));
}
