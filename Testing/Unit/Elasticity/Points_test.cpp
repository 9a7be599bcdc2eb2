// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "CrookedBlock.h"

namespace myotet::elasticity {
namespace {

// Sums of some hundred terms of size 1 to 10.
constexpr double kRounding = 1e-12;

const TetMesh& crooked() {
    static const TetMesh mesh = test::crooked_block({4, 3, 3});
    return mesh;
}
Mat3 some_matrix() {
    Mat3 A;
    A << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, 0.1, -0.2, 1.1;
    return A;
}
std::vector<Vec3> moved(const std::vector<Vec3>& x, auto&& by) {
    std::vector<Vec3> there;
    for (const Vec3& p : x) there.push_back(by(p));
    return there;
}
double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

// Volumes add up to the body's, those of groups too; moving all nodes together is no
// deformation, and a uniform one is told exactly.
void expect_points(const Points& points, const std::vector<Vec3>& rest, double volume) {
    EXPECT_NEAR(sum(points.volume), volume, kRounding * volume);
    for (const double V : points.volume) EXPECT_GT(V, 0);
    if (points.groups.size() > 0) {
        EXPECT_NEAR(sum(points.groups.volume), volume, kRounding * volume);
    }
    const Mat3 A = some_matrix();
    const auto x = moved(rest, [&](const Vec3& p) { return Vec3(A * p + Vec3(3, -2, 5)); });
    ASSERT_EQ(points.start.size(), points.size() + 1);
    ASSERT_EQ(points.start.back(), points.node.size());
    ASSERT_EQ(points.gradient.size(), points.node.size());
    ASSERT_EQ(points.tet_start.size(), points.size() + 1);
    for (std::size_t q = 0; q < points.size(); ++q) {
        Vec3 total = Vec3::Zero();
        for (std::size_t i = points.start[q]; i < points.start[q + 1]; ++i)
            total += points.gradient[i];
        EXPECT_LT(total.norm(), kRounding);
        EXPECT_LT((points.gradient_of(q, x) - A).norm(), 10 * kRounding);
        const auto nodes = points.nodes(q);
        EXPECT_EQ(std::set<std::int32_t>(nodes.begin(), nodes.end()).size(), nodes.size());
        EXPECT_GE(points.tets(q).size(), 1U);
    }
}

TEST(LinearPoints, TellUniformDeformationsAndTheVolume) {
    const Points points = linear_points(crooked());
    expect_points(points, crooked().points, volume(crooked()));
    ASSERT_EQ(points.size(), crooked().tets.size());
    EXPECT_EQ(points.groups.size(), 0U);
    for (std::size_t q = 0; q < points.size(); ++q) {
        ASSERT_EQ(points.tets(q).size(), 1U);
        EXPECT_EQ(points.tets(q)[0], static_cast<std::int32_t>(q));
        EXPECT_TRUE(std::ranges::equal(points.nodes(q), crooked().tets[q]));
    }
}

TEST(QuadraticPoints, TellUniformDeformationsAndTheVolume) {
    const QuadraticMesh mesh = quadratic_mesh(crooked());
    const Points points = quadratic_points(mesh);
    expect_points(points, mesh.points, volume(crooked()));
    ASSERT_EQ(points.size(), 4 * mesh.tets.size());
    EXPECT_EQ(points.groups.size(), 0U);
    for (std::size_t q = 0; q < points.size(); ++q)
        EXPECT_TRUE(std::ranges::equal(points.nodes(q), mesh.tets[q / 4]));
}

TEST(QuadraticMesh, HasOneMiddleForEachEdge) {
    const QuadraticMesh mesh = quadratic_mesh(crooked());
    constexpr int kEnds[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
    for (const auto& tet : mesh.tets)
        for (int e = 0; e < 6; ++e) {
            const std::int32_t a = tet[kEnds[e][0]], b = tet[kEnds[e][1]], m = tet[4 + e];
            EXPECT_EQ(mesh.points[m], Vec3(0.5 * (mesh.points[a] + mesh.points[b])));
            EXPECT_EQ(middle.try_emplace(std::minmax(a, b), m).first->second, m);
        }
    EXPECT_EQ(mesh.points.size(), crooked().points.size() + middle.size());
}

TEST(QuadraticPoints, TellQuadraticFieldsExactly) {
    // x = p + B (p p^T) q: grad x at a point of the body. With straight edges its places
    // are those of the rule.
    const QuadraticMesh mesh = quadratic_mesh(crooked());
    const Points points = quadratic_points(mesh);
    const Mat3 B = some_matrix();
    const Vec3 w(0.2, -0.1, 0.3);
    const auto x = moved(mesh.points, [&](const Vec3& p) { return Vec3(p + w.dot(p) * (B * p)); });
    const double b = (5 - std::sqrt(5.0)) / 20, a = 1 - 3 * b;
    for (std::size_t q = 0; q < points.size(); ++q) {
        Vec3 place = Vec3::Zero();
        for (std::size_t c = 0; c < 4; ++c)
            place += (c == q % 4 ? a : b) * mesh.points[mesh.tets[q / 4][c]];
        const Mat3 exact = Mat3::Identity() + w.dot(place) * B + B * place * w.transpose();
        EXPECT_LT((points.gradient_of(q, x) - exact).norm(), 100 * kRounding);
    }
}

TEST(QuadraticPoints, RefuseWhatIsNotPositive) {
    TetMesh flat = crooked();
    flat.points[flat.tets[0][0]] = flat.points[flat.tets[0][1]];
    EXPECT_THROW((void)quadratic_points(quadratic_mesh(flat)), MeshError);
    EXPECT_THROW((void)linear_points(flat), MeshError);
    EXPECT_THROW((void)patch_points(flat), MeshError);
}

// The tetrahedra of each patch.
std::vector<std::vector<std::int32_t>> patches_of(const Points& points) {
    std::vector<std::vector<std::int32_t>> all;
    const auto& groups = points.groups;
    for (std::size_t g = 0; g < groups.size(); ++g)
        all.emplace_back(groups.point.begin() + static_cast<std::ptrdiff_t>(groups.start[g]),
                         groups.point.begin() + static_cast<std::ptrdiff_t>(groups.start[g + 1]));
    return all;
}

TEST(PatchPoints, TellUniformDeformationsAndTheVolume) {
    for (const double share : {0.0, 0.5, 0.75}) {
        const Points points = patch_points(crooked(), {.mean_share = share});
        expect_points(points, crooked().points, volume(crooked()));
        const std::size_t means = share > 0 ? points.groups.size() : 0;
        ASSERT_EQ(points.size(), crooked().tets.size() + means);
        double of_means = 0;
        for (std::size_t q = crooked().tets.size(); q < points.size(); ++q)
            of_means += points.volume[q];
        EXPECT_NEAR(of_means, share * volume(crooked()), 1e-10);
    }
}

TEST(PatchPoints, AMeanIsThatOfItsTetrahedra) {
    const Points linear = linear_points(crooked()), points = patch_points(crooked());
    const auto x = moved(crooked().points, [](const Vec3& p) {
        return Vec3(p.x() + 0.1 * p.y() * p.z(), p.y() * p.y(), p.z() - p.x() * p.x());
    });
    const auto patches = patches_of(points);
    for (std::size_t g = 0; g < patches.size(); ++g) {
        const std::size_t q = crooked().tets.size() + g;
        Mat3 mean = Mat3::Zero();
        double all = 0;
        for (const std::int32_t t : patches[g]) {
            mean += linear.volume[t] * linear.gradient_of(t, x);
            all += linear.volume[t];
        }
        EXPECT_LT((points.gradient_of(q, x) - mean / all).norm(), 10 * kRounding);
        EXPECT_TRUE(std::ranges::equal(points.tets(q), patches[g]));
        EXPECT_EQ(points.groups.law[g], static_cast<std::uint32_t>(patches[g].front()));
    }
}

TEST(PatchPoints, PatchesAreConnectedByFacesAndOfOneLabel) {
    const std::vector<Tet> behind = face_neighbours(crooked().tets);
    for (const int size : {1, 4, 7, 8}) {
        std::vector<int> times(crooked().tets.size(), 0);
        for (const auto& patch : patches_of(patch_points(crooked(), {.size = size}))) {
            const std::set<std::int32_t> members(patch.begin(), patch.end());
            std::set<std::int32_t> reached = {patch.front()};
            std::vector<std::int32_t> next = {patch.front()};
            while (!next.empty()) {
                const std::int32_t t = next.back();
                next.pop_back();
                for (const std::int32_t u : behind[t])
                    if (members.contains(u) && reached.insert(u).second) next.push_back(u);
            }
            EXPECT_EQ(reached, members) << "patches of " << size;
            for (const std::int32_t t : patch) {
                ++times[t];
                EXPECT_EQ(crooked().labels[t], crooked().labels[patch.front()]);
            }
        }
        EXPECT_EQ(std::ranges::count(times, 1), std::ssize(times)) << "each in one patch";
    }
}

TEST(PatchPoints, PatchesAreAboutAsLargeAsAsked) {
    for (const int size : {1, 4, 7, 8}) {
        std::size_t tets = 0, small = 0, most = 0;
        const auto patches = patches_of(patch_points(crooked(), {.size = size}));
        for (const auto& patch : patches) {
            tets += patch.size();
            most = std::max(most, patch.size());
            small += 2 * patch.size() < static_cast<std::size_t>(size);
        }
        EXPECT_EQ(tets, crooked().tets.size());
        // What was too small went to neighbours, one to each of a few; none is left alone here.
        EXPECT_LE(most, 2U * size);
        EXPECT_EQ(small, 0U);
        const double mean = static_cast<double>(tets) / static_cast<double>(patches.size());
        EXPECT_GT(mean, 0.7 * size);
        EXPECT_LT(mean, 1.3 * size);
    }
}

TEST(PatchPoints, WhatHasNoNeighbourIsAPatchOfItsOwn) {
    // Two tetrahedra of different labels side by side.
    const TetMesh pair{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
                       {{0, 1, 2, 3}, {0, 2, 1, 4}},
                       {1, 2}};
    EXPECT_EQ(patch_points(pair).groups.size(), 2U);
    TetMesh alike = pair;
    alike.labels = {1, 1};
    EXPECT_EQ(patch_points(alike).groups.size(), 1U);
    alike.labels.clear();
    EXPECT_EQ(patch_points(alike).groups.size(), 1U);
}

TEST(PatchPoints, RefuseSizesAndSharesThatMakeNoSense) {
    EXPECT_THROW((void)patch_points(crooked(), {.size = 0}), InputError);
    EXPECT_THROW((void)patch_points(crooked(), {.size = 65}), InputError);
    EXPECT_THROW((void)patch_points(crooked(), {.mean_share = 1}), InputError);
    EXPECT_THROW((void)patch_points(crooked(), {.mean_share = -0.1}), InputError);
    EXPECT_THROW((void)patch_points(crooked(), {.mean_share = std::nan("")}), InputError);
}

TEST(PatchPoints, SameBytesOnOneThreadOrMany) {
    const auto on = [](int threads) {
        const ThreadLimit limit(threads);
        const Points points = patch_points(test::crooked_block({8, 6, 6}));
        return std::tuple(points.node, points.gradient, points.volume, points.groups.point);
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::elasticity
