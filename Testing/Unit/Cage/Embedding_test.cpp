// SPDX-License-Identifier: Apache-2.0
#include "Cage/Embedding.h"

#include <gmock/gmock.h>

#include <ctime>
#include <random>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Support/ReferenceCase.h"

namespace myotet::cage {
namespace {

using ::testing::HasSubstr;

constexpr double kRounding = 1e-13;  // of coordinates of about 10

// A block of 10 x 12 x 14 mm whose inner and outer points were shaken.
TetMesh shaken_block() {
    TetMesh mesh = test::five_tet_block({10, 12, 14}, {6, 6, 6});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> by(-0.2, 0.2);
    for (Vec3& p : mesh.points) p += Vec3(by(random), by(random), by(random));
    return mesh;
}

std::vector<Vec3> random_points(std::size_t count, const Vec3& low, const Vec3& high) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0, 1);
    std::vector<Vec3> points(count);
    for (Vec3& p : points)
        p = low + (high - low).cwiseProduct(Vec3(part(random), part(random), part(random)));
    return points;
}

Vec3 sum_of(const Embedding& e, std::size_t i, const std::vector<Vec3>& nodes) {
    Vec3 sum = Vec3::Zero();
    for (int c = 0; c < 4; ++c) sum += e.weights[i][c] * nodes[e.corners[i][c]];
    return sum;
}

TEST(Embedding, weights_sum_to_one_and_give_the_points_back) {
    const TetMesh mesh = shaken_block();
    const auto points = random_points(5000, {0.5, 0.5, 0.5}, {9.5, 11.5, 13.5});
    const Embedding e = embed(mesh, points);
    EXPECT_EQ(e.outside, 0u);
    const auto back = deform(e, mesh.points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(e.weights[i][0] + e.weights[i][1] + e.weights[i][2] + e.weights[i][3], 1,
                    kRounding);
        for (const double w : e.weights[i]) EXPECT_GE(w, -1e-12);
        EXPECT_EQ(e.corners[i], mesh.tets[e.tets[i]]);
        EXPECT_LT((back[i] - points[i]).norm(), 10 * kRounding);
    }
}

TEST(Embedding, affine_maps_of_the_mesh_are_affine_maps_of_the_points) {
    const TetMesh mesh = shaken_block();
    const auto points = random_points(500, {0.5, 0.5, 0.5}, {9.5, 11.5, 13.5});
    Mat3 A;
    A << 1.2, 0.3, 0, -0.1, 0.8, 0.2, 0.4, 0, 1.1;
    const Vec3 b(3, -5, 7);
    std::vector<Vec3> nodes;
    for (const Vec3& p : mesh.points) nodes.emplace_back(A * p + b);
    const auto moved = deform(embed(mesh, points), nodes);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT((moved[i] - (A * points[i] + b)).norm(), 100 * kRounding);
}

TEST(Embedding, the_tree_finds_what_a_search_through_all_finds) {
    const TetMesh mesh = shaken_block();
    const auto points = random_points(2000, {-3, -3, -3}, {13, 15, 17});
    const Embedding e = embed(mesh, points, Outside::nearest);
    std::size_t outside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        bool held = false;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Tet& t : mesh.tets) {
            const TetTree alone(mesh.points, {&t, 1});
            const double d = alone.find(points[i]).distance;
            held = held || d == 0;
            nearest = std::min(nearest, d);
        }
        outside += !held;
        const TetTree found(mesh.points, {&mesh.tets[e.tets[i]], 1});
        EXPECT_DOUBLE_EQ(found.find(points[i]).distance, nearest) << "point " << i;
    }
    EXPECT_EQ(e.outside, outside);
    EXPECT_GT(outside, 500u);
}

TEST(Embedding, distance_outside_is_that_to_the_block) {
    const TetMesh mesh = test::five_tet_block({10, 12, 14}, {3, 3, 3});
    const Box box{{0, 0, 0}, {10, 12, 14}};
    const auto points = random_points(3000, {-9, -9, -9}, {19, 21, 23});
    const TetTree tree(mesh.points, mesh.tets);
    double farthest = 0;
    for (const Vec3& p : points) {
        const double d = (p - p.cwiseMax(box.min).cwiseMin(box.max)).norm();
        EXPECT_NEAR(tree.find(p).distance, d, 1e-12);
        farthest = std::max(farthest, d);
    }
    EXPECT_NEAR(embed(mesh, points, Outside::nearest).farthest, farthest, 1e-12);
}

