// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "LevelSet/Extract.h"
#include "LevelSet/Measure.h"
#include "LevelSet/Seams.h"
#include "LevelSet/Soften.h"
#include "Support/AnalyticLevelSet.h"

namespace myotet::levelset {
namespace {

// Samples are floats of up to 20 mm.
constexpr double kRounding = 4e-6;

LevelSet sampled(const std::function<double(const Vec3&)>& distance) {
    return support::sample_level_set(support::cube(12), 1, distance);
}

/// Places and values of all samples that are kept; one of two bricks that differ is
/// a failure.
std::map<std::array<int, 3>, float> samples_of(const LevelSet& phi) {
    std::map<std::array<int, 3>, float> samples;
    constexpr int n = LevelSet::kBrickSamples, m = LevelSet::kBrickCells;
    for (std::size_t b = 0; b < phi.brick_of.size(); ++b) {
        const int at = static_cast<int>(b), bi = at % phi.bricks[0],
                  bj = at / phi.bricks[0] % phi.bricks[1], bk = at / phi.bricks[0] / phi.bricks[1];
        for (int s = 0; s < LevelSet::kBrickSize; ++s) {
            const std::array<int, 3> place{bi * m + s % n, bj * m + s / n % n,
                                           bk * m + s / (n * n)};
            const float value =
                phi.values[static_cast<std::size_t>(phi.brick_of[b]) * LevelSet::kBrickSize + s];
            const auto [it, is_new] = samples.try_emplace(place, value);
            EXPECT_EQ(it->second, value) << "bricks disagree";
        }
    }
    return samples;
}

TEST(Soften, a_plane_stays) {
    const Vec3 n = Vec3(1, 2, -2) / 3;
    LevelSet phi = sampled([&](const Vec3& p) { return n.dot(p) - 0.3; });
    const std::vector<float> before = phi.values;
    soften(phi, {{{.centre = {0.2, 0.1, 0}, .radius = 5}, {.centre = {8, 0, 0}, .radius = 3}}},
           {.steps = 6});
    for (std::size_t i = 0; i < before.size(); ++i)
        ASSERT_NEAR(phi.values[i], before[i], kRounding);
}

TEST(Soften, nothing_changes_outside_the_balls_and_bricks_agree) {
    LevelSet phi = sampled([](const Vec3& p) { return std::sin(2 * p.x() + p.y()) + p.z() / 4; });
    const auto before = samples_of(phi);
    const Spot spot{.centre = {-4, -4.5, -3.5}, .radius = 3.5};  // across eight bricks
    soften(phi, {&spot, 1}, {.steps = 3});
    std::size_t changed = 0;
    for (const auto& [place, value] : samples_of(phi)) {
        const Vec3 p = phi.origin + Vec3(place[0], place[1], place[2]);
        if ((p - spot.centre).norm() >= spot.radius)
            EXPECT_EQ(value, before.at(place));
        else
            changed += value != before.at(place);
    }
    EXPECT_GT(changed, 100u);
}

/// Two balls and a bar between them.
LevelSet dumbbell(double bar) {
    return sampled([bar](const Vec3& p) {
        const double along = std::max(std::abs(p.x()) - 6, 0.0);
        const double off = std::hypot(p.y() - 0.2, p.z() + 0.1);
        return std::min({(p - Vec3(6, 0, 0)).norm() - 4, (p + Vec3(6, 0, 0)).norm() - 4,
                         std::hypot(along, off) - bar});
    });
}

int pieces_of(const LevelSet& phi) {
    const TriMesh mesh = extract_surface(phi);
    std::vector<int> root(mesh.points.size());
    for (std::size_t i = 0; i < root.size(); ++i) root[i] = static_cast<int>(i);
    const std::function<int(int)> find = [&](int i) { return root[i] == i ? i : find(root[i]); };
    for (const Triangle& t : mesh.triangles)
        for (int e = 0; e < 3; ++e) root[find(t[e])] = find(t[(e + 1) % 3]);
    int pieces = 0;
    for (std::size_t i = 0; i < root.size(); ++i) pieces += root[i] == static_cast<int>(i);
    return pieces;
}

TEST(Soften, a_neck_thinner_than_a_sample_parts_and_a_thick_one_stays) {
    const Spot middle{.centre = Vec3::Zero(), .radius = 3};
    for (const double bar : {0.4, 2.5}) {
        LevelSet phi = dumbbell(bar);
        ASSERT_EQ(pieces_of(phi), 1);
        soften(phi, {&middle, 1}, {.steps = 4, .keeps_volume = false});
        EXPECT_EQ(pieces_of(phi), bar < 1 ? 2 : 1) << bar;
    }
}

TEST(Soften, volume_stays) {
    LevelSet phi = dumbbell(0.8);
    const double before = enclosed_volume(phi);
    soften(phi, {{{.centre = {2, 0, 0}, .radius = 3}}}, {.steps = 6});
    // Counted in the ball by samples, here by cells: on a bar as thin as that they
    // differ by some 10 % of its 6 mm^3; smoothing alone would take it away.
    EXPECT_NEAR(enclosed_volume(phi), before, 0.7);
}

TEST(Soften, pieces_in_a_ball_give_way_to_samples_and_others_stay) {
    LevelSet phi = sampled([](const Vec3& p) { return p.z(); });
    Seams seams;
    // Two functions that cross within the cell, the samples their larger one.
    const auto add = [&](const Index3& cell) {
        seams.cell.push_back(cell);
        seams.first.push_back(static_cast<std::uint32_t>(seams.piece.size()));
        for (const float side : {1.0f, -1.0f}) {
            Seams::Corners corners;
            for (int c = 0; c < 8; ++c) corners[c] = side * ((c & 1 ? 1.0f : 0.0f) - 0.5f);
            seams.piece.push_back(corners);
        }
    };
    add({4, 4, 12});
    add({12, 12, 12});
    attach_seams(phi, seams);
    const Vec3 half = Vec3::Constant(0.5);
    const Vec3 in = phi.origin + Vec3(4, 4, 12) + half, out = phi.origin + Vec3(12, 12, 12) + half;
    ASSERT_NEAR(phi.value(in), 0, kRounding);  // the pieces' crossing
    soften(phi, {{{.centre = in, .radius = 2}}}, {.steps = 1});
    EXPECT_NEAR(phi.value(in), 0.5, 0.01) << "z at the cell's centre, from its samples";
    EXPECT_NEAR(phi.value(out), 0, kRounding);
}

}  // namespace
}  // namespace myotet::levelset
