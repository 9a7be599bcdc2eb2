// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "BandShapes.h"
#include "LevelSet/Extract.h"
#include "LevelSet/ExtractTable.h"
#include "LevelSet/Measure.h"
#include "Support/AnalyticLevelSet.h"

namespace myotet::levelset {
namespace {

/// Every edge has two triangles that run along it in opposite directions, and
/// the triangles around every vertex are one fan.
void expect_closed_manifold(const TriMesh& surface) {
    std::map<std::pair<int, int>, int> edges;
    std::map<int, std::map<int, int>> fan;  // around a vertex: from one neighbour to the next
    for (const Triangle& t : surface.triangles)
        for (int e = 0; e < 3; ++e) {
            ++edges[{t[e], t[(e + 1) % 3]}];
            fan[t[e]][t[(e + 1) % 3]] = t[(e + 2) % 3];
        }
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1) << edge.first << " " << edge.second;
        ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
    for (const auto& [vertex, next] : fan) {
        const int start = next.begin()->first;
        std::size_t steps = 1;
        for (int at = next.at(start); at != start; at = next.at(at)) ++steps;
        ASSERT_EQ(steps, next.size()) << "vertex " << vertex;
    }
    ASSERT_EQ(fan.size(), surface.points.size());
}

TEST(Extract, random_samples_give_a_closed_manifold) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 20; ++trial) {
        // From single samples to a checkerboard: every case of the table, and
        // every pair of cases across a face, comes up.
        const double share = 0.05 + 0.9 * trial / 20;
        std::bernoulli_distribution inside(share);
        std::uniform_real_distribution<double> depth(0.05, 1);
        const auto noise = [&](const Vec3& p) {
            const bool border = (p.array().abs() > 7.5).any();
            return depth(random) * (!border && inside(random) ? -1 : 1);
        };
        LevelSet phi = support::sample_level_set(support::cube(8), 1, noise);
        // One value a sample, whichever brick holds it.
        std::map<std::array<int, 3>, float> shared;
        for (std::size_t s = 0; s < phi.values.size(); ++s) {
            const int brick = static_cast<int>(s / LevelSet::kBrickSize), at = s % 729;
            shared.try_emplace(
                {brick % 2 * 8 + at % 9, brick / 2 % 2 * 8 + at / 9 % 9, brick / 4 * 8 + at / 81},
                phi.values[s]);
            phi.values[s] = shared.at(
                {brick % 2 * 8 + at % 9, brick / 2 % 2 * 8 + at / 9 % 9, brick / 4 * 8 + at / 81});
        }
        const TriMesh surface = extract_surface(phi);
        ASSERT_GT(surface.triangles.size(), 100u);
        expect_closed_manifold(surface);
    }
}

TEST(Extract, a_sphere_has_its_place_volume_and_even_triangles) {
    const double radius = 5.3;
    for (const double spacing : {0.5, 0.25}) {
        const LevelSet phi = support::sample_level_set(
            support::cube(8), spacing, [&](const Vec3& p) { return p.norm() - radius; });
        const TriMesh surface = extract_surface(phi);
        expect_closed_manifold(surface);
        // The interpolant errs by spacing^2 / (4 R) at most, a chord by as much.
        const double error = spacing * spacing / radius;
        double worst = 0, sharpest = 180;
        for (const Vec3& p : surface.points) worst = std::max(worst, std::abs(p.norm() - radius));
        EXPECT_LT(worst, error);
        const double ball = 4.0 / 3.0 * M_PI * std::pow(radius, 3);
        EXPECT_NEAR(volume(surface) / ball, 1, 3 * error / radius);
        EXPECT_GT(volume(surface), 0) << "outward";
        for (const Triangle& t : surface.triangles)
            for (int c = 0; c < 3; ++c) {
                const Vec3 a = surface.points[t[(c + 1) % 3]] - surface.points[t[c]];
                const Vec3 b = surface.points[t[(c + 2) % 3]] - surface.points[t[c]];
                sharpest =
                    std::min(sharpest, std::acos(a.normalized().dot(b.normalized())) * 180 / M_PI);
            }
        EXPECT_GT(sharpest, 10);
    }
}

TEST(Extract, nothing_inside_gives_no_triangles) {
    const LevelSet phi =
        support::sample_level_set(support::cube(4), 1, [](const Vec3&) { return 1.0; });
    EXPECT_TRUE(extract_surface(phi).triangles.empty());
}

TEST(ExtractTable, a_cell_and_its_complement_have_the_same_curves) {
    const auto& cuts = cell_cuts();
    std::set<int> loops;
    for (int inside = 0; inside < 256; ++inside) {
        EXPECT_EQ(cuts[inside].loop_of, cuts[255 - inside].loop_of);
        loops.insert(cuts[inside].loops);
        int cut = 0;
        for (int edge = 0; edge < 12; ++edge) {
            const int low = edge_low(edge), high = low | 1 << edge / 4;
            const bool differs = (inside >> low & 1) != (inside >> high & 1);
            EXPECT_EQ(cuts[inside].loop_of[edge] != CellCut::kUncut, differs);
            cut += differs;
        }
        EXPECT_GE(cut, 3 * cuts[inside].loops);
    }
    EXPECT_EQ(loops, (std::set<int>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace myotet::levelset
