// SPDX-License-Identifier: Apache-2.0
#include "Contraction/TissueBody.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "LevelSet/Primitives.h"
#include "Support/AnalyticLevelSet.h"

namespace myotet::contraction {
namespace {

levelset::LevelSet ball(const Vec3& centre, double radius) {
    Box box;
    box.include(Vec3(-14, -14, -14));
    box.include(Vec3(14, 14, 34));
    return support::sample_level_set(
        box, 1, [=](const Vec3& p) { return levelset::sphere_distance(p, centre, radius); });
}

// Of a mesh of edges of 4 mm of a ball of 8 mm, by its sagitta.
constexpr double kCoarse = 0.1;

TEST(TissueBody, TissuesThatTouchShareNodesAndKeepTheirLabels) {
    const levelset::LevelSet belly = ball(Vec3(0, 0, 0), 8), cord = ball(Vec3(0, 0, 9), 5),
                             crumb = ball(Vec3(0, 0, 26), 3);
    Frame turned;
    turned.rotation = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()).toRotationMatrix();
    turned.origin = Vec3(100, 0, 0);
    meshing::Options options;
    options.edge_length = 4;
    std::vector<std::string> notes;
    SilentProgress silent;
    const auto made = mesh_of_tissues({{3, "belly", {&belly}}, {5, "cord", {&cord, &crumb}}},
                                      turned, options, notes, silent);
    EXPECT_EQ(made.names, (std::map<std::int32_t, std::string>{{3, "belly"}, {5, "cord"}}));
    std::map<std::int32_t, double> volume;
    double lowest = HUGE_VAL;
    for (std::size_t t = 0; t < made.mesh.tets.size(); ++t) {
        const Tet& n = made.mesh.tets[t];
        const auto& p = made.mesh.points;
        volume[made.mesh.labels[t]] += signed_volume(p[n[0]], p[n[1]], p[n[2]], p[n[3]]);
        // Where the two overlap, the tissue in which the centroid lies deepest.
        const Vec3 c = turned.to_local((p[n[0]] + p[n[1]] + p[n[2]] + p[n[3]]) / 4);
        const double to_belly = c.norm() - 8, to_cord = (c - Vec3(0, 0, 9)).norm() - 5;
        if (std::abs(to_belly - to_cord) > 0.2) {  // level sets of 1 mm
            EXPECT_EQ(made.mesh.labels[t], to_belly < to_cord ? 3 : 5);
        }
    }
    for (const Vec3& p : made.mesh.points) lowest = std::min(lowest, turned.to_local(p).z());
    EXPECT_NEAR(lowest, -8, 8 * kCoarse);
    EXPECT_EQ(volume.size(), 2u);
    // Two balls less the lens they share, pi h^2 (3 r - h) / 3 a side.
    const double ball8 = 4.0 / 3 * M_PI * 512, ball5 = 4.0 / 3 * M_PI * 125;
    const double plane = (81 + 64 - 25) / 18.0, h8 = 8 - plane, h5 = 5 - (9 - plane);
    const double lens = M_PI / 3 * (h8 * h8 * (24 - h8) + h5 * h5 * (15 - h5));
    EXPECT_NEAR((volume[3] + volume[5]) / (ball8 + ball5 - lens), 1, kCoarse);
    bool between = false;
    for (const auto& faces : made.faces) between |= faces.name == "belly|cord";
    EXPECT_TRUE(between);
    EXPECT_THAT(notes, ::testing::Contains(
                           ::testing::StartsWith("1 pieces that touch nothing of the body, 1")));
}

}  // namespace
}  // namespace myotet::contraction
