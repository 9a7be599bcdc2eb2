// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Active.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>

#include "Membrane/Switch.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

namespace {

// Sums of some thousand masses.
constexpr double kRounding = 1e-13;

double total(const std::vector<double>& mass) {
    return std::accumulate(mass.begin(), mass.end(), 0.0);
}

// Whether every edge of what is drawn has two triangles that face one way.
bool without_cracks(const std::vector<Triangle>& drawn) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
    for (const auto& t : drawn)
        for (int i = 0; i < 3; ++i) ++sides[{t[i], t[(i + 1) % 3]}];
    return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
        const auto back = sides.find({side.first.second, side.first.first});
        return side.second == 1 && back != sides.end();
    });
}

void expect_balanced(const Levels& levels, const Selection& selection) {
    for (int l = 1; l < levels.finest(); ++l)
        for (std::size_t h = 0; h < levels.meshes[l].twin.size(); ++h) {
            const auto f = static_cast<std::int32_t>(h / 3), other = levels.meshes[l].twin[h] / 3;
            const bool refined = selection.exists(l, f) && selection.is_refined(l, f);
            ASSERT_TRUE(!refined || selection.exists(l, other));
        }
}

}  // namespace

TEST(Active, MassIsKeptAndNothingCracksAtAnySwitch) {
    const Levels levels = make_levels(even_sphere(50, 60), 3);
    const auto properties = level_properties(levels, {});
    const double mass = area(levels.surface(0)) * 3 * 1.05e-9;
    Selection selection(levels);
    std::mt19937 random(7);
    std::array<std::int32_t, 4> types{};
    for (int round = 0; round < 300; ++round) {
        const int level = static_cast<int>(random() % 3);
        const auto f = static_cast<std::int32_t>(random() % levels.meshes[level].triangles.size());
        if (!selection.exists(level, f)) continue;
        if (random() % 3 == 0)
            (void)simplify(levels, selection, level, f);
        else
            refine(levels, selection, level, f);
        expect_balanced(levels, selection);
        const Active active = make_active(levels, selection, properties);
        ASSERT_NEAR(total(active.mass) / mass, 1, kRounding);
        ASSERT_NEAR(total(active.inertia) / mass, 1, kRounding);
        ASSERT_TRUE(without_cracks(active.drawn));
        for (int k = 0; k < 4; ++k) types[k] += active.types[k];
    }
    for (const std::int32_t count : types) EXPECT_GT(count, 0);
}

TEST(Active, WhollyRefinedHasThePapersCounts) {
    const Levels levels = make_levels(even_sphere(50, 114), 1);
    const auto properties = level_properties(levels, {});
    const Active coarse = make_active(levels, Selection(levels), properties);
    const Active fine = make_active(levels, wholly_refined(levels, 1), properties);
    EXPECT_EQ(coarse.nodes.size(), 114U);
    EXPECT_EQ(coarse.springs.size(), 336U);
    EXPECT_EQ(fine.nodes.size(), 450U);
    EXPECT_EQ(fine.springs.size(), 1344U);
    EXPECT_TRUE(fine.hanging.empty());
    for (const std::int32_t v : fine.nodes)  // [Choi05, eq. 6]
        EXPECT_NEAR(fine.mass[v] / coarse.mass[0], 114.0 / 450, kRounding);
}

TEST(Active, SimplifyingEverythingGivesBackTheStart) {
    const Levels levels = make_levels(ico_sphere(50, 1), 2);
    Selection selection = wholly_refined(levels, 2);
    for (int level = 1; level >= 0; --level)
        for (std::size_t f = 0; f < levels.meshes[level].triangles.size(); ++f)
            EXPECT_TRUE(simplify(levels, selection, level, static_cast<std::int32_t>(f)));
    const auto active = make_active(levels, selection, level_properties(levels, {}));
    EXPECT_EQ(active.nodes.size(), 42U);
    EXPECT_FALSE(simplify(levels, selection, 0, 0));
}

TEST(Active, StiffnessFollowsTheRuleChosen) {
    const Levels levels = make_levels(even_sphere(50, 114), 1);
    Wall wall;
    EXPECT_EQ(level_properties(levels, wall)[1].stiffness,
              level_properties(levels, wall)[0].stiffness);
    wall.stiffening = Stiffening::by_mass;
    const auto p = level_properties(levels, wall);
    EXPECT_NEAR(p[1].stiffness / p[0].stiffness, 2 * 114.0 / 450, kRounding);  // [Choi05, eq. 8]
    EXPECT_NEAR(p[1].damping / p[0].damping, p[1].stiffness / p[0].stiffness, kRounding);
}

// Any affine motion is followed exactly: the butterfly weights sum to one and midpoints'
// offsets come from the nodes as they are.
TEST(Switch, NodesThatComeLieOnTheMovedSurface) {
    const Levels levels = make_levels(even_sphere(50, 60), 2);
    const auto properties = level_properties(levels, {});
    Selection selection(levels);
    const Active before = make_active(levels, selection, properties);
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix() *
                      Vec3(1.0, 1.2, 0.9).asDiagonal();
    Motion motion{0, levels.rest, std::vector<Vec3>(levels.rest.size(), Vec3::Zero())};
    for (const std::int32_t v : before.nodes) {
        motion.x[v] = turn * levels.rest[v];
        motion.v[v] = Vec3(1, 2, 3);
    }
    for (std::int32_t f = 0; f < 30; ++f) refine(levels, selection, 0, f);
    Active after = make_active(levels, selection, properties);
    EXPECT_FALSE(after.hanging.empty());
    switch_to(levels, before, after, motion);
    for (const std::int32_t v : after.nodes) {
        EXPECT_LT((motion.x[v] - turn * levels.rest[v]).norm(), 1e-12);
        EXPECT_EQ(motion.v[v], Vec3(1, 2, 3));
    }
}
