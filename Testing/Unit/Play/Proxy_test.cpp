// SPDX-License-Identifier: Apache-2.0
#include "Play/Proxy.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Support/PlayShapes.h"

namespace myotet::play {
namespace {

constexpr double kRounding = 1e-12;
const Box kBlock{{0, 0, 0}, {6, 5, 4}};

std::vector<Vec3> points_around() {
    std::vector<Vec3> points(2000, Vec3(3, 2.5, 2));
    return test::shaken(points, 5, 11);
}

// Negative inside.
double distance_to_block(const Vec3& p) {
    const double outside = (p - p.cwiseMax(kBlock.min).cwiseMin(kBlock.max)).norm();
    if (outside > 0) return outside;
    return -std::min((p - kBlock.min).minCoeff(), (kBlock.max - p).minCoeff());
}

TEST(Proxy, distances_are_those_to_the_block) {
    const TetMesh mesh = test::block_at({0, 0, 0}, {6, 5, 4}, {3, 3, 2});
    const Proxy proxy(mesh.points, mesh.tets);
    for (const Vec3& p : points_around()) {
        const Closest at = proxy.closest(mesh.points, p, 100);
        EXPECT_NEAR(at.distance, distance_to_block(p), kRounding);
        EXPECT_NEAR((p - at.point).norm(), std::abs(at.distance), kRounding);
        const Triangle& n = proxy.triangles()[at.triangle];
        Vec3 sum = Vec3::Zero();
        for (int c = 0; c < 3; ++c) sum += at.weight[c] * mesh.points[n[c]];
        EXPECT_LT((sum - at.point).norm(), kRounding);
    }
}

TEST(Proxy, follows_its_nodes) {
    TetMesh mesh = test::block_at({0, 0, 0}, {6, 5, 4}, {3, 3, 2});
    Proxy proxy(mesh.points, mesh.tets);
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vec3& p : mesh.points) p = turn * p + Vec3(10, 20, 30);
    proxy.follow(mesh.points);
    for (const Vec3& p : points_around()) {
        const Closest at = proxy.closest(mesh.points, turn * p + Vec3(10, 20, 30), 100);
        EXPECT_NEAR(at.distance, distance_to_block(p), 100 * kRounding);
    }
}

TEST(Proxy, finds_nothing_beyond_its_reach) {
    const TetMesh mesh = test::block_at({0, 0, 0}, {6, 5, 4}, {2, 2, 2});
    const Proxy proxy(mesh.points, mesh.tets);
    EXPECT_EQ(proxy.closest(mesh.points, {3, 2, 5}, 0.999).triangle, -1);
    EXPECT_GE(proxy.closest(mesh.points, {3, 2, 5}, 1.001).triangle, 0);
}

TEST(Proxy, samples_stand_for_the_whole_surface) {
    const TetMesh mesh = test::block_at({0, 0, 0}, {6, 5, 4}, {3, 3, 2});
    const Proxy proxy(mesh.points, mesh.tets);
    double area = 0;
    for (const Sample& sample : proxy.samples()) {
        area += sample.area;
        EXPECT_NEAR(distance_to_block(sample.at(mesh.points)), 0, kRounding);
    }
    EXPECT_NEAR(area, 2 * (30 + 24 + 20), 1e-10);
    EXPECT_EQ(proxy.samples().size(), proxy.nodes().size() + proxy.triangles().size());
}

TEST(Proxy, a_body_without_tetrahedra_is_refused) {
    EXPECT_THROW(Proxy({{0, 0, 0}}, {}), MeshError);
}

}  // namespace
}  // namespace myotet::play
