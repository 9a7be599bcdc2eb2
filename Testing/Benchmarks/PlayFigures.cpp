// SPDX-License-Identifier: Apache-2.0
// What cages that are played with must reach: steps a second, and the preview of a contraction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "Contraction/Materials.h"
#include "Core/Parallel.h"
#include "Dynamics/ElasticBody.h"
#include "Dynamics/QuasiStatic.h"
#include "Support/PlayShapes.h"

using namespace myotet;
using namespace myotet::play;

namespace {

constexpr double kStep = 1.0 / 60;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Points in a body that ride in it, as a detailed surface's vertices do.
void embed_points(Body& body, const TetMesh& mesh, std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    std::uniform_int_distribution<std::size_t> which(0, mesh.tets.size() - 1);
    for (std::size_t i = 0; i < count; ++i) {
        const Tet& t = mesh.tets[which(random)];
        double w[4], sum = 0;
        for (double& c : w) sum += c = part(random);
        Vec3 p = Vec3::Zero();
        for (int c = 0; c < 4; ++c) p += w[c] / sum * mesh.points[t[c]];
        body.detail.points.push_back(p);
    }
    body.embedding = cage::embed(mesh, body.detail.points);
}

struct Played {
    double seconds = 0, worst = 0;  // of the processor, of a step
    double deepest = 0, least = 1;
    int steps = 0, iterations = 0, linear = 0, early = 0;
};

Played play_on(World& world, int steps, double dt) {
    const ThreadLimit one(1);
    Stepper stepper(world, {});
    State state = stepper.start();
    std::vector<std::vector<Vec3>> details;
    for (const Body& body : world.bodies) details.emplace_back(body.detail.points.size());
    Played played;
    for (int i = 0; i < steps; ++i) {
        const double start = processor_seconds();
        const StepReport report = stepper.step(dt, state);
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            const Body& body = world.bodies[b];
            cage::deform(body.embedding,
                         {state.x.data() + body.first_node, static_cast<std::size_t>(body.nodes)},
                         details[b]);
        }
        const double took = processor_seconds() - start;
        played.seconds += took;
        played.worst = std::max(played.worst, took);
        played.iterations += report.iterations;
        played.linear += report.linear_iterations;
        played.early += !report.settled;
        played.deepest = std::max(played.deepest, stepper.deepest(state));
        played.least = std::min(played.least, stepper.smallest_volume_ratio(state));
        ++played.steps;
    }
    return played;
}

void print(const char* name, const Played& p) {
    std::printf(
        "%s: %.0f steps a second of the processor, worst %.1f ms, %.2f iterations a step, %.0f of "
        "conjugate gradients, %d of %d ended early, deepest %.2f mm, smallest det F %.2f\n",
        name, p.steps / p.seconds, 1e3 * p.worst, 1.0 * p.iterations / p.steps,
        1.0 * p.linear / p.steps, p.early, p.steps, p.deepest, p.least);
}

TEST(PlayFigures, TwoThousandFiveHundredTetrahedra) {
    World world;
    world.gravity = {0, 0, -9810};
    world.contact = {.gap = 0.25, .stiffness = 0.1, .friction = 0.3};
    const TetMesh mesh = play::test::ball_at({0, 0, 25}, 20, 8);
    Body& body = add_soft_body(world, {"ball", mesh, {}}, {.young = 0.05});
    embed_points(body, mesh, 100000);
    (void)add_ball(world, {"shot", 0, 7}, {-70, 0, 45}, 1.6e-5);
    world.velocity.back() = {1500, 0, -400};
    world.obstacles.push_back(play::test::floor_at(0));
    std::printf("%zu tetrahedra, %zu embedded vertices\n", mesh.tets.size(),
                world.bodies[0].embedding.size());
    const Played played = play_on(world, 90, kStep);
    print("projectile", played);
    EXPECT_GE(mesh.tets.size(), 2500u);
    EXPECT_GE(played.steps / played.seconds, 60);
    EXPECT_GT(played.least, 0);
    EXPECT_LT(played.deepest, 1.5);
}

TEST(PlayFigures, PileOfTwelve) {
    World world;
    world.gravity = {0, 0, -9810};
    world.contact = {.gap = 0.35, .stiffness = 0.1, .friction = 0.3};
    std::size_t tets = 0;
    for (int i = 0; i < 12; ++i) {
        const Vec3 centre(i % 2 ? 16 : -14, (i / 2) % 2 ? 13 : -15, 25 + 24 * i);
        const TetMesh mesh = play::test::ball_at(centre, 18, 4);
        tets += mesh.tets.size();
        embed_points(add_soft_body(world, {"ball", mesh, {}}, {.young = 0.1}), mesh, 8000);
    }
    world.obstacles.push_back(play::test::floor_at(0));
    for (int side = 0; side < 4; ++side) {
        Obstacle wall;
        wall.normal = (side % 2 ? -1 : 1) * Vec3::Unit(side / 2);
        wall.point = -40 * wall.normal;
        world.obstacles.push_back(wall);
    }
    std::printf("%zu tetrahedra, 12 bodies, 96 000 embedded vertices\n", tets);
    const Played played = play_on(world, 120, kStep);
    print("pile", played);
    EXPECT_GE(played.steps / played.seconds, 20);
    EXPECT_GT(played.least, 0);
    EXPECT_LT(played.deepest, 2);
}

