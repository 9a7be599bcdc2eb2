// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Attach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Core/Parallel.h"

namespace myotet::contraction {
namespace {

using meshfiles::NamedMesh;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A column of cubes along z, n + 1 squares of four nodes 1 mm apart: node 4 k
/// to 4 k + 3 at z = k. Each cube is five tetrahedra, turned from one to the next.
NamedMesh column(int n) {
    NamedMesh mesh;
    for (int k = 0; k <= n; ++k)
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
            mesh.mesh.points.push_back({double(x), double(y), double(k)});
    constexpr int kEven[5][4] = {
        {0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}, {1, 2, 4, 7}};
    constexpr int kOdd[5][4] = {
        {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 5, 0, 6}, {7, 5, 6, 3}, {0, 3, 6, 5}};
    for (int k = 0; k < n; ++k)
        for (const auto& corners : k % 2 == 0 ? kEven : kOdd) {
            Tet tet{};
            for (int i = 0; i < 4; ++i) tet[i] = 4 * k + corners[i];
            mesh.mesh.tets.push_back(tet);
        }
    mesh.nodes = {{"top", {4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3}}};
    return mesh;
}

/// A closed box from `low` to `high`, outward.
TriMesh box(const Vec3& low, const Vec3& high) {
    TriMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back(
            {(i & 1 ? high : low)[0], (i & 2 ? high : low)[1], (i & 4 ? high : low)[2]});
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

constexpr int kCubes = 10;

Scene scene_of(std::vector<Attachment> attachments) {
    Scene scene;
    scene.file = "scene.yaml";
    scene.bodies = {{.name = "column"}};
    int line = 7;
    for (Attachment& attachment : attachments) {
        attachment.body = "column";
        attachment.line = line++;
    }
    scene.attachments = std::move(attachments);
    return scene;
}

Attachment near(const std::string& bone, double within) {
    return {.bone = bone, .where = Where::near_bone, .within = within};
}
Attachment set(const std::string& name) { return {.where = Where::node_set, .node_set = name}; }
Attachment plane(double z, double within) {
    return {.where = Where::plane, .within = within, .point = {0, 0, z}};
}

std::vector<BoneShape> bones() {
    return {bone_of_surface("below", box({-9, -9, -9}, {9, 9, -0.5})),
            bone_of_surface("above", box({-9, -9, kCubes - 1.5}, {9, 9, kCubes + 9}))};
}

std::vector<HeldNodes> find(const std::vector<Attachment>& attachments) {
    const Scene scene = scene_of(attachments);
    return find_held_nodes(scene, scene.bodies[0], column(kCubes), bones());
}

std::vector<std::int32_t> up_to(std::int32_t from, std::int32_t end) {
    std::vector<std::int32_t> all;
    for (; from < end; ++from) all.push_back(from);
    return all;
}

TEST(Attach, ThePhantomsAreSound) {
    EXPECT_DOUBLE_EQ(volume(column(kCubes).mesh), kCubes);
    for (const Tet& t : column(kCubes).mesh.tets) {
        const auto& p = column(kCubes).mesh.points;
        EXPECT_GT(signed_volume(p[t[0]], p[t[1]], p[t[2]], p[t[3]]), 0);
    }
    EXPECT_DOUBLE_EQ(volume(box({0, 0, 0}, {1, 2, 3})), 6);
}

TEST(Attach, NodesNearABoneOrInsideIt) {
    const auto held = find({near("below", 1.75), near("above", 0)});
    ASSERT_EQ(held.size(), 2u);
    EXPECT_EQ(held[0].attachment, 0u);
    EXPECT_EQ(held[0].nodes, up_to(0, 8));  // z = 0 and 1, 0.5 and 1.5 mm away
    // Inside the bone: z = 9 and 10.
    EXPECT_EQ(held[1].nodes, up_to(4 * (kCubes - 1), 4 * (kCubes + 1)));
}

TEST(Attach, TheDistanceItselfCounts) {
    EXPECT_EQ(find({near("below", 0.5)})[0].nodes, up_to(0, 4));
    EXPECT_EQ(find({plane(2, 1)})[0].nodes, up_to(4, 16));
}

TEST(Attach, NodeSetsAndPlanes) {
    const auto held = find({set("top"), plane(3, 0.25)});
    EXPECT_EQ(held[0].nodes, up_to(4 * kCubes, 4 * kCubes + 4));
    EXPECT_EQ(held[1].nodes, up_to(12, 16));
}

TEST(Attach, OtherBodiesAttachmentsDoNotCount) {
    Scene scene = scene_of({set("top"), plane(3, 0.25)});
    scene.attachments[0].body = "another";
    const auto held = find_held_nodes(scene, scene.bodies[0], column(kCubes), {});
    ASSERT_EQ(held.size(), 1u);
    EXPECT_EQ(held[0].attachment, 1u);
}

TEST(Attach, PointsOfNoTetrahedronCountNowhere) {
    const Scene scene = scene_of({plane(0, 0.1)});
    NamedMesh mesh = column(kCubes);
    mesh.mesh.points.push_back({0, 0, 0});
    EXPECT_EQ(find_held_nodes(scene, scene.bodies[0], mesh, {})[0].nodes, up_to(0, 4));
}

TEST(Attach, LevelSetsAreAskedInTheirFrame) {
    // phi = z - 0.5 of the patient, in coordinates turned by a quarter about x.
    levelset::LevelSet phi;
    phi.spacing = 4;
    phi.coarse_spacing = 4;
    phi.coarse_size = {9, 9, 9};
    phi.origin = {-16, -16, -16};
    phi.bricks = {4, 4, 4};
    phi.brick_of.assign(64, -1);
    Frame frame;
    frame.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    frame.origin = {0, 0, 2};
    for (int k = 0; k < 9; ++k)
        for (int j = 0; j < 9; ++j)
            for (int i = 0; i < 9; ++i) {
                const Vec3 local = phi.origin + 4 * Vec3(i, j, k);
                phi.coarse_values.push_back(static_cast<float>(frame.to_lps(local)[2] - 0.5));
            }
    const std::vector<BoneShape> shapes{bone_of_level_sets("floor", {phi}, frame)};
    const Scene scene = scene_of({near("floor", 0.75)});
    EXPECT_EQ(find_held_nodes(scene, scene.bodies[0], column(kCubes), shapes)[0].nodes,
              up_to(0, 8));
}

TEST(Attach, SameNodesOnOneThreadAndMany) {
    const Scene scene = scene_of({near("below", 200.2), plane(900, 300.1)});
    const NamedMesh mesh = column(1000);
    const auto many = find_held_nodes(scene, scene.bodies[0], mesh, bones());
    const ThreadLimit one(1);
    const auto single = find_held_nodes(scene, scene.bodies[0], mesh, bones());
    for (std::size_t i = 0; i < many.size(); ++i) EXPECT_EQ(many[i].nodes, single[i].nodes);
}

std::string refusal(const std::vector<Attachment>& attachments) {
    try {
        (void)find(attachments);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no refusal";
}

TEST(Attach, WithoutNodesTheNearestDistanceIsSaid) {
    EXPECT_THAT(refusal({near("below", 0.25)}),
                AllOf(StartsWith("scene.yaml:7: no node of 'column' is within 0.25 mm of 'below', "
                                 "the nearest is at 0.5 mm"),
                      HasSubstr("make 'within' longer")));
    EXPECT_THAT(refusal({plane(-3, 1)}), HasSubstr("of the plane, the nearest is at 3 mm"));
}

TEST(Attach, WhatIsNotThereIsRefusedWithWhatIs) {
    EXPECT_THAT(
        refusal({set("tops")}),
        StartsWith("scene.yaml:7: the mesh of 'column' has no node set 'tops'; did you mean "
                   "'top'?"));
    EXPECT_THAT(refusal({near("ulna", 1)}),
                StartsWith("scene.yaml:7: the bone 'ulna' has no shape; known are below, above"));
    const Scene scene = scene_of({set("loose")});
    NamedMesh mesh = column(kCubes);
    mesh.mesh.points.push_back({0, 0, 0});
    mesh.nodes = {{"loose", {static_cast<std::int32_t>(mesh.mesh.points.size()) - 1}}};
    EXPECT_THROW((void)find_held_nodes(scene, scene.bodies[0], mesh, {}), InputError);
}

TEST(Attach, ANodeGoesOneWayOnly) {
    EXPECT_THAT(refusal({near("below", 1.75), plane(1.5, 0.6)}),
                StartsWith("scene.yaml:8: 4 nodes of 'column' (4, 5, 6, 7, counted from 0) would "
                           "go with what is fixed and, by line 7, with 'below'"));
    EXPECT_THAT(refusal({near("below", 1.75), near("below", 1.75)}),
                HasSubstr("8 nodes of 'column' (0, 1, 2, 3, 4, ..., counted from 0)"));
}

TEST(Attach, SomethingMustStayFree) {
    EXPECT_THAT(refusal({near("below", 100)}),
                StartsWith("scene.yaml:7: all 44 nodes of 'column' are held"));
    EXPECT_THAT(refusal({near("below", 5.75), near("above", 3)}), HasSubstr("all 44 nodes"));
}

}  // namespace
}  // namespace myotet::contraction
