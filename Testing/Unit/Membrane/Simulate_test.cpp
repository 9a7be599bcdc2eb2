// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Simulate.h"

#include <gtest/gtest.h>

#include <cstring>

#include "Core/Errors.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

namespace {

SilentProgress quiet;

Options brief(double duration) {
    Options options;
    options.duration = duration;
    return options;
}

// A force on the pole of a sphere of radius 50 mm.
Loads press(double force, double until) {
    Loads loads;
    loads.patches = {{Vec3(0, 0, 50), 30, Vec3(0, 0, -force), 0, until, 0.1}};
    return loads;
}

Tool sphere_tool(const Vec3& at) {
    Tool tool;
    tool.radius = 10;
    tool.places = {{0, at}};
    return tool;
}

void expect_refused(const TriMesh& surface, const Options& options, const Loads& loads,
                    const char* word) {
    try {
        (void)simulate(surface, options, loads, quiet);
        ADD_FAILURE() << "not refused: " << word;
    } catch (const InputError& e) {
        EXPECT_NE(std::strstr(e.what(), word), nullptr) << e.what();
    }
}

}  // namespace

TEST(Simulate, NothingMovesWithoutLoads) {
    const Result r = simulate(even_sphere(50, 60), brief(0.1), {}, quiet);
    EXPECT_EQ(r.status, Status::finished);
    EXPECT_EQ(r.switches, 0);
    EXPECT_LT(r.history.back().largest_displacement, 1e-12);
}

TEST(Simulate, FreeWallFallsAsItShould) {
    Options options = brief(0.2);
    options.wall.shape_stiffness = 0;
    options.wall.drag = 0;
    options.criteria.speed = 1e9;
    Loads loads;
    loads.gravity = Vec3(0, 0, -9810);
    const Result r = simulate(even_sphere(50, 60), options, loads, quiet);
    EXPECT_NEAR(r.history.back().largest_displacement, 9810 * 0.2 * 0.2 / 2, 1e-6);
}

// Laplace's law: p = 2 T / R with T = E t e / (1 - nu), nu = 1/3 for the lattice.
TEST(Simulate, PressureStretchesASphereByLaplacesLaw) {
    Options options = brief(1.5);
    options.wall.shape_stiffness = 0;
    options.wall.drag = 50;
    options.detail = Detail::coarse;
    options.levels = 0;
    Loads loads;
    loads.pressure = 1e-5;
    const Result r = simulate(ico_sphere(50, 3), options, loads, quiet);
    const double stretch = loads.pressure * 50 * (1 - 1.0 / 3) / (2 * 0.03 * 3);
    // Lattice with twelve vertices of valence 5, stretch of second order.
    EXPECT_NEAR(r.history.back().volume / r.history.front().volume, 1 + 3 * stretch,
                0.06 * 3 * stretch);
}

TEST(Simulate, SealedFillingKeepsItsVolumeAndIsPressed) {
    Options options = brief(0.5);
    Loads loads = press(0.5, 1), sealed = loads;
    sealed.bulk = 0.01;
    const TriMesh surface = even_sphere(50, 60);
    const Moment open = simulate(surface, options, loads, quiet).history.back(),
                 full = simulate(surface, options, sealed, quiet).history.back();
    const double rest = simulate(surface, brief(0.01), {}, quiet).history[0].volume;
    EXPECT_LT(full.volume, rest);
    EXPECT_LT(rest - full.volume, 0.5 * (rest - open.volume));
    EXPECT_GT(full.pressure, 0);
    EXPECT_EQ(open.pressure, 0);
}

