// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "Membrane/Contact.h"
#include "Membrane/Switch.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

namespace {

struct Case {
    Levels levels = make_levels(even_sphere(50, 60), 2);
    Wall wall;
    Loads loads;
    Active active;
    Motion motion;
    Body body{levels, wall, loads, active};

    Case() {
        Selection selection(levels);
        for (std::int32_t f = 0; f < 30; ++f) refine(levels, selection, 0, f);
        for (std::int32_t f = 0; f < 12; ++f) refine(levels, selection, 1, f);
        active = make_active(levels, selection, level_properties(levels, wall));
        motion = {0, levels.rest, std::vector<Vec3>(levels.rest.size(), Vec3::Zero())};
        prepare(body);
        switch_to(levels, active, active, motion);
    }
    void shake(double by) {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> part(-by, by);
        for (const std::int32_t v : active.nodes)
            motion.x[v] += Vec3(part(random), part(random), part(random));
        follow(active, motion);
    }
    NodeForces blank() const {
        const std::vector<Vec3> none(levels.rest.size(), Vec3::Zero());
        return {none, none, none};
    }
    NodeForces forces() {
        NodeForces f = blank();
        find_forces(body, motion, f);
        return f;
    }
    // What springs hold, less the work of pressure.
    double potential() {
        NodeForces f = blank();
        const double held = find_forces(body, motion, f);
        const double volume = cavity_volume(body, motion.x);
        return held - loads.pressure * volume +
               loads.bulk * (volume * volume / (2 * body.rest_volume) - volume);
    }
};

}  // namespace

TEST(MembraneForces, AtRestNothingPulls) {
    Case c;
    const NodeForces f = c.forces();
    for (const std::int32_t v : c.active.nodes) EXPECT_LT(f.total[v].norm(), 1e-12);
    EXPECT_LT(c.potential(), 1e-20);
}

// Springs, shape-preserving springs, pressure and a sealed filling, across levels.
TEST(MembraneForces, AreMinusTheGradientOfEnergy) {
    Case c;
    c.loads.pressure = 1e-4;
    c.loads.bulk = 1e-2;
    c.shake(1);
    const NodeForces f = c.forces();
    constexpr double kStep = 1e-4;      // mm; the error of central differences is its square
    constexpr double kRelative = 1e-6;  // of the largest force
    double largest = 0;
    for (const std::int32_t v : c.active.nodes) largest = std::max(largest, f.total[v].norm());
    for (const std::int32_t v : c.active.nodes) {
        if (c.active.inertia[v] == 0) continue;  // hanging
        for (int axis = 0; axis < 3; ++axis) {
            double side[2];
            for (int s = 0; s < 2; ++s) {
                const Vec3 there = c.motion.x[v];
                c.motion.x[v][axis] += s == 0 ? -kStep : kStep;
                follow(c.active, c.motion);
                side[s] = c.potential();
                c.motion.x[v] = there;
                follow(c.active, c.motion);
            }
            EXPECT_NEAR(f.total[v][axis], -(side[1] - side[0]) / (2 * kStep), kRelative * largest);
        }
    }
}

// Hanging nodes turn with their edges: a turn of the whole leaves springs as they are, but for
// turns about the edges themselves.
TEST(MembraneForces, HangingNodesTurnWithTheirEdges) {
    Case c;
    ASSERT_FALSE(c.active.hanging.empty());
    const Hanging& h = c.active.hanging.front();
    const Vec3 edge = c.motion.x[h.b] - c.motion.x[h.a];
    EXPECT_LT((turned_offset(h, 3 * edge) - h.offset).norm(), 1e-14);
    const Vec3 across = edge.unitOrthogonal();
    const Mat3 turn = Eigen::AngleAxisd(1.1, across).toRotationMatrix();
    EXPECT_LT((turned_offset(h, turn * edge) - turn * h.offset).norm(), 1e-12);
    // How the offset depends on the edge, by central differences.
    const Vec3 now = turn * edge + Vec3(0.3, -0.2, 0.4);
    constexpr double kStep = 1e-5;
    Mat3 slope;
    for (int axis = 0; axis < 3; ++axis)
        slope.col(axis) = (turned_offset(h, now + kStep * Vec3::Unit(axis)) -
                           turned_offset(h, now - kStep * Vec3::Unit(axis))) /
                          (2 * kStep);
    const Vec3 some(0.4, -1.3, 0.7);
    EXPECT_LT((turned_by(h, now, some) - slope * some).norm(), 1e-8);
    EXPECT_LT((couple_of(h, now, some) - slope.transpose() * some).norm(), 1e-8);
    EXPECT_GT(slope.norm(), 1e-4);
}