TEST(Embedding, points_outside_are_refused_or_counted) {
    const TetMesh mesh = test::five_tet_block({10, 12, 14}, {2, 2, 2});
    const std::vector<Vec3> points{{5, 5, 5}, {5, 5, 14.25}, {-3, 5, 5}};
    try {
        (void)embed(mesh, points);
        ADD_FAILURE() << "points outside must be refused";
    } catch (const MeshError& error) {
        EXPECT_THAT(error.what(), HasSubstr("2 points lie outside"));
        EXPECT_THAT(error.what(), HasSubstr("point 2 at (-3, 5, 5) farthest, by 3 mm"));
    }
    const Embedding e = embed(mesh, points, Outside::nearest);
    EXPECT_EQ(e.outside, 2u);
    EXPECT_NEAR(e.farthest, 3, kRounding);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT((sum_of(e, i, mesh.points) - points[i]).norm(), 10 * kRounding);
}

TEST(Embedding, nodes_and_faces_belong_to_one_of_their_tetrahedra) {
    const TetMesh mesh = shaken_block();
    std::vector<Vec3> points = mesh.points;
    for (const Tet& t : mesh.tets)
        points.emplace_back((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3);
    const Embedding e = embed(mesh, points);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        EXPECT_THAT(e.corners[n], ::testing::Contains(static_cast<std::int32_t>(n)));
}

TEST(Embedding, says_what_is_wrong) {
    TetMesh mesh = test::five_tet_block({1, 1, 1}, {1, 1, 1});
    const std::vector<Vec3> inside{{0.5, 0.5, 0.5}};
    EXPECT_THROW((void)embed(mesh, std::vector<Vec3>{{0, std::nan(""), 0}}), InputError);
    EXPECT_THROW((void)embed({}, inside), MeshError);
    const Embedding e = embed(mesh, inside);
    EXPECT_THROW((void)deform(e, std::span(mesh.points).first(1)), InputError);
    std::vector<Vec3> two(2);
    EXPECT_THROW(deform(e, mesh.points, two), InputError);
    std::swap(mesh.tets[1][0], mesh.tets[1][1]);
    try {
        (void)embed(mesh, inside);
        ADD_FAILURE() << "an inverted tetrahedron must be refused";
    } catch (const MeshError& error) {
        EXPECT_THAT(error.what(), HasSubstr("tetrahedron 1 is flat or inverted"));
    }
}

TEST(Embedding, same_on_one_thread_and_many) {
    const TetMesh mesh = shaken_block();
    const auto points = random_points(20000, {-2, -2, -2}, {12, 14, 16});
    const auto with = [&](int threads) {
        const ThreadLimit limit(threads);
        return embed(mesh, points, Outside::nearest);
    };
    const Embedding one = with(1), many = with(4);
    EXPECT_EQ(one.tets, many.tets);
    EXPECT_EQ(one.weights, many.weights);
    EXPECT_EQ(one.outside, many.outside);
    EXPECT_EQ(one.farthest, many.farthest);
}

TEST(Embedding, a_hundred_thousand_points_move_in_little_time) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "sanitizers take most of the time";
#endif
    const ThreadLimit limit(1);
    const TetMesh mesh = test::five_tet_block({10, 12, 14}, {8, 8, 8});
    const auto points = random_points(100000, {0, 0, 0}, {10, 12, 14});
    const Embedding e = embed(mesh, points);
    std::vector<Vec3> moved(points.size());
    constexpr int kTimes = 50;
    const std::clock_t start = std::clock();
    for (int i = 0; i < kTimes; ++i) deform(e, mesh.points, moved);
    const double each = double(std::clock() - start) / CLOCKS_PER_SEC / kTimes;
    RecordProperty("milliseconds", std::to_string(1e3 * each));
    std::printf("deform: %.3f ms of processor time for 100 000 points\n", 1e3 * each);
    EXPECT_LT(each, 0.01) << "0.6 frames of 60 a second; measured 0.5 to 1 ms";
}

}  // namespace
}  // namespace myotet::cage
