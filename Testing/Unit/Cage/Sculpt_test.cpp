// SPDX-License-Identifier: Apache-2.0
#include "Cage/Sculpt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "Cage/Body.h"
#include "Cage/Bombs.h"
#include "Cage/Parts.h"
#include "Core/Errors.h"
#include "Quality/Quality.h"
#include "Support/CageShapes.h"

namespace myotet::cage {
namespace {

using namespace myotet::testing;

Placement turned(double x, double y) {
    Placement p;
    p.rotation = (Eigen::AngleAxisd(x, Vec3::UnitX()) * Eigen::AngleAxisd(y, Vec3::UnitY()))
                     .toRotationMatrix();
    p.shift = Vec3(0.3, 0.6, 0.1);
    return p;
}

TetMesh kept(const Sculpture& s) {
    TetMesh mesh{s.points, {}, {}};
    for (std::size_t t = 0; t < s.tets.size(); ++t)
        if (s.kept[t]) mesh.tets.push_back(s.tets[t]);
    return mesh;
}

// Bombs, by counting faces anew.
std::size_t count_bombs(const Sculpture& s) {
    const std::vector<Tet> neighbours = face_neighbours(kept(s).tets);
    return static_cast<std::size_t>(std::ranges::count_if(
        neighbours, [](const Tet& n) { return std::ranges::count(n, -1) >= 2; }));
}

TEST(SurfaceTree, TellsInsideFromOutside) {
    const SurfaceTree tree(ring(20, 6));
    EXPECT_EQ(tree.winding(Vec3(20, 0, 0)), 1);
    EXPECT_EQ(tree.winding(Vec3(0, 0, 0)), 0) << "in the hole";
    EXPECT_EQ(tree.winding(Vec3(0, 0, 30)), 0);
    const SurfaceTree inverted(turned_inside_out(ring(20, 6)));
    EXPECT_EQ(inverted.winding(Vec3(-20, 0, 0)), -1);
}

TEST(SurfaceTree, FindsTheNearestPointAsASearchThroughAllDoes) {
    const TriMesh surface = banana(30, 12);
    const SurfaceTree tree(surface);
    std::mt19937_64 random(3);
    const auto part = [&] { return 60 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5); };
    for (int k = 0; k < 300; ++k) {
        const Vec3 p(part(), part(), part());
        double least = 1e9;
        for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
            TriMesh one{surface.points, {surface.triangles[t]}};
            least = std::min(least, SurfaceTree(one).nearest(p, 1e9)->distance);
        }
        EXPECT_DOUBLE_EQ(tree.nearest(p, 1e9)->distance, least);
        EXPECT_TRUE(tree.within(p, least * (1 + 1e-12)));
        EXPECT_FALSE(tree.within(p, least * (1 - 1e-12)));
    }
}

TEST(SurfaceTree, MeetsWhatASearchThroughAllMeets) {
    const TriMesh surface = ring(20, 6, 24, 12);
    const SurfaceTree tree(surface);
    std::mt19937_64 random(4);
    const auto part = [&] { return 60 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5); };
    int met = 0;
    for (int k = 0; k < 500; ++k) {
        const Vec3 p(part(), part(), part() / 4);
        const Corners3 t{p, p + Vec3(part(), part(), part()) / 6,
                         p + Vec3(part(), part(), part()) / 6};
        bool any = false;
        for (std::size_t f = 0; f < surface.triangles.size(); ++f)
            any |= triangles_meet(t, tree.corners(static_cast<std::int32_t>(f)));
        EXPECT_EQ(tree.meets(t) >= 0, any);
        met += any;
    }
    EXPECT_GT(met, 50);
    EXPECT_LT(met, 450);
}

// What is kept is what has a point in common with the solid, and nothing else: each way of
// finding that out by itself.
TEST(Sculpt, KeepsExactlyWhatOverlapsTheSolid) {
    const TriMesh surface = ring(20, 6, 20, 8);
    const SurfaceTree tree(surface);
    for (const Placement& placement : {Placement{}, turned(0.4, 1.1)}) {
        const Sculpture s = sculpt(tree, 9, placement);
        for (std::size_t t = 0; t < s.tets.size(); ++t) {
            const Tet& n = s.tets[t];
            const Corners4 c{s.points[n[0]], s.points[n[1]], s.points[n[2]], s.points[n[3]]};
            bool overlaps = tree.winding(0.25 * (c[0] + c[1] + c[2] + c[3])) != 0;
            for (std::size_t f = 0; f < surface.triangles.size() && !overlaps; ++f)
                overlaps = meets(c, tree.corners(static_cast<std::int32_t>(f)));
            EXPECT_EQ(s.kept[t] != 0, overlaps);
        }
    }
}

TEST(Sculpt, LeavesACavityOut) {
    const TriMesh hollow =
        together(block(Vec3::Constant(-20), Vec3::Constant(20)),
                 turned_inside_out(block(Vec3::Constant(-14), Vec3::Constant(14))));
    const SurfaceTree tree(hollow);
    const Sculpture s = sculpt(tree, 5, turned(0.2, 0.3));
    const TetMesh mesh = kept(s);
    EXPECT_EQ(quality::measure_topology(mesh.tets, mesh.points.size()).euler_characteristic, 4)
        << "two spheres";
    EXPECT_LT(volume(mesh), 50. * 50 * 50);
}