TEST(MembraneForces, SpringsNeitherPushNorTurnTheWhole) {
    Case c;
    c.wall.shape_stiffness = 0;
    c.wall.drag = 0;
    c.shake(2);
    const NodeForces f = c.forces();
    Vec3 force = Vec3::Zero();
    double size = 0;
    for (const std::int32_t v : c.active.nodes)
        if (c.active.inertia[v] > 0) {
            force += f.total[v];
            size += f.total[v].norm();
        }
    EXPECT_LT(force.norm(), 1e-13 * size);
}

// A stretched flat wall with a refined part: every node inside stays at rest, on either side
// of the change of levels.
TEST(MembraneForces, StretchedSheetIsInBalanceAcrossLevels) {
    const Levels levels = make_levels(sheet(10, 10, 5), 1);
    Wall wall;
    wall.shape_stiffness = 0;
    Selection selection(levels);
    for (std::int32_t f = 80; f < 120; f += 3) refine(levels, selection, 0, f);
    const Active active = make_active(levels, selection, level_properties(levels, wall));
    const Loads loads;
    const Body body{levels, wall, loads, active};
    Motion motion{0, levels.rest, std::vector<Vec3>(levels.rest.size(), Vec3::Zero())};
    for (Vec3& x : motion.x) x = Vec3(1.1 * x.x(), 1.05 * x.y(), 0);
    const std::size_t n = levels.rest.size();
    NodeForces f{std::vector<Vec3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n)};
    find_forces(body, motion, f);
    const auto fixed = [&] {
        Loads rims;
        rims.hold_rims = true;
        return fixed_vertices(levels, rims);
    }();
    double worst = 0;
    for (const std::int32_t v : active.nodes)
        if (active.inertia[v] > 0 && fixed[v] == 0) worst = std::max(worst, f.total[v].norm());
    EXPECT_LT(worst, 1e-12);
    EXPECT_FALSE(active.hanging.empty());
}

TEST(MembraneForces, PatchBringsItsWholeForceAtEveryLevel) {
    Case c;
    c.loads.patches = {{Vec3(0, 0, 50), 30, Vec3(0, 1, -2), 0, 1, 0}};
    prepare(c.body);
    c.motion.time = 0.5;
    const NodeForces f = c.forces();
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t v : c.active.nodes) sum += f.pressing[v];
    EXPECT_LT((sum - Vec3(0, 1, -2)).norm(), 1e-14);
}

TEST(MembraneForces, ToolTouchesWhatIsInIt) {
    Tool tool;
    tool.radius = 10;
    tool.places = {{0, Vec3(0, 0, 70)}, {1, Vec3(0, 0, 50)}};
    EXPECT_EQ(place_at(tool, 0.5), Vec3(0, 0, 60));
    EXPECT_EQ(place_at(tool, 7), Vec3(0, 0, 50));
    EXPECT_NEAR(depth_in(tool, Vec3(0, 0, 60), Vec3(0, 0, 52)).depth, 2, 1e-14);
    EXPECT_LT(depth_in(tool, Vec3(0, 0, 70), Vec3(0, 0, 52)).depth, 0);
    Tool plane;
    plane.shape = Tool::Shape::plane;
    EXPECT_NEAR(depth_in(plane, Vec3(0, 0, 1), Vec3(5, 5, -2)).depth, 3, 1e-14);
    Case c;
    c.loads.tools = {tool};
    c.motion.time = 0.9;
    const Vec3 force = touch_of(c.loads.tools[0], c.body, c.motion).force;
    EXPECT_GT(force.z(), 0);
}