TEST(Simulate, AdaptsUnderTheForceAndBackAndKeepsItsMass) {
    const Result r = simulate(even_sphere(50, 114), brief(1.5), press(1, 0.5), quiet);
    std::size_t most = 0;
    for (const Moment& m : r.history) {
        most = std::max(most, m.nodes);
        EXPECT_NEAR(m.mass / r.history[0].mass, 1, 1e-12);
    }
    EXPECT_GT(most, 150U);
    EXPECT_LT(most, 300U);
    EXPECT_EQ(r.history.back().nodes, 114U);
    EXPECT_LE(r.switches, 12);  // one way and back: nothing flickers
    EXPECT_LT(r.history.back().largest_displacement, 0.01);
}

TEST(Simulate, SameBytesEachTime) {
    const TriMesh surface = even_sphere(50, 60);
    const Result a = simulate(surface, brief(0.3), press(1, 0.2), quiet),
                 b = simulate(surface, brief(0.3), press(1, 0.2), quiet);
    ASSERT_EQ(a.final_surface.points.size(), b.final_surface.points.size());
    for (std::size_t i = 0; i < a.final_surface.points.size(); ++i)
        EXPECT_EQ(a.final_surface.points[i], b.final_surface.points[i]);
    EXPECT_EQ(a.evaluations, b.evaluations);
}

TEST(Simulate, HeldRimsStayAndTheMiddleSags) {
    Options options = brief(0.3);
    options.wall.shape_stiffness = 0;
    Loads loads;
    loads.hold_rims = true;
    loads.gravity = Vec3(0, 0, -9810);
    const TriMesh surface = sheet(10, 10, 5);
    const Result r = simulate(surface, options, loads, quiet);
    EXPECT_GT(r.history.back().largest_displacement, 0.5);
    for (const std::int32_t corner : {0, 10, 110, 120})
        EXPECT_EQ(r.final_surface.points[corner], surface.points[corner]);
}

TEST(Simulate, ToolPressesAndFeelsTheWall) {
    Options options = brief(0.5);
    Loads loads;
    loads.tools = {sphere_tool(Vec3(0, 0, 62))};
    loads.tools[0].places.push_back({0.4, Vec3(0, 0, 52)});
    const Result r = simulate(even_sphere(50, 114), options, loads, quiet);
    EXPECT_EQ(r.status, Status::finished);
    EXPECT_GT(r.history.back().tools[0].force.z(), 0.01);
    EXPECT_GT(r.history.back().largest_displacement, 3);
    EXPECT_GT(r.history.back().nodes, 114U);
}

TEST(Simulate, SaysWhenEnergyComesFromNowhere) {
    Options options = brief(1);
    options.levels = 0;
    Loads loads = press(1e200, 1);
    const Result r = simulate(even_sphere(50, 60), options, loads, quiet);
    EXPECT_EQ(r.status, Status::unstable);
    EXPECT_FALSE(r.message.empty());
}

TEST(Simulate, RefusesInOneSentence) {
    const TriMesh surface = even_sphere(50, 60);
    Loads inside, touching;
    inside.tools = {sphere_tool(Vec3(0, 0, 5))};
    touching.tools = {sphere_tool(Vec3(0, 0, 55))};
    expect_refused(surface, {}, inside, "inside the organ");
    expect_refused(surface, {}, touching, "in the wall");
    for (const auto threshold : {&Criteria::traction, &Criteria::speed, &Criteria::curvature}) {
        Options options;
        options.criteria.*threshold = 0;
        expect_refused(surface, options, {}, "criteria.");
        options.criteria.*threshold = std::nan("");
        expect_refused(surface, options, {}, "criteria.");
    }
    Options stiff;
    stiff.wall.young = 1e9;
    expect_refused(surface, stiff, {}, "stable step");
    Options thin;
    thin.wall.thickness = 0;
    expect_refused(surface, thin, {}, "wall.thickness");
    Loads open;
    open.bulk = 1;
    expect_refused(sheet(4, 4, 5), {}, open, "bulk");
    Loads far;
    far.patches = {{Vec3(0, 0, 500), 10, Vec3(0, 0, 1), 0, 1, 0}};
    expect_refused(surface, {}, far, "patch.radius");
}
