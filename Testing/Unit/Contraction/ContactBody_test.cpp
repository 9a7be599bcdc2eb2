// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ContactBody.h"

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

// A cube of 4 mm and nodes about it, at rest far away, then near the top and the sides of
// the bent cube.
struct Crowd {
    static constexpr double kSide = 4;
    TetMesh mesh = test::block(4, 1);
    ContactNodes nodes;
    NodeVectors rest = mesh.points, x = mesh.points;

    explicit Crowd(double bend = 0.1, int count = 80) {
        add_scaled(bend, test::random_vectors(x.size(), 1, 2), x);
        for (const Vec3& d : test::random_vectors(count, 1, 3)) {
            nodes.node.push_back(static_cast<std::int32_t>(x.size()));
            nodes.area.push_back(1 + d.x() * d.x());
            rest.push_back(Vec3::Constant(30) + 5 * d);
            x.push_back(Vec3(2 + 1.5 * d.x(), 2 + 1.5 * d.y(), 4 + 0.6 * d.z()));
        }
    }
    [[nodiscard]] BodyContact contact() const {
        BodyContact c(nodes, rest, {mesh.tets, test::cube_field(kSide, 0.5)},
                      {.law = {.stiffness = 2, .gap = 0.3}, .reach = 2});
        return c;
    }
};

TEST(ContactBody, ForcesAndStiffnessAreDerivativesOfTheEnergy) {
    const Crowd crowd;
    BodyContact contact = crowd.contact();
    contact.update_pairs(crowd.x);
    EXPECT_EQ(contact.pairs(), 80u);
    test::expect_derivatives(contact, crowd.x);
    EXPECT_GT(contact.report().nodes, 30);
    EXPECT_LT(contact.report().nodes, 75);
}

TEST(ContactBody, NoForceAndNoTorqueAreLeftOver) {
    const Crowd crowd;
    BodyContact contact = crowd.contact();
    contact.update_pairs(crowd.x);
    const NodeVectors f = test::forces_at(contact, crowd.x);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero(), on_nodes = Vec3::Zero();
    for (std::size_t n = 0; n < f.size(); ++n) {
        force += f[n];
        torque += crowd.x[n].cross(f[n]);
        if (n >= crowd.mesh.points.size()) on_nodes += f[n];
    }
    EXPECT_GT(contact.report().total, 10);
    EXPECT_LT(force.norm(), 100 * test::kRounding);
    EXPECT_LT(torque.norm(), 1000 * test::kRounding);
    EXPECT_LT((on_nodes - contact.report().force).norm(), 100 * test::kRounding);
}

TEST(ContactBody, NoForceWhenApart) {
    const Crowd crowd;
    BodyContact contact = crowd.contact();
    EXPECT_FALSE(contact.update_pairs(crowd.rest));
    EXPECT_EQ(contact.pairs(), 0u);
    EXPECT_EQ(contact.move_to(crowd.rest), 0);
    NodeVectors x = crowd.x;
    for (const std::int32_t n : crowd.nodes.node) x[n].z() += 1.5;
    EXPECT_TRUE(contact.update_pairs(x));
    EXPECT_GT(contact.pairs(), 40u);
    for (const Vec3& f : test::forces_at(contact, x)) EXPECT_EQ(f, Vec3::Zero());
}

TEST(ContactBody, SaysWhenThePatternChanges) {
    Crowd crowd;
    BodyContact contact = crowd.contact();
    EXPECT_TRUE(contact.update_pairs(crowd.x));
    EXPECT_FALSE(contact.update_pairs(crowd.x));
    const auto cliques = contact.cliques();
    EXPECT_EQ(cliques.size(), contact.pairs());
    for (Vec3& p : crowd.x) p += Vec3(1e-4, 0, 0);
    EXPECT_FALSE(contact.update_pairs(crowd.x));
    EXPECT_EQ(contact.cliques().node, cliques.node);
    crowd.x[crowd.nodes.node[5]].z() += 9;
    EXPECT_TRUE(contact.update_pairs(crowd.x));
    EXPECT_EQ(contact.pairs(), 79u);
}

TEST(ContactBody, MovedTogetherNothingChanges) {
    Crowd crowd;
    BodyContact contact = crowd.contact();
    contact.update_pairs(crowd.x);
    const double energy = contact.move_to(crowd.x);
    EXPECT_GT(energy, 1);
    const Mat3 Q = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vec3& p : crowd.x) p = Q * p + Vec3(4, 5, 6);
    EXPECT_NEAR(contact.move_to(crowd.x), energy, energy * 100 * test::kRounding);
    EXPECT_FALSE(contact.update_pairs(crowd.x));
    EXPECT_NEAR(contact.move_to(crowd.x), energy, energy * 100 * test::kRounding);
}