TEST(Sculpt, RefusesACellThatIsNone) {
    const SurfaceTree tree(banana(20, 8));
    EXPECT_THROW((void)sculpt(tree, 0, {}), InputError);
    EXPECT_THROW((void)sculpt(tree, std::nan(""), {}), InputError);
}

TEST(Bombs, NoneAreLeftAndTheBoundaryIsASurface) {
    for (const TriMesh& surface : {banana(), ring(20, 6)}) {
        const SurfaceTree tree(surface);
        for (int k = 0; k < 4; ++k) {
            Sculpture s = sculpt(tree, 6.0 + k, turned(0.3 * k, 0.7 * k));
            const std::vector<std::uint8_t> before = s.kept;
            const std::size_t bombs = count_bombs(s), count = s.count();
            EXPECT_EQ(find_bombs(s).size(), bombs);
            const BombSummary summary = defuse(s);
            EXPECT_EQ(static_cast<std::size_t>(summary.bombs), bombs);
            EXPECT_EQ(s.count(), count + static_cast<std::size_t>(summary.added_tets));
            EXPECT_EQ(count_bombs(s), 0u);
            for (std::size_t t = 0; t < before.size(); ++t) EXPECT_LE(before[t], s.kept[t]);
            std::int64_t split = 0;
            const Body body = body_of(s, split);
            EXPECT_TRUE(quality::measure_topology(body.tets, body.points.size()).boundary_manifold);
        }
    }
}

// A small sculpture by hand: a tetrahedron alone is a bomb; a snowflake around one of its nodes
// has 24, of which 23 are put back.
TEST(Bombs, ALoneTetrahedronBecomesASnowflake) {
    Sculpture s = sculpt(SurfaceTree(banana()), 6, {});
    const auto middle = static_cast<std::size_t>(std::ranges::find(s.kept, 1) - s.kept.begin());
    std::ranges::fill(s.kept, 0);
    s.kept[middle] = 1;
    const BombSummary summary = defuse(s);
    EXPECT_EQ(summary.bombs, 1);
    EXPECT_EQ(summary.groups, 1);
    EXPECT_EQ(summary.added_tets, 23);
    EXPECT_EQ(s.count(), 24u);
}

// The fewest: every choice of a snowflake a bomb is tried, for a few bombs taken at random.
TEST(Bombs, AddsTheFewestOfAllChoices) {
    const Sculpture whole = sculpt(SurfaceTree(banana()), 5, {});
    std::vector<std::vector<std::int32_t>> around(whole.points.size());
    for (std::size_t t = 0; t < whole.tets.size(); ++t)
        for (const std::int32_t n : whole.tets[t])
            around[n].push_back(static_cast<std::int32_t>(t));
    std::vector<std::int32_t> inner;
    for (std::size_t t = 0; t < whole.tets.size(); ++t)
        if (whole.kept[t]) inner.push_back(static_cast<std::int32_t>(t));
    std::mt19937_64 random(5);
    for (int k = 0; k < 40; ++k) {
        Sculpture s = whole;
        std::ranges::fill(s.kept, 0);
        const std::int32_t seed = inner[random() % inner.size()];
        std::vector<std::int32_t> near{seed};
        for (const std::int32_t n : whole.tets[seed])
            near.insert(near.end(), around[n].begin(), around[n].end());
        for (int bomb = 0; bomb < 5; ++bomb) s.kept[near[random() % near.size()]] = 1;
        const std::vector<std::int32_t> bombs = find_bombs(s);
        std::size_t fewest = whole.tets.size();
        for (int choice = 0; choice < 1 << (2 * bombs.size()); ++choice) {
            std::vector<std::uint8_t> added = s.kept;
            for (std::size_t b = 0; b < bombs.size(); ++b)
                for (const std::int32_t t : around[s.tets[bombs[b]][(choice >> (2 * b)) & 3]])
                    added[t] = 1;
            fewest = std::min(fewest, static_cast<std::size_t>(std::ranges::count(added, 1)));
        }
        const std::size_t before = s.count();
        const BombSummary summary = defuse(s);
        // Pinched places come on top of bombs.
        if (summary.pinched == 0) {
            EXPECT_EQ(before + static_cast<std::size_t>(summary.added_tets), fewest);
        }
        EXPECT_EQ(summary.greedy, 0);
        EXPECT_EQ(count_bombs(s), 0u);
    }
}

TEST(Body, PartsThatTouchInANodeArePutAsunder) {
    Sculpture s = sculpt(SurfaceTree(banana()), 6, {});
    // Two tetrahedra with one node in common.
    std::ranges::fill(s.kept, 0);
    s.kept[0] = 1;
    for (std::size_t t = 1; t < s.tets.size(); ++t) {
        std::size_t shared = 0;
        for (const std::int32_t n : s.tets[t])
            shared += static_cast<std::size_t>(std::ranges::count(s.tets[0], n));
        if (shared != 1) continue;
        s.kept[t] = 1;
        break;
    }
    std::int64_t split = 0;
    const Body body = body_of(s, split);
    EXPECT_EQ(split, 1);
    EXPECT_EQ(body.points.size(), 8u);
    EXPECT_EQ(count_components(body.tets, body.points.size()), 2);
}

}  // namespace
}  // namespace myotet::cage
