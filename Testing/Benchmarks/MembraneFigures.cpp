// SPDX-License-Identifier: Apache-2.0
// The experiments of [Choi05, figs. 8 to 12] and what hollow organs cost at scale.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "Benchmarks/MembranePlots.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

using namespace myotet::benchmarks;

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Timed {
    Result result;
    double seconds = 0;                  // of a processor
    double peak = 0;                     // largest displacement of the patch, mm
    std::size_t nodes = 0, springs = 0;  // most in use
    Snapshot shot;                       // at the time asked for
};

Timed run(const TriMesh& surface, Options options, const Loads& loads, Detail detail,
          double shot_at = -1) {
    SilentProgress quiet;
    options.detail = detail;
    Timed t;
    const Observer take = [&](const View& view) {
        if (std::abs(view.moment.time - shot_at) < 1e-6) t.shot = snapshot_of(view);
    };
    const double start = processor_seconds();
    t.result = simulate(surface, options, loads, quiet, shot_at < 0 ? Observer{} : take);
    t.seconds = processor_seconds() - start;
    for (const Moment& m : t.result.history) {
        t.nodes = std::max(t.nodes, m.nodes);
        t.springs = std::max(t.springs, m.springs);
        if (!m.patch_displacement.empty()) t.peak = std::max(t.peak, m.patch_displacement[0]);
    }
    EXPECT_EQ(t.result.status, Status::finished) << t.result.message;
    return t;
}

// Largest difference of the patches' displacements at any moment, in parts of b's peak.
double apart(const Timed& a, const Timed& b) {
    double most = 0;
    for (std::size_t i = 0; i < b.result.history.size(); ++i)
        most = std::max(most, std::abs(a.result.history[i].patch_displacement[0] -
                                       b.result.history[i].patch_displacement[0]));
    return most / b.peak;
}

void print(const char* name, const Timed& t) {
    std::printf("| %s | %zu | %zu | %.2f | %lld | %lld | %.3f |\n", name, t.nodes, t.springs,
                t.peak, static_cast<long long>(t.result.evaluations),
                static_cast<long long>(t.result.spring_evaluations), t.seconds);
}

Loads press(double radius, double force, double until) {
    Loads loads;
    loads.patches = {{Vec3(0, 0, 50), radius, Vec3(0, 0, -force), 0, until, 0.1}};
    return loads;
}

// Coarse, refined and adaptive, as in [Choi05, table 1, figs. 11, 12].
struct Three {
    Timed coarse, refined, adaptive;
};

Three press_three_ways(const TriMesh& surface, const Loads& loads) {
    constexpr double kShot = 2.0;
    Options options;
    options.duration = 4;
    options.levels = 1;
    Three t{run(surface, options, loads, Detail::coarse, kShot),
            run(surface, options, loads, Detail::refined, kShot),
            run(surface, options, loads, Detail::adaptive, kShot)};
    // The best of three, since the runs are so short that other work disturbs them.
    for (int again = 1; again < 3; ++again) {
        t.refined.seconds =
            std::min(t.refined.seconds, run(surface, options, loads, Detail::refined).seconds);
        t.adaptive.seconds =
            std::min(t.adaptive.seconds, run(surface, options, loads, Detail::adaptive).seconds);
    }
    print("coarse", t.coarse);
    print("refined", t.refined);
    print("adaptive", t.adaptive);
    const double saved = 1 - t.adaptive.seconds / t.refined.seconds,
                 saved_springs = 1 - static_cast<double>(t.adaptive.result.spring_evaluations) /
                                         static_cast<double>(t.refined.result.spring_evaluations);
    std::printf("coarse %.4f adaptive %.4f apart; saved %.3f of time, %.3f of spring forces\n",
                apart(t.coarse, t.refined), apart(t.adaptive, t.refined), saved, saved_springs);
    EXPECT_LT(apart(t.adaptive, t.refined), 0.03);
    EXPECT_LT(apart(t.coarse, t.refined), 0.10);
    EXPECT_GT(saved_springs, 0.65);
    EXPECT_GT(saved, 0.65);
    return t;
}

void draw(const Three& t, const std::string& stem, const Vec3& direction) {
    draw_snapshots(
        {{"coarse", t.coarse.shot}, {"refined", t.refined.shot}, {"adaptive", t.adaptive.shot}},
        direction, stem + "_pressed.png");
    draw_lines("displacement of the pressed patch",
               {{.title = stem,
                 .y_label = "mm",
                 .lines = {line_of("coarse", t.coarse.result), line_of("refined", t.refined.result),
                           line_of("adaptive", t.adaptive.result, report::LineStyle::dashed)}}},
               stem + "_displacement.png");
}

double largest_change_of_radius(const TriMesh& surface, double radius, std::size_t count) {
    double most = 0;
    for (std::size_t i = 0; i < count; ++i)
        most = std::max(most, std::abs(surface.points[i].norm() / radius - 1));
    return most;
}

}  // namespace

// A sphere of 114 nodes pressed for 2 s and released [Choi05, figs. 11, 12 a, table 1].
TEST(MembraneFigures, PressedSphere) {
    draw(press_three_ways(even_sphere(50, 114), press(30, 1, 2)), "sphere", Vec3(0, 1, -0.4));
}