TEST(ContactBody, DistancesAreThoseOfTheStretchedBody) {
    // Twice as high and sheared: the node is 0.2 mm below the top, which is at 8 mm.
    Crowd crowd(0, 1);
    for (Vec3& p : crowd.x) p = {p.x() + 0.3 * p.z(), p.y(), 2 * p.z()};
    crowd.x.back() = {3.2, 2.1, 7.8};
    BodyContact contact = crowd.contact();
    contact.update_pairs(crowd.x);
    (void)contact.move_to(crowd.x);
    EXPECT_NEAR(contact.report().max_depth, 0.2, 1e-5);  // samples are floats
    // The gap is that of the body at rest.
    const double press = 0.2 + 2 * 0.3;
    EXPECT_NEAR(contact.report().max_pressure, 2 * press, 1e-5);
    EXPECT_LT((contact.report().force / contact.report().total - Vec3::UnitZ()).norm(), 1e-5);
}

TEST(ContactBody, OverlapAtRestIsForgivenHoweverTheBodyDeforms) {
    Crowd crowd(0, 1);
    crowd.rest.back() = {2.1, 2.2, 3.6};
    BodyContact contact = crowd.contact();
    NodeVectors x = crowd.rest;
    for (const double stretch : {1.0, 1.7, 0.6}) {
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] = {crowd.rest[n].x(), crowd.rest[n].y(), stretch * crowd.rest[n].z()};
        contact.update_pairs(x);
        EXPECT_NEAR(contact.move_to(x), 0, test::kRounding);
        x.back().z() -= 0.2;
        (void)contact.move_to(x);
        EXPECT_NEAR(contact.report().max_depth, 0.2, 1e-5);
    }
}

TEST(ContactBody, ItsOwnNodesAreLeftOut) {
    Crowd crowd(0, 2);
    crowd.nodes = contact_nodes(crowd.rest, boundary_faces(crowd.mesh.tets), {});
    BodyContact contact = crowd.contact();
    EXPECT_FALSE(contact.update_pairs(crowd.x));
    EXPECT_EQ(contact.pairs(), 0u);
}

TEST(ContactBody, AFlatTetrahedronIsWhereStepsEnd) {
    const Crowd crowd(0, 1);
    NodeVectors x = crowd.x, by(x.size(), Vec3::Zero());
    x.back() = {2.3, 2.2, 3.9};
    BodyContact contact = crowd.contact();
    contact.update_pairs(x);
    for (std::size_t n = 0; n + 1 < x.size(); ++n) by[n].z() = -2 * x[n].z();
    EXPECT_NEAR(contact.largest_step(x, by), 0.5, test::kRounding);
    add_scaled(0.51, by, x);
    EXPECT_FALSE(std::isfinite(contact.move_to(x)));
}

TEST(ContactBody, RefusesWhatBreaksARule) {
    EXPECT_THROW((BodyContactOptions{.law = {.gap = 1}, .reach = 1}).validate(), InputError);
    Crowd crowd(0, 1);
    crowd.mesh.tets.push_back({0, 1, 2, 1000});
    EXPECT_THROW((void)crowd.contact(), InputError);
    crowd.mesh.tets.back() = crowd.mesh.tets.front();
    std::swap(crowd.mesh.tets.back()[0], crowd.mesh.tets.back()[1]);
    EXPECT_THROW((void)crowd.contact(), MeshError);
}

TEST(ContactBody, SameBytesOnOneThreadOrMany) {
    const auto on = [](int threads) {
        const ThreadLimit limit(threads);
        const Crowd crowd(0.1, 2000);
        BodyContact contact = crowd.contact();
        contact.update_pairs(crowd.x);
        const double energy = contact.move_to(crowd.x);
        return std::tuple(energy, test::forces_at(contact, crowd.x),
                          test::stiffness_at(contact, crowd.x).value);
    };
    EXPECT_EQ(on(1), on(3));
}

// A cube and its mirror image below it, which presses and is pressed alike.
struct Twins {
    static constexpr double kSide = 4;
    TetMesh upper = test::block(4, 1), both = upper;
    std::vector<Tet> lower;
    // Half-spaces, so that the cubes press as columns do, up to their edges.
    ContactField upper_shape = test::floor_field(), lower_shape = upper_shape;