// How far the upper end of a spindle comes down when it is fully active.
struct Shortened {
    double by = 0, seconds = 0;
    std::size_t tets = 0;
};

constexpr double kLength = 60;

std::vector<std::int32_t> nodes_at(const TetMesh& mesh, double z) {
    std::vector<std::int32_t> nodes;
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (std::abs(mesh.points[n].z() - z) < 1e-9) nodes.push_back(static_cast<std::int32_t>(n));
    return nodes;
}

double mean_z(const std::vector<Vec3>& x, const std::vector<std::int32_t>& nodes) {
    double sum = 0;
    for (const std::int32_t n : nodes) sum += x[n].z();
    return sum / static_cast<double>(nodes.size());
}

muscle::TissueMaterial teran() {
    return contraction::read_material(MYOTET_DATA_DIR "/materials/teran2003_muscle.yaml");
}

// The same fibres for both: along z, and with the radius as it changes.
std::vector<Vec3> fibres_of(const TetMesh& mesh) {
    std::vector<Vec3> fibres;
    for (const Tet& t : mesh.tets) {
        const Vec3 c =
            (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]] + mesh.points[t[3]]) / 4;
        const double u = M_PI * c.z() / kLength, s = std::sin(u);
        const double slope = 10 * s * std::cos(u) * M_PI / kLength / (5 + 5 * s * s);
        fibres.push_back(Vec3(slope * c.x(), slope * c.y(), 1).normalized());
    }
    return fibres;
}

// Quasi-static, to 1e-4 of the forces, as few load steps as there are.
Shortened fine(int across, int along, double activation) {
    const ThreadLimit one(1);
    const TetMesh mesh = play::test::spindle(kLength, 1, across, along);
    const double start = processor_seconds();
    World made;  // for its points' fibres alone
    Body& body =
        add_muscle_body(made, {"fine", mesh, {}}, {.tissue = teran(), .fibres = fibres_of(mesh)});
    make_muscles(made);
    dynamics::LoadCase load{{body.elastic.get()}, nodes_at(mesh, 0), {}};
    load.apply = [&](double part, dynamics::NodeVectors&) {
        body.law->set_activation(
            std::vector<double>(body.law->activation().size(), part * activation));
    };
    dynamics::LoadOptions options;
    options.equilibrium.tolerance = 1e-4;
    dynamics::NodeVectors x = mesh.points;
    const auto summary = dynamics::apply_load(load, options, x, [](const auto&) {});
    EXPECT_TRUE(summary.completed) << summary.message;
    const auto end = nodes_at(mesh, kLength);
    return {kLength - mean_z(x, end), processor_seconds() - start, mesh.tets.size()};
}

Shortened preview(int across, int along, double activation) {
    const ThreadLimit one(1);
    const TetMesh mesh = play::test::spindle(kLength, 1.12, across, along);
    const double start = processor_seconds();
    World world;
    world.contact = {.gap = 0.1, .stiffness = 0.1, .friction = 0};
    const double share = volume(play::test::spindle(kLength, 1, across, along)) / volume(mesh);
    Body& body =
        add_muscle_body(world, {"cage", mesh, std::vector<double>(mesh.tets.size(), share)},
                        {.tissue = teran(), .fibres = fibres_of(mesh)});
    body.activation = {{0, 0.2}, {0, activation}};
    hold(world, body, nodes_at(mesh, 0));
    Stepper stepper(world, {});
    State state = stepper.start();
    int iterations = 0, linear = 0;
    for (int i = 0; i < 10; ++i) {
        const StepReport report = stepper.step(0.03, state);
        iterations += report.iterations;
        linear += report.linear_iterations;
    }
    std::printf("preview: %d iterations, %d of conjugate gradients\n", iterations, linear);
    const auto end = nodes_at(mesh, kLength);
    return {kLength - mean_z(state.x, end), processor_seconds() - start, mesh.tets.size()};
}

TEST(PlayFigures, PreviewOfAContraction) {
    for (const double activation : {0.3, 1.0}) {
        const Shortened full = fine(12, 40, activation), cage = preview(3, 10, activation);
        std::printf(
            "activation %.1f: %zu tetrahedra shorten by %.2f mm in %.1f s, a cage of %zu by %.2f "
            "mm (%+.1f %%) in %.3f s (%.2f %%)\n",
            activation, full.tets, full.by, full.seconds, cage.tets, cage.by,
            100 * (cage.by / full.by - 1), cage.seconds, 100 * cage.seconds / full.seconds);
        EXPECT_NEAR(cage.by, full.by, 0.15 * full.by);
        EXPECT_LE(cage.seconds, 0.01 * full.seconds);
    }
}

}  // namespace
