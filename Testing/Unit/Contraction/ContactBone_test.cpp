// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ContactBone.h"

#include "ContactShapes.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Dynamics/ElasticBody.h"
#include "Dynamics/Equilibrium.h"
#include "Elasticity/Materials.h"

namespace myotet::contraction {
namespace {

using dynamics::ElasticBody;
using dynamics::Equilibrium;
using elasticity::NeoHookean;
using elasticity::OneLaw;
using test::add_scaled;
using test::NodeVectors;

Pose tilted() {
    Pose pose;
    pose.rotation = Eigen::AngleAxisd(1.1, Vec3(1, -2, 3).normalized()).toRotationMatrix();
    pose.translation = {3, -4, 5};
    return pose;
}

// Nodes around a ball of 5 mm that is elsewhere: at rest far from it, then near.
struct Around {
    static constexpr double kRadius = 5;
    ContactNodes nodes;
    NodeVectors rest, x;
    Pose pose = tilted();

    Around() {
        for (const Vec3& d : test::random_vectors(60, 1, 3)) {
            nodes.node.push_back(static_cast<std::int32_t>(rest.size()));
            nodes.area.push_back(1 + d.x() * d.x());
            rest.push_back(20 * d.normalized());
            // From 1 mm inside to 1 mm outside.
            x.push_back(pose.rotation * ((kRadius + d.z()) * d.normalized()) + pose.translation);
        }
    }
    [[nodiscard]] BoneContact contact() const {
        BoneContact c(nodes, rest, test::ball_field(kRadius, 0.5), {.stiffness = 2, .gap = 0.3});
        c.set_pose(pose);
        return c;
    }
};

TEST(ContactBone, ForcesAndStiffnessAreDerivativesOfTheEnergy) {
    const Around around;
    BoneContact contact = around.contact();
    test::expect_derivatives(contact, around.x);
    EXPECT_GT(contact.report().nodes, 20);
    EXPECT_LT(contact.report().nodes, 55);
}

TEST(ContactBone, NoForceWhenApart) {
    const Around around;
    BoneContact contact = around.contact();
    EXPECT_EQ(contact.move_to(around.rest), 0);
    for (const Vec3& f : test::forces_at(contact, around.rest)) EXPECT_EQ(f, Vec3::Zero());
    EXPECT_EQ(contact.report().nodes, 0);
    EXPECT_EQ(contact.report().mean_depth, 0);
}

TEST(ContactBone, PressureIsStiffnessTimesDepthAlongTheNormal) {
    const std::vector<Vec3> rest = {{0, 0, 5}}, x = {{1, 2, -0.25}};
    BoneContact contact({{0}, {3}}, rest, test::floor_field(), {.stiffness = 2, .gap = 0.5});
    const NodeVectors f = test::forces_at(contact, x);
    // Samples are floats.
    EXPECT_LT((f[0] - 2.0 * 3 * 0.75 * Vec3::UnitZ()).norm(), 1e-5);
    EXPECT_NEAR(contact.report().max_depth, 0.25, 1e-6);
    EXPECT_NEAR(contact.report().max_pressure, 1.5, 1e-5);
}

TEST(ContactBone, MovedWithTheBoneNothingChanges) {
    const Around around;
    BoneContact contact = around.contact();
    const double energy = contact.move_to(around.x);
    const Mat3 Q = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Vec3 by(4, 5, 6);
    NodeVectors moved = around.x;
    for (Vec3& p : moved) p = Q * p + by;
    contact.set_pose({Q * around.pose.rotation, Q * around.pose.translation + by});
    EXPECT_GT(energy, 1);
    EXPECT_NEAR(contact.move_to(moved), energy, energy * test::kRounding);
}

TEST(ContactBone, ALevelSetMayHaveAFrameOfItsOwn) {
    const Around around;
    BoneContact contact = around.contact();
    const double energy = contact.move_to(around.x);
    ContactField field = test::ball_field(Around::kRadius, 0.5);
    field.frame = {around.pose.rotation, around.pose.translation};
    NodeVectors rest = around.rest;
    for (Vec3& p : rest) p = field.frame.to_lps(p);
    BoneContact framed(around.nodes, rest, field, {.stiffness = 2, .gap = 0.3});
    EXPECT_NEAR(framed.move_to(around.x), energy, energy * test::kRounding);
}

TEST(ContactBone, OverlapAtRestIsForgivenAndNoMore) {
    const std::vector<Vec3> rest = {{0, 0, -1}, {2, 0, 0.1}, {4, 0, 2}};
    BoneContact contact({{0, 1, 2}, {1, 1, 1}}, rest, test::floor_field(), {.gap = 0.5});
    EXPECT_EQ(contact.move_to(rest), 0);
    NodeVectors x = rest;
    for (Vec3& p : x) p.z() -= 0.2;
    const NodeVectors f = test::forces_at(contact, x);
    EXPECT_NEAR(f[0].z(), 0.2, 1e-5);
    EXPECT_NEAR(f[1].z(), 0.2, 1e-5);
    EXPECT_EQ(f[2].z(), 0);
    EXPECT_NEAR(contact.report().max_depth, 0.2, 1e-5);
    EXPECT_NEAR(contact.report().mean_depth, (0.2 + 0.1) / 2, 1e-5);
}

TEST(ContactBone, RefusesAPoseThatStretches) {
    BoneContact contact = Around().contact();
    Pose pose;
    pose.rotation *= 1.01;
    EXPECT_THROW(contact.set_pose(pose), InputError);
    pose.rotation = -Mat3::Identity();
    EXPECT_THROW(contact.set_pose(pose), InputError);
    pose.rotation(0, 0) = std::nan("");
    EXPECT_THROW(contact.set_pose(pose), InputError);
}

TEST(ContactBone, SameBytesOnOneThreadOrMany) {
    const auto on = [](int threads) {
        const ThreadLimit limit(threads);
        const TetMesh mesh = test::block(12, 0.5);
        BoneContact contact(contact_nodes(mesh.points, boundary_faces(mesh.tets), {}),
                            NodeVectors(mesh.points.size(), Vec3(9, 9, 9)),
                            test::ball_field(5, 0.5), {});
        const double energy = contact.move_to(mesh.points);
        return std::pair(energy, test::forces_at(contact, mesh.points));
    };
    EXPECT_EQ(on(1), on(3));
}

// A column of 4 mm pushed down on the floor by its held top: it sinks in by p / k, and
// shortens as its material says.
TEST(ContactBone, AColumnOnTheFloorSinksInByPressureOverStiffness) {
    constexpr double side = 4, mu = 0.1, pressure = 0.05, k = 0.5;
    const double depth = pressure / k, top = side * test::shortened(mu, pressure) - depth;
    const TetMesh mesh = test::block(4, 1);
    ElasticBody body(mesh, std::make_shared<OneLaw<NeoHookean>>(NeoHookean{{mu, 0}}));
    BoneContact contact(contact_nodes(mesh.points, test::faces_at(mesh, 0), {}), mesh.points,
                        test::floor_field(), {.stiffness = k});
    NodeVectors x = mesh.points;
    for (Vec3& p : x) p.z() *= top / side;
    const auto held = test::nodes_at(mesh, side);
    Equilibrium equilibrium({&body, &contact}, x.size(), held, {});
    const auto summary = equilibrium.find(x);
    ASSERT_TRUE(summary.converged) << summary.message;
    const ContactReport report = contact.report();
    const double load = pressure * side * side;
    EXPECT_NEAR(report.force.z(), load, test::kSolved * load);
    EXPECT_NEAR(report.total, load, test::kSolved * load);
    EXPECT_NEAR(report.area, side * side, 1e-9);
    EXPECT_NEAR(report.max_depth, depth, test::kSolved * depth);
    EXPECT_NEAR(report.mean_depth, depth, test::kSolved * depth);
}

// A bone's head pressed step by step into a block that is held below.
TEST(ContactBone, ABallPressedInPushesAsHardAsTheBlockIsHeld) {
    const TetMesh mesh = test::block(8, 1);
    ElasticBody body(
        mesh, std::make_shared<OneLaw<NeoHookean>>(NeoHookean{elasticity::lame_from(0.1, 0.4)}));
    const auto held = test::nodes_at(mesh, 0);
    ContactField ball = test::ball_field(6, 0.5);
    ball.frame.origin = {4, 4, 14.5};  // its lowest point is half a millimetre above
    BoneContact contact(contact_nodes(mesh.points, boundary_faces(mesh.tets), held), mesh.points,
                        ball, {.stiffness = 1});
    NodeVectors x = mesh.points;
    Equilibrium equilibrium({&body, &contact}, x.size(), held, {});
    int iterations = 0;
    double last = 0;
    for (int step = 1; step <= 5; ++step) {
        contact.set_pose({Mat3::Identity(), Vec3(0, 0, -0.4 * step)});
        const auto summary = equilibrium.find(x);
        ASSERT_TRUE(summary.converged) << step << ": " << summary.message;
        iterations += summary.iterations;
        const NodeVectors forces = equilibrium.forces();
        Vec3 reaction = Vec3::Zero();
        for (const std::int32_t n : held) reaction += forces[n];
        const ContactReport report = contact.report();
        // What the tolerance of the forces leaves.
        EXPECT_LT((reaction - report.force).norm(), 1e-4 * (report.total + 1e-3));
        if (step > 1) {
            EXPECT_LT(report.force.z(), last);
        }
        last = report.force.z();
        EXPECT_NEAR(report.max_depth, report.max_pressure, 1e-9);  // k is 1, no gap
    }
    // Measured: 20. With all of the bone's curvature from the start 39, without it 44.
    EXPECT_LE(iterations, 24);
}

}  // namespace
}  // namespace myotet::contraction
