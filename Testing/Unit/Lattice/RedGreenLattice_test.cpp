// SPDX-License-Identifier: Apache-2.0
#include "Lattice/RedGreenLattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Lattice/Patterns.h"
#include "Quality/Quality.h"

using namespace myotet;
using namespace myotet::lattice;

namespace {

// Coordinates are exact dyadic numbers times one rounding; volumes of cells of
// size 1 carry a few roundings each.
constexpr double kRounding = 1e-12;

double sphere(const Vec3& p) { return p.norm() - 1; }

Box unit_box(double half) {
    Box b;
    b.include(Vec3::Constant(-half));
    b.include(Vec3::Constant(half));
    return b;
}

TetMesh as_mesh(const RedGreenLattice& lattice) {
    TetMesh mesh;
    mesh.tets = lattice.mesh().tets;
    for (std::size_t i = 0; i < lattice.node_count(); ++i)
        mesh.points.push_back(lattice.position(static_cast<std::int32_t>(i)));
    return mesh;
}

// Refines, level by level, whatever the sphere's surface may cut.
void refine_surface(RedGreenLattice& lattice) {
    for (int level = 0; level < lattice.max_level(); ++level) {
        std::vector<Verdict> verdicts;
        for (const Tet& t : lattice.tets(level)) {
            float nearest = 1e9f;
            for (const std::int32_t n : t)
                nearest = std::min(nearest, std::abs(lattice.values()[n]));
            verdicts.push_back(nearest < 0.6 * lattice.edge_length(level) ? Verdict::refine
                                                                          : Verdict::keep);
        }
        lattice.apply(level, verdicts);
    }
    lattice.close();
}

// Every face belongs to two tetrahedra, or to one on the hull of the cover; a
// T-junction would leave single faces inside, so the boundary of a conforming
// cover has exactly the cover's volume and no single face inside it.
void expect_conforming(const TetMesh& mesh) {
    std::map<Triangle, int> uses;
    for (const Tet& t : mesh.tets)
        for (int skip = 0; skip < 4; ++skip) {
            Triangle f;
            for (int i = 0, k = 0; i < 4; ++i)
                if (i != skip) f[k++] = t[i];
            std::sort(f.begin(), f.end());
            ++uses[f];
        }
    Box hull;
    for (const Vec3& p : mesh.points) hull.include(p);
    for (const auto& [f, count] : uses) {
        ASSERT_LE(count, 2);
        if (count == 2) continue;
        const Vec3 c = (mesh.points[f[0]] + mesh.points[f[1]] + mesh.points[f[2]]) / 3;
        // The cover's hull is rough by one cell of the coarsest level.
        const double inside = std::min((c - hull.min).minCoeff(), (hull.max - c).minCoeff());
        ASSERT_LT(inside, 0.51) << "a face inside with one tetrahedron: T-junction";
    }
}

}  // namespace

TEST(Patterns, OnlyTheAllowedOnesAreClosed) {
    int allowed = 0;
    for (unsigned p = 0; p < 64; ++p) {
        const unsigned c = closed_pattern(p);
        EXPECT_EQ(c & p, p) << "closing never removes a midpoint";
        EXPECT_EQ(closed_pattern(c), c);
        if (c == p) ++allowed;
    }
    // Nothing, 6 single edges, 3 opposite pairs, 4 faces, red.
    EXPECT_EQ(allowed, 1 + 6 + 3 + 4 + 1);
}

TEST(Patterns, ChildrenFillTheParentPositively) {
    const std::vector<Vec3> x = {{0, 0, 0}, {2, 0, 0}, {1, 1, -1}, {1, 1, 1}};
    std::vector<Vec3> points = x;
    std::array<std::int32_t, 6> mids;
    for (int e = 0; e < 6; ++e) {
        mids[e] = static_cast<std::int32_t>(points.size());
        points.push_back(0.5 * (x[kEdge[e][0]] + x[kEdge[e][1]]));
    }
    const Tet parent{0, 1, 2, 3};
    const double whole = signed_volume(x[0], x[1], x[2], x[3]);
    ASSERT_GT(whole, 0);
    for (unsigned p = 1; p < 64; ++p) {
        if (closed_pattern(p) != p) continue;
        std::vector<Tet> children;
        if (p == kAllEdges)
            for (const Tet& c : red_children(parent, mids)) children.push_back(c);
        else
            append_green_children(parent, p, mids, children);
        double sum = 0;
        for (const Tet& c : children) {
            const double v = signed_volume(points[c[0]], points[c[1]], points[c[2]], points[c[3]]);
            EXPECT_GT(v, 0) << "pattern " << p;
            sum += v;
        }
        EXPECT_NEAR(sum, whole, kRounding) << "pattern " << p;
        EXPECT_EQ(children.size(), p == kAllEdges ? 8u : std::popcount(p) == 1 ? 2u : 4u);
    }
}

