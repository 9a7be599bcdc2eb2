// SPDX-License-Identifier: Apache-2.0
#include "Core/TetMesh.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"

using namespace myotet;

namespace {

// Sums of a few numbers near 1.
constexpr double kRounding = 1e-12;

// The unit cube in six tetrahedra around its diagonal (Kuhn), all positive.
TetMesh cube() {
    TetMesh m;
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) m.points.emplace_back(i, j, k);
    m.tets = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    m.labels.assign(6, 5);
    return m;
}

}  // namespace

TEST(TetMesh, VolumeAndCentroidOfACube) {
    const TetMesh m = cube();
    for (const Tet& t : m.tets)
        EXPECT_NEAR(signed_volume(m.points[t[0]], m.points[t[1]], m.points[t[2]], m.points[t[3]]),
                    1.0 / 6, kRounding);
    EXPECT_NEAR(volume(m), 1, kRounding);
    EXPECT_LT((centroid(m) - Vec3::Constant(0.5)).norm(), kRounding);
}

TEST(TetMesh, BoundaryIsClosedOutwardAndHoldsTheSameVolume) {
    const TetMesh m = cube();
    const std::vector<Triangle> faces = boundary_faces(m.tets);
    EXPECT_EQ(faces.size(), 12u);
    const TriMesh surface = boundary_surface(m);
    EXPECT_EQ(surface.points.size(), 8u);
    EXPECT_NEAR(volume(surface), 1, kRounding);
    for (const Triangle& f : surface.triangles) {
        const Vec3 &a = surface.points[f[0]], &b = surface.points[f[1]], &c = surface.points[f[2]];
        EXPECT_GT((b - a).cross(c - a).dot((a + b + c) / 3 - Vec3::Constant(0.5)), 0);
    }
}

TEST(TetMesh, NeighboursAreMutualAndShareTheFace) {
    const TetMesh m = cube();
    const std::vector<Tet> neighbours = face_neighbours(m.tets);
    int inner = 0;
    for (std::int32_t t = 0; t < 6; ++t)
        for (int f = 0; f < 4; ++f) {
            const std::int32_t other = neighbours[t][f];
            if (other < 0) continue;
            ++inner;
            int back = 0;
            for (const std::int32_t n : neighbours[other]) back += n == t;
            EXPECT_EQ(back, 1);
        }
    EXPECT_EQ(inner, 12);  // six inner faces, seen from both sides
}

TEST(TetMesh, ComponentsAreCountedAndNumberedFromTheFirst) {
    TetMesh two = cube();
    TetMesh moved = cube();
    for (Vec3& p : moved.points) p.x() += 3;
    append(two, moved);
    EXPECT_EQ(two.labels.size(), 12u);
    std::vector<std::int32_t> component;
    EXPECT_EQ(count_components(two.tets, two.points.size(), &component), 2);
    EXPECT_EQ(component.front(), 0);
    EXPECT_EQ(component.back(), 1);
    EXPECT_NEAR(volume(two), 2, kRounding);
}

TEST(TetMesh, ACentroidNeedsAVolume) { EXPECT_THROW((void)centroid(TetMesh{}), MeshError); }
