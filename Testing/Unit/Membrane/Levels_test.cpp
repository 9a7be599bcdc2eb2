// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Levels.h"

#include <gtest/gtest.h>

#include <numeric>

#include "Core/Errors.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

namespace {

// Sums of some ten weights.
constexpr double kRounding = 1e-14;

// A disc of `valence` triangles about the origin, and two rings more, to radius 9.
TriMesh disc(int valence) {
    TriMesh mesh{{Vec3::Zero()}, {}};
    for (int ring = 1; ring <= 3; ++ring)
        for (int i = 0; i < valence; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.5 * ring) / valence;
            const double radius = std::pow(3, ring - 1);
            mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
        }
    const auto at = [&](int ring, int i) { return 1 + (ring - 1) * valence + (i % valence); };
    for (int i = 0; i < valence; ++i) {
        mesh.triangles.push_back({0, at(1, i), at(1, i + 1)});
        for (int ring = 1; ring < 3; ++ring) {
            mesh.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring, i + 1)});
            mesh.triangles.push_back({at(ring, i + 1), at(ring + 1, i), at(ring + 1, i + 1)});
        }
    }
    return mesh;
}

double worst_sum(const HalfEdges& mesh) {
    double worst = 0;
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
        const Stencil s = midpoint_stencil(mesh, static_cast<std::int32_t>(e));
        worst =
            std::max(worst, std::abs(std::accumulate(s.weights.begin(), s.weights.end(), -1.0)));
    }
    return worst;
}

// Largest distance of refined points from the sphere.
double off_sphere(const TriMesh& coarse, double radius) {
    double off = 0;
    for (const Vec3& p : make_levels(coarse, 1).rest)
        off = std::max(off, std::abs(p.norm() - radius));
    return off;
}

}  // namespace

TEST(Butterfly, NeighboursOfEveryValenceWeighAQuarter) {
    for (int valence = 3; valence <= 20; ++valence) {
        const auto w = neighbour_weights(valence);
        EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0), 0.25, kRounding) << valence;
    }
}

TEST(Butterfly, WeightsSumToOneAndAPlaneStaysAPlane) {
    for (const int valence : {3, 4, 5, 6, 7, 8, 11}) {
        TriMesh mesh = disc(valence);
        EXPECT_LT(worst_sum(make_half_edges(mesh.triangles, 3 * valence + 1)), kRounding);
        for (Vec3& p : mesh.points) p.z() = 0.3 * p.x() - 0.2 * p.y() + 1;
        for (const Vec3& p : make_levels(mesh, 3).rest)
            EXPECT_NEAR(p.z(), 0.3 * p.x() - 0.2 * p.y() + 1, 1e-13) << valence;
    }
}

TEST(Butterfly, RegularRuleIsThePapers) {
    const TriMesh mesh = sheet(6, 6, 1);
    const HalfEdges half =
        make_half_edges(mesh.triangles, static_cast<std::int32_t>(mesh.points.size()));
    for (std::size_t e = 0; e < half.edges.size(); ++e) {
        const std::int32_t a = half.from(half.edges[e]), b = half.to(half.edges[e]);
        if (std::min(a, b) != 24 || std::max(a, b) != 25) continue;  // in the middle
        Stencil s = midpoint_stencil(half, static_cast<std::int32_t>(e));
        std::sort(s.weights.begin(), s.weights.end());
        EXPECT_EQ(s.weights, (std::vector<double>{-0.0625, -0.0625, -0.0625, -0.0625, 0.125, 0.125,
                                                  0.5, 0.5}));
        return;
    }
    FAIL() << "no such edge";
}

TEST(Butterfly, EdgeBetweenTwoExtraordinaryVerticesTakesTheirMean) {
    const TriMesh mesh = ico_sphere(1, 0);  // all of valence 5
    const HalfEdges half = make_half_edges(mesh.triangles, 12);
    EXPECT_LT(worst_sum(half), kRounding);
    const Stencil s = midpoint_stencil(half, 0);
    const auto w = neighbour_weights(5);
    EXPECT_NEAR(s.weights[0], 0.5 * (0.75 + w[0]), kRounding);
}

TEST(Butterfly, RimIsASmoothCurveOfItsOwn) {
    TriMesh mesh = disc(12);
    const Levels levels = make_levels(mesh, 1);
    const HalfEdges& half = levels.meshes[0];
    for (std::size_t e = 0; e < half.edges.size(); ++e)
        if (half.twin[half.edges[e]] < 0) {
            // Four points of a circle of twelve: (9 cos 15 - cos 45) / 8 of its radius.
            const double deg = std::numbers::pi / 180;
            EXPECT_NEAR(levels.rest[37 + e].norm(),
                        9 * (9 * std::cos(15 * deg) - std::cos(45 * deg)) / 8, 1e-13);
        }
}

// Where the mesh is not regular, as across the icosahedron's edges, the scheme reproduces
// planes, so midpoints are off by h^2; a chord's middle is off by h^2 / 8.
TEST(Butterfly, RefinedSphereApproachesTheSphere) {
    std::array<double, 4> off{};
    for (int k = 0; k < 4; ++k) off[k] = off_sphere(ico_sphere(1, k + 1), 1);
    EXPECT_GT(std::log2(off[2] / off[3]), 1.9)
        << off[0] << " " << off[1] << " " << off[2] << " " << off[3];
    EXPECT_LT(off[3], 1e-3);
}

TEST(Levels, SphereOfThePaperIsFourTimesAsFine) {
    const Levels levels = make_levels(even_sphere(50, 114), 2);
    EXPECT_EQ(levels.meshes[0].edges.size(), 336U);
    EXPECT_EQ(levels.meshes[1].vertex_count, 450);
    EXPECT_EQ(levels.meshes[1].edges.size(), 1344U);
    EXPECT_EQ(levels.meshes[2].triangles.size(), 16 * 224U);
    EXPECT_TRUE(levels.meshes[2].closed());
}

TEST(Levels, RefusesWhatIsNoManifold) {
    TriMesh three{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                  {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    EXPECT_THROW((void)make_levels(three, 1), InputError);
    three.triangles = {{0, 1, 2}, {0, 1, 3}};  // face opposite ways
    EXPECT_THROW((void)make_levels(three, 1), InputError);
    three.triangles = {{0, 1, 2}, {0, 3, 4}};  // touch in a point
    EXPECT_THROW((void)make_levels(three, 1), InputError);
    three.triangles = {{0, 1, 2}};  // points without triangles
    EXPECT_THROW((void)make_levels(three, 1), InputError);
    EXPECT_THROW((void)make_levels({}, 1), InputError);
    EXPECT_THROW((void)make_levels(ico_sphere(1, 0), 30), InputError);
    EXPECT_THROW((void)make_levels(ico_sphere(1, 0), -1), InputError);
}

TEST(Levels, RefusesASurfaceThatCrossesItself) {
    TriMesh mesh = ico_sphere(1, 1), other = mesh;
    for (Vec3& p : other.points) p += Vec3(1.13, 0.21, 0.07);
    const auto shift = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const auto& [a, b, c] : other.triangles)
        mesh.triangles.push_back({a + shift, b + shift, c + shift});
    EXPECT_THROW((void)make_levels(mesh, 1), InputError);
    mesh.points[3].x() = std::nan("");
    EXPECT_THROW((void)make_levels(mesh, 1), InputError);
}
