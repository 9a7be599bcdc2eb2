// SPDX-License-Identifier: Apache-2.0
#include "TissueMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Support/AnalyticLevelSet.h"

namespace myotet::app {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kRadius = 10, kEdge = 5;

levelset::Region region(std::int32_t label, int component, double thickness) {
    levelset::Region made;
    made.label = label;
    made.component = component;
    made.voxels = 100;
    made.inscribed_radius = thickness / 2;
    return made;
}

levelset::Region ball(std::int32_t label, int component) {
    levelset::Region made = region(label, component, 2 * kRadius);
    made.phi = support::sample_level_set(support::cube(kRadius + 6), 1,
                                         [](const Vec3& p) { return p.norm() - kRadius; });
    return made;
}

meshing::Options sizes() {
    meshing::Options options;
    options.edge_length = kEdge;
    return options;
}

std::vector<TissueMesh> mesh(levelset::LabelLevelSets& sets, const std::vector<Tissue>& tissues) {
    SilentProgress silent;
    return mesh_tissues(sets, tissues, sizes(), LevelSets::released, silent);
}

TEST(MeshTissues, InThePatientsFrame) {
    levelset::LabelLevelSets sets;
    sets.frame.rotation = Eigen::AngleAxisd(1, Vec3(1, 1, 0).normalized()).toRotationMatrix();
    sets.frame.origin = {100, 200, 300};
    sets.regions.push_back(ball(7, 0));
    const auto made = mesh(sets, {{.label = 7, .name = "ball", .voxels = 100}});
    ASSERT_EQ(made.size(), 1u);
    EXPECT_THAT(made[0].report.broken_promises, IsEmpty());
    EXPECT_EQ(made[0].mesh.labels, std::vector<std::int32_t>(made[0].mesh.tets.size(), 7));
    constexpr double kLatticeOffset = 0.1;  // mm; the lattice is not centred on the ball
    EXPECT_LT((centroid(made[0].mesh) - sets.frame.origin).norm(), kLatticeOffset);
    EXPECT_EQ(made[0].report.components_out, 1);
}

TEST(MeshTissues, ComponentsOfALabelBecomeOneMesh) {
    levelset::LabelLevelSets sets;
    for (int component = 0; component < 2; ++component) {
        sets.regions.push_back(ball(7, component));
        sets.regions.back().phi.origin[0] += 40 * component;
    }
    const auto made = mesh(sets, {{.label = 7, .name = "balls", .voxels = 200}});
    EXPECT_EQ(made[0].report.components_in, 2);
    EXPECT_EQ(made[0].report.components_out, 2);
    EXPECT_GT(made[0].report.distance.max, made[0].report.distance.mean);
    EXPECT_THAT(made[0].report.broken_promises, IsEmpty());
}

TEST(MeshTissues, ReleasesLevelSetsOnlyOnDemand) {
    SilentProgress silent;
    levelset::LabelLevelSets sets;
    sets.regions.push_back(ball(7, 0));
    const std::vector<Tissue> tissues = {{.label = 7, .name = "ball", .voxels = 100}};
    (void)mesh_tissues(sets, tissues, sizes(), LevelSets::kept, silent);
    EXPECT_FALSE(sets.regions[0].phi.values.empty());
    (void)mesh_tissues(sets, tissues, sizes(), LevelSets::released, silent);
    EXPECT_TRUE(sets.regions[0].phi.values.empty());
}

/// Two components, of which the second, of this thickness, could not be meshed.
TissueReport report_with_a_failure(double thickness) {
    const std::vector<levelset::Region> regions = {region(7, 0, 2 * kRadius),
                                                   region(7, 1, thickness)};
    levelset::LabelLevelSets one;
    one.regions.push_back(ball(7, 0));
    std::vector<RegionMesh> made(2);
    made[0].mesh = mesh(one, {{.label = 7, .name = "ball", .voxels = 100}})[0].mesh;
    made[1].failure = "no room";
    return join_regions({.label = 7, .name = "balls", .voxels = 200}, regions, made, kEdge).report;
}

TEST(JoinRegions, AThickComponentWithoutMeshBreaksThePromise) {
    const TissueReport report = report_with_a_failure(2 * kEdge);
    EXPECT_THAT(report.broken_promises,
                ElementsAre(AllOf(HasSubstr("component 1"), HasSubstr("no room"))));
}

TEST(JoinRegions, AThinComponentWithoutMeshIsNoted) {
    const TissueReport report = report_with_a_failure(1.9 * kEdge);
    EXPECT_THAT(report.broken_promises, IsEmpty());
    EXPECT_THAT(report.notes, Contains(AllOf(HasSubstr("component 1"), HasSubstr("no room"))));
    EXPECT_EQ(report.components_in, 2);
    EXPECT_EQ(report.components_out, 1);
}

TEST(JoinRegions, ATissueOfWhichNothingIsLeftBreaksAPromise) {
    std::vector<RegionMesh> made(1);
    made[0].failure = "no room";
    const TissueReport report =
        join_regions({.label = 7}, {region(7, 0, 0.1 * kEdge)}, made, kEdge).report;
    EXPECT_THAT(report.broken_promises, ElementsAre(HasSubstr("no mesh")));
}

}  // namespace
}  // namespace myotet::app