TEST(RedGreenLattice, UnrefinedTetrahedraAreAllTheBccShape) {
    const RedGreenLattice lattice(unit_box(1.5), 0.5, 0, 1e9, sphere);
    const TetMesh mesh = as_mesh(lattice);
    ASSERT_GT(mesh.tets.size(), 100u);
    for (const Tet& t : mesh.tets) {
        const quality::Shape s = quality::measure(mesh.points[t[0]], mesh.points[t[1]],
                                                  mesh.points[t[2]], mesh.points[t[3]]);
        EXPECT_NEAR(s.volume, 0.125 / 12, kRounding);
        EXPECT_NEAR(s.aspect_ratio, std::sqrt(2.0), 1e-9);
        EXPECT_NEAR(s.min_dihedral_deg, 60, 1e-9);
        EXPECT_NEAR(s.max_dihedral_deg, 90, 1e-9);
    }
    expect_conforming(mesh);
}

TEST(RedGreenLattice, RedChildrenKeepTheShapeAndTheOrder) {
    RedGreenLattice lattice(unit_box(1), 1, 3, 1e9, sphere);
    for (int level = 0; level < 3; ++level)
        lattice.apply(level, std::vector<Verdict>(lattice.tets(level).size(), Verdict::refine));
    for (int level = 0; level <= 3; ++level)
        for (const Tet& t : lattice.tets(level)) {
            const double a = lattice.edge_length(level);
            const auto length = [&](int i, int j) {
                return (lattice.position(t[i]) - lattice.position(t[j])).norm();
            };
            ASSERT_NEAR(length(0, 1), a, kRounding);
            ASSERT_NEAR(length(2, 3), a, kRounding);
            ASSERT_NEAR(length(0, 2), std::sqrt(0.75) * a, kRounding);
            ASSERT_GT(signed_volume(lattice.position(t[0]), lattice.position(t[1]),
                                    lattice.position(t[2]), lattice.position(t[3])),
                      0);
        }
}

TEST(RedGreenLattice, RefinedMeshConformsAndGreensAreNoWorseThanThePaperSays) {
    RedGreenLattice lattice(unit_box(1.5), 0.5, 3, 1e9, sphere);
    const double before = volume(as_mesh(lattice));
    refine_surface(lattice);
    const TetMesh mesh = as_mesh(lattice);
    EXPECT_NEAR(volume(mesh), before, 1e-9);
    expect_conforming(mesh);
    const quality::ShapeSummary s = quality::measure_shapes(mesh);
    EXPECT_EQ(s.inverted_tets, 0);
    // [Teran05, sec. 9]: the worst green child scores about 3.5.
    EXPECT_LT(s.max_aspect_ratio, 3.6);
    EXPECT_GT(s.max_aspect_ratio, std::sqrt(2.0) + 0.1) << "no green tetrahedron was made";
}

TEST(RedGreenLattice, RefiningOneCornerCascadesUntilItConforms) {
    RedGreenLattice lattice(unit_box(1.5), 0.5, 5, 1e9, sphere);
    RedTet deepest{0, 0};
    for (int level = 0; level < 5; ++level) {
        const RedTet one[] = {deepest};
        ASSERT_EQ(lattice.refine(one), 1u);
        deepest = {level + 1, 0};
    }
    EXPECT_GT(lattice.close(), 0u);
    EXPECT_EQ(lattice.close(), 0u);
    expect_conforming(as_mesh(lattice));
}

// A shrunken case: scattered deep refinement in rounds, so that a coarse
// neighbour has to notice edges bisected two levels below its own.
TEST(RedGreenLattice, ScatteredRefinementInRoundsConforms) {
    RedGreenLattice lattice(unit_box(1.5), 0.5, 5, 1e9, sphere);
    std::uint32_t state = 12345;
    for (int round = 0; round < 12; ++round) {
        std::vector<RedTet> some;
        const std::vector<RedTet> reds = lattice.mesh().red;
        for (int i = 0; i < 6; ++i) {
            state = state * 1664525u + 1013904223u;
            // The later half of the list holds the finer tetrahedra.
            some.push_back(reds[reds.size() / 2 + (state >> 8) % (reds.size() / 2)]);
        }
        lattice.refine(some);
        lattice.close();
        ASSERT_EQ(lattice.close(), 0u);
    }
    expect_conforming(as_mesh(lattice));
}

TEST(RedGreenLattice, SameBytesOnOneThreadOrMany) {
    const auto build = [](int threads) {
        const ThreadLimit limit(threads);
        RedGreenLattice lattice(unit_box(1.5), 0.4, 2, 1.0, sphere);
        refine_surface(lattice);
        return lattice.mesh().tets;
    };
    EXPECT_EQ(build(1), build(0));
}

TEST(RedGreenLattice, RefusesAnEdgeThatIsNotPositiveOrFarTooFine) {
    EXPECT_THROW(RedGreenLattice(unit_box(1), 0, 0, 1, sphere), InputError);
    EXPECT_THROW(RedGreenLattice(unit_box(1), std::nan(""), 0, 1, sphere), InputError);
    EXPECT_THROW(RedGreenLattice(unit_box(1), 1e-9, 0, 1, sphere), ResourceError);
}
