// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Contact.h"

#include <gtest/gtest.h>

#include "Membrane/Simulate.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

namespace {

struct Case {
    Levels levels = make_levels(ico_sphere(50, 3), 0);
    Wall wall;
    Loads loads;
    Active active = make_active(levels, wholly_refined(levels, 0), level_properties(levels, wall));
    Motion motion{0, levels.rest, std::vector<Vec3>(levels.rest.size(), Vec3::Zero())};
    Body body{levels, wall, loads, active};
};

Tool ball(const Vec3& at) {
    Tool tool;
    tool.radius = 12;
    tool.way = -Vec3::UnitZ();
    tool.places = {{0, at}};
    return tool;
}

Tool plate(const Vec3& on, const Vec3& normal) {
    Tool tool;
    tool.shape = Tool::Shape::plane;
    tool.normal = tool.way = normal;
    tool.places = {{0, on}};
    return tool;
}

}  // namespace

TEST(Contact, FirstTouchLeavesOnePointOnTheTool) {
    const Case c;
    const Vec3 way = Vec3(1, -2, -3).normalized();
    for (const Tool& tool : {ball(Vec3(20, 30, 90)), plate(Vec3(20, 30, 90), way)}) {
        const auto gone = first_touch(tool, tool.places[0].position, way, c.levels.rest);
        ASSERT_TRUE(gone);
        double deepest = -1e9;
        for (const Vec3& x : c.levels.rest)
            deepest =
                std::max(deepest, depth_in(tool, tool.places[0].position + *gone * way, x).depth);
        EXPECT_NEAR(deepest, 0, 1e-12);
    }
    EXPECT_FALSE(first_touch(ball({}), Vec3(70, 0, 90), -Vec3::UnitZ(), c.levels.rest));
    EXPECT_FALSE(first_touch(plate({}, Vec3::UnitX()), {}, -Vec3::UnitX(), c.levels.rest));
}

TEST(Contact, FirstHitIsOnTheNearSide) {
    const TriMesh sphere = ico_sphere(50, 3);
    const auto hit = first_hit(sphere, Vec3(3, 4, 0), Vec3::UnitY());
    ASSERT_TRUE(hit);
    EXPECT_LT(hit->y(), 0);
    EXPECT_NEAR(hit->norm(), 50, 0.5);  // within triangles' sagitta
    EXPECT_NEAR(hit->x(), 3, 1e-12);
    EXPECT_FALSE(first_hit(sphere, Vec3(60, 0, 0), Vec3::UnitY()));
}

TEST(Contact, ForceFindsThePlaceWhereTheWallBearsIt) {
    Case c;
    for (const double force : {1e-4, 0.01, 0.4, 2.0}) {
        for (Tool tool : {ball(Vec3(1, 2, 90)), plate(Vec3(0, 0, 90), -Vec3::UnitZ())}) {
            tool.forces = {{0, force}};
            bool sunk = false;
            const Vec3 at = place_of(tool, c.body, c.motion, &sunk);
            EXPECT_FALSE(sunk);
            const Touch touch = touch_of(tool, c.body, c.motion);
            EXPECT_EQ(touch.place, at);
            EXPECT_NEAR(-touch.force.dot(tool.way) / force, 1, 1e-9);
            EXPECT_GT(touch.nodes, 0U);
        }
    }
}

TEST(Contact, WithoutForceAToolJustTouchesAndNeverGoesBack) {
    Case c;
    Tool tool = ball(Vec3(0, 0, 90));
    tool.forces = {{0, 0}, {1, 1}};
    EXPECT_NEAR(depth_in(tool, place_of(tool, c.body, c.motion), Vec3(0, 0, 50)).depth, 0, 0.5);
    EXPECT_EQ(touch_of(tool, c.body, c.motion).force.norm(), 0);
    tool.places[0].position = Vec3(0, 0, -20);  // beyond the upper wall
    EXPECT_EQ(place_of(tool, c.body, c.motion), Vec3(0, 0, -20));
}

TEST(Contact, SaysWhereAToolFindsNoResistance) {
    Case c;
    Tool tool = ball(Vec3(0, 0, 90));
    tool.forces = {{0, 1e4}};
    EXPECT_TRUE(touch_of(tool, c.body, c.motion).sunk);
    c.loads.tools = {tool};
    SilentProgress quiet;
    Options options;
    options.duration = 0.1;
    const Result r = simulate(ico_sphere(50, 2), options, c.loads, quiet);
    EXPECT_EQ(r.status, Status::sunk);
    EXPECT_NE(r.message.find("does not bear its force"), std::string::npos);
}

// Pressed by a force, the wall carries it: at rest drag and inertia are gone.
TEST(Contact, AForceIsFeltAsLongAsItPresses) {
    Case c;
    Tool tool = ball(Vec3(0, 0, 90));
    tool.forces = {{0, 0}, {0.1, 0.1}};
    c.loads.tools = {tool};
    SilentProgress quiet;
    Options options;
    options.duration = 0.6;
    options.levels = 1;
    const Result r = simulate(ico_sphere(50, 2), options, c.loads, quiet);
    ASSERT_EQ(r.status, Status::finished) << r.message;
    EXPECT_NEAR(r.history.back().tools[0].force.z(), 0.1, 1e-9);
    EXPECT_GT(r.history.back().tools[0].displacement, 0.3);
}