    Twins() {
        const auto count = static_cast<std::int32_t>(upper.points.size());
        for (const Vec3& p : upper.points) both.points.emplace_back(p.x(), p.y(), -p.z());
        for (Tet t : upper.tets) {
            for (std::int32_t& n : t) n += count;
            std::swap(t[0], t[1]);
            lower.push_back(t);
        }
        both.tets.insert(both.tets.end(), lower.begin(), lower.end());
        upper_shape.frame.rotation = Vec3(1, -1, -1).asDiagonal();  // turned about x
    }
    [[nodiscard]] BodyContact contact(bool down, double k) const {
        const TetMesh mesh{both.points, down ? upper.tets : lower, {}};
        const ContactNodes nodes = contact_nodes(mesh.points, test::faces_at(mesh, 0), {});
        return {nodes,
                both.points,
                down ? ContactBody{lower, lower_shape} : ContactBody{upper.tets, upper_shape},
                {.law = {.stiffness = k}, .reach = 1}};
    }
};

TEST(ContactBody, TwinsPressEachOtherAlike) {
    const Twins twins;
    NodeVectors x = twins.both.points;
    const std::size_t half = x.size() / 2;
    NodeVectors bend = test::random_vectors(half, 0.1, 5);
    for (std::size_t n = 0; n < half; ++n) {
        x[n] += bend[n] - Vec3(0, 0, 0.2);
        x[half + n] += Vec3(bend[n].x(), bend[n].y(), 0.2 - bend[n].z());
    }
    BodyContact down = twins.contact(true, 1), up = twins.contact(false, 1);
    down.update_pairs(x);
    up.update_pairs(x);
    EXPECT_EQ(down.pairs(), 25u);
    EXPECT_EQ(up.pairs(), 25u);
    const double energy = down.move_to(x);
    EXPECT_GT(energy, 0.1);
    EXPECT_NEAR(up.move_to(x), energy, 1e-5 * energy);  // samples are floats
    const NodeVectors f = test::forces_at(down, x), g = test::forces_at(up, x);
    for (std::size_t n = 0; n < half; ++n)
        EXPECT_LT((f[n] - Vec3(1, 1, -1).cwiseProduct(g[half + n])).norm(), 1e-5);
}

// One pushed down on the other, which is held below: both press with k. (Under four times
// the pressure their ends would buckle sideways.)
TEST(ContactBody, ACubeOnACubeSinksInByPressureOverBothStiffnesses) {
    constexpr double side = Twins::kSide, mu = 0.1, pressure = 0.01, k = 1;
    const double lambda = test::shortened(mu, pressure), depth = pressure / (2 * k);
    const Twins twins;
    ElasticBody body(twins.both, std::make_shared<OneLaw<NeoHookean>>(NeoHookean{{mu, 0}}));
    BodyContact down = twins.contact(true, k), up = twins.contact(false, k);
    NodeVectors x = twins.both.points;
    const double top = 2 * side * lambda - depth - side;
    for (std::size_t n = 0; n < x.size() / 2; ++n) x[n].z() *= top / side;
    auto held = test::nodes_at(twins.both, side);
    for (const std::int32_t n : test::nodes_at(twins.both, -side)) held.push_back(n);
    // Each step sees the stretch s that the one before left; here it changes by a twentieth.
    for (int step = 0; step < 5; ++step) {
        down.update_pairs(x);
        up.update_pairs(x);
        Equilibrium equilibrium({&body, &down, &up}, x.size(), held, {});
        const auto summary = equilibrium.find(x);
        ASSERT_TRUE(summary.converged) << summary.message;
    }
    // A node presses where it is, by the depth below the other's top: the first layer, 1 mm
    // thick, bears so much less of half the load, an eighth of the height.
    const double load = pressure * side * side, part = depth / 8;
    for (const ContactReport& report : {down.report(), up.report()}) {
        EXPECT_NEAR(report.total, load / 2, part * load);
        EXPECT_NEAR(report.area, side * side, 1e-9);
        EXPECT_NEAR(report.max_depth, depth, 2 * part * depth);
        EXPECT_NEAR(report.mean_depth, depth, 2 * part * depth);
    }
    EXPECT_GT(down.report().force.z(), 0);
    EXPECT_LT(up.report().force.z(), 0);
}

}  // namespace
}  // namespace myotet::contraction
