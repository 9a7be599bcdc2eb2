// SPDX-License-Identifier: Apache-2.0
#include "Quality/Quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace myotet;
using namespace myotet::quality;

namespace {

// A handful of roundings of numbers near 100.
constexpr double kRounding = 1e-9;

const Vec3 kRegular[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

TetMesh regular() {
    TetMesh m;
    m.points.assign(kRegular, kRegular + 4);
    m.tets = {{0, 1, 2, 3}};
    if (volume(m) < 0) m.tets = {{0, 1, 3, 2}};
    return m;
}

// Two regular tetrahedra glued at a face, an edge or a node.
TetMesh glued(int shared) {
    TetMesh m = regular();
    const Tet first = m.tets[0];
    Tet second = first;
    for (int i = shared; i < 4; ++i) {
        second[i] = static_cast<std::int32_t>(m.points.size());
        m.points.push_back(-5.0 / 3 * m.points[first[i]]);  // mirrored at the face opposite i
    }
    if (signed_volume(m.points[second[0]], m.points[second[1]], m.points[second[2]],
                      m.points[second[3]]) < 0)
        std::swap(second[0], second[1]);
    m.tets.push_back(second);
    return m;
}

}  // namespace

TEST(Shape, RegularTetrahedron) {
    const TetMesh m = regular();
    const Tet& t = m.tets[0];
    const Shape s = measure(m.points[t[0]], m.points[t[1]], m.points[t[2]], m.points[t[3]]);
    const double angle = std::acos(1.0 / 3) * 180 / std::numbers::pi;
    EXPECT_NEAR(s.min_dihedral_deg, angle, kRounding);
    EXPECT_NEAR(s.max_dihedral_deg, angle, kRounding);
    EXPECT_NEAR(s.aspect_ratio, std::sqrt(1.5), kRounding);
    EXPECT_NEAR(s.volume, 8.0 / 3, kRounding);
}

TEST(Shape, CornerOfACube) {
    // Three right angles; the others are atan(sqrt(2)); the longest edge is
    // sqrt(2), the shortest altitude 1 / sqrt(3).
    const Shape s = measure({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    EXPECT_NEAR(s.max_dihedral_deg, 90, kRounding);
    EXPECT_NEAR(s.min_dihedral_deg, std::atan(std::sqrt(2.0)) * 180 / std::numbers::pi, kRounding);
    EXPECT_NEAR(s.aspect_ratio, std::sqrt(6.0), kRounding);
}

TEST(Shape, InvertedAndNotANumberAreCounted) {
    TetMesh m = regular();
    std::swap(m.tets[0][0], m.tets[0][1]);
    EXPECT_EQ(measure_shapes(m).inverted_tets, 1);
    EXPECT_EQ(measure_shapes(m).max_aspect_ratio, std::numeric_limits<double>::infinity());
    m = regular();
    m.points[0].x() = std::nan("");
    EXPECT_EQ(measure_shapes(m).inverted_tets, 1);
}

TEST(Topology, OneTetrahedronBreaksTheRuleOfFourBoundaryNodes) {
    const TetMesh m = regular();
    const Topology t = measure_topology(m.tets, m.points.size());
    EXPECT_TRUE(t.boundary_manifold);
    EXPECT_EQ(t.tets_with_four_boundary_nodes, 1);
    EXPECT_EQ(t.euler_characteristic, 2);
    EXPECT_EQ(t.components, 1);
}

TEST(Topology, GluedByAFaceAnEdgeANodeOrNothing) {
    const auto topology = [](int shared) {
        const TetMesh m = glued(shared);
        return measure_topology(m.tets, m.points.size());
    };
    EXPECT_TRUE(topology(3).boundary_manifold);
    EXPECT_EQ(topology(2).non_manifold_edges, 1);
    EXPECT_FALSE(topology(2).boundary_manifold);
    EXPECT_EQ(topology(1).non_manifold_vertices, 1);
    EXPECT_FALSE(topology(1).boundary_manifold);
    EXPECT_EQ(topology(0).components, 2);
    EXPECT_TRUE(topology(0).boundary_manifold);
}

TEST(Topology, InteriorEdgeBetweenBoundaryNodes) {
    // Tetrahedra around one edge: the edge is inside, its ends on the boundary.
    TetMesh m;
    m.points = {{0, 0, -1}, {0, 0, 1}};
    constexpr int ring = 6;
    for (int i = 0; i < ring; ++i) {
        const double a = 2 * std::numbers::pi * i / ring;
        m.points.emplace_back(std::cos(a), std::sin(a), 0);
        m.tets.push_back({0, 1, 2 + i, 2 + (i + 1) % ring});
    }
    const Topology t = measure_topology(m.tets, m.points.size());
    EXPECT_EQ(t.interior_edges_joining_boundary_nodes, 1);
    EXPECT_EQ(t.tets_with_four_boundary_nodes, ring);
}

TEST(Topology, AnEmptyMeshIsNoManifold) { EXPECT_FALSE(measure_topology({}, 0).boundary_manifold); }

TEST(SurfaceDistance, SamplesNodesEdgesAndFaces) {
    const TetMesh m = regular();
    const SurfaceDistance d = surface_distance(m, [](const Vec3& p) { return p.norm(); });
    // 4 nodes at sqrt(3), 6 edge midpoints at 1, 4 face centres at 1 / sqrt(3).
    EXPECT_NEAR(d.max, std::sqrt(3.0), kRounding);
    EXPECT_NEAR(d.mean, (4 * std::sqrt(3.0) + 6 + 4 / std::sqrt(3.0)) / 14, kRounding);
}

TEST(BoundaryEdges, MinMedianMax) {
    TetMesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    m.tets = {{0, 1, 2, 3}};
    const EdgeLengths e = boundary_edge_lengths(m);
    EXPECT_NEAR(e.min, 1, kRounding);
    EXPECT_NEAR(e.max, std::sqrt(2.0), kRounding);
}