// The same of a stomach of 188 nodes and 558 springs [Choi05, figs. 12 b, 13, table 1].
TEST(MembraneFigures, PressedStomach) {
    const TriMesh stomach = stomach_like(188);
    const auto front = first_hit(stomach, Vec3(-50, 0, 0), Vec3::UnitY());
    ASSERT_TRUE(front);
    Loads loads;
    loads.patches = {{*front, 20, Vec3(0, 0.6, 0), 0, 2, 0.1}};
    const Three t = press_three_ways(stomach, loads);
    draw(t, "stomach", Vec3(0.7, 1, -0.3));
    EXPECT_EQ(t.coarse.nodes, 188U);
    EXPECT_EQ(t.coarse.springs, 558U);
    EXPECT_EQ(t.refined.nodes, 746U);
    EXPECT_EQ(t.refined.springs, 2232U);
}

// [Choi05, fig. 8]: pressed in from above, lying on its lower cap.
TEST(MembraneFigures, ShapePreservingSpringsBringTheSphereBack) {
    const TriMesh sphere = even_sphere(50, 114);
    Options options;
    options.duration = 4;
    Loads loads = press(30, 2, 2);
    for (std::int32_t v = 0; v < 114; ++v)
        if (sphere.points[v].z() < -30) loads.held.push_back(v);
    const auto with = run(sphere, options, loads, Detail::adaptive, 4);
    options.wall.shape_stiffness = 0;
    const auto without = run(sphere, options, loads, Detail::adaptive, 4);
    draw_snapshots({{"without", without.shot}, {"with", with.shot}}, Vec3(0, 1, -0.3),
                   "released.png");
    const double back = largest_change_of_radius(with.result.final_surface, 50, 114),
                 dent = largest_change_of_radius(without.result.final_surface, 50, 114);
    std::printf("radius off by %.5f with, %.4f without\n", back, dent);
    EXPECT_LT(back, 0.01);
    EXPECT_GT(dent, 0.1);
}

// [Choi05, figs. 9, 10]: a sheet held at its rim, wholly refined, pressed for 1 s.
TEST(MembraneFigures, RefinedFabric) {
    const TriMesh fabric = sheet(20, 22, 5);
    Options options;
    options.duration = 1.5;
    options.wall.shape_stiffness = 0;
    options.wall.drag = 20;
    Loads loads;
    loads.hold_rims = true;
    loads.patches = {{Vec3(51, 48, 0), 20, Vec3(0, 0, 0.2), 0, 1, 0.1}};
    const Timed coarse = run(fabric, options, loads, Detail::coarse, 1),
                refined = run(fabric, options, loads, Detail::refined, 1);
    options.wall.stiffening = Stiffening::by_mass;
    const Timed paper = run(fabric, options, loads, Detail::refined);
    print("coarse", coarse);
    print("refined", refined);
    std::printf("same modulus %.4f, by mass %.4f apart\n", apart(coarse, refined),
                apart(coarse, paper));
    EXPECT_LT(apart(coarse, refined), 0.05);
    draw_snapshots({{"coarse", coarse.shot}, {"refined", refined.shot}}, Vec3(0.3, 1, -0.8),
                   "fabric_pressed.png");
    draw_lines("displacement of the pressed patch",
               {{.title = "fabric",
                 .y_label = "mm",
                 .lines = {line_of("coarse", coarse.result), line_of("refined", refined.result),
                           line_of("refined, eq. 8", paper.result, report::LineStyle::dotted)}}},
               "fabric_displacement.png");
}

// A tool wanders over a sphere of 20 354 nodes at the finest level.
TEST(MembraneFigures, WanderingTool) {
    const TriMesh sphere = even_sphere(50, 320);
    Options options;
    options.levels = 3;
    options.duration = 0.3;
    options.criteria.speed = 500;
    Loads loads;
    Tool tool;
    tool.radius = 8;
    tool.places = {{0, Vec3(0, 0, 59)}, {0.1, Vec3(0, 0, 54)}, {0.3, Vec3(15, 0, 51)}};
    loads.tools = {tool};
    const Timed refined = run(sphere, options, loads, Detail::refined),
                adaptive = run(sphere, options, loads, Detail::adaptive);
    print("refined", refined);
    print("adaptive", adaptive);
    double most = 0, off = 0, force = 0, force_off = 0;
    for (std::size_t i = 0; i < refined.result.history.size(); ++i) {
        const Moment &a = adaptive.result.history[i], &b = refined.result.history[i];
        most = std::max(most, b.largest_displacement);
        off = std::max(off, std::abs(a.largest_displacement - b.largest_displacement));
        force = std::max(force, b.tools[0].force.norm());
        force_off = std::max(force_off, (a.tools[0].force - b.tools[0].force).norm());
    }
    std::printf("%.1f times faster, displacement %.4f, force %.4f apart\n",
                refined.seconds / adaptive.seconds, off / most, force_off / force);
    EXPECT_GT(refined.seconds / adaptive.seconds, 10);
    EXPECT_LT(off / most, 0.05);
    EXPECT_LT(force_off / force, 0.05);
}

// 2 002 nodes in use all the time.
TEST(MembraneFigures, RealTimeAtTwoThousandNodes) {
    const TriMesh sphere = even_sphere(50, 502);
    Options options;
    options.duration = 1;
    const Timed t = run(sphere, options, press(20, 0.5, 0.6), Detail::refined);
    print("refined", t);
    EXPECT_EQ(t.nodes, 2002U);
    EXPECT_LT(t.seconds, options.duration);
}
