// SPDX-License-Identifier: Apache-2.0
#include "Fibres/FibreField.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "Core/Errors.h"
#include "FibreShapes.h"
#include "Fibres/Gaps.h"

namespace myotet::fibres {
namespace {

using ::testing::HasSubstr;
// An eigenvector of a 3 x 3 matrix of order 1.
constexpr double kRounding = 1e-12;

TetMesh two_tets() {
    return {
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {1, 2, 3, 4}}, {}};
}

TEST(FibreField, ConstantFibresAreConstantAndOfLengthOne) {
    const FibreField fibres = constant_fibres(two_tets(), Vec3(0, 3, 4));
    ASSERT_EQ(fibres.direction.size(), 2u);
    for (const Vec3& v : fibres.direction) EXPECT_EQ(v, Vec3(0, 0.6, 0.8));
    EXPECT_THROW((void)constant_fibres(two_tets(), Vec3::Zero()), InputError);
    EXPECT_THROW((void)constant_fibres(two_tets(), Vec3(0, std::nan(""), 0)), InputError);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)constant_fibres(two_tets(), Vec3(0, kInfinity, 0)), InputError);
}

TEST(FibreField, AnAverageDoesNotDependOnSigns) {
    const Vec3 a = Vec3(1, 2, 3).normalized(), b = Vec3(1, 2, 2).normalized();
    const std::vector<std::int32_t> group{0, 0};
    const Vec3 same = average({{a, b}, {}}, group).at(0);
    EXPECT_LT((same - (a + b).normalized()).norm(), kRounding);
    const Vec3 other = average({{a, -b}, {}}, group).at(0);
    EXPECT_LT(std::min((same - other).norm(), (same + other).norm()), kRounding);
}

TEST(FibreField, AnAverageTurnsWithTheFibres) {
    const Mat3 R = test::some_rotation();
    FibreField fibres, turned;
    for (int n = 0; n < 8; ++n) {
        fibres.direction.push_back(Vec3(0.1 * n, std::sin(n), 2).normalized());
        turned.direction.push_back(R * fibres.direction.back());
    }
    const std::vector<std::int32_t> group{0, 1, 0, 1, -1, 0, 1, 0};
    const std::vector<double> weight{1, 2, 3, 1, 2, 3, 1, 2};
    const auto mean = average(fibres, group, weight), mean_turned = average(turned, group, weight);
    ASSERT_EQ(mean.size(), 2u);
    for (int g = 0; g < 2; ++g) {
        EXPECT_LT((R * mean[g] - mean_turned[g]).norm(), kRounding);
        EXPECT_NEAR(mean[g].norm(), 1, kRounding);
    }
}

TEST(FibreField, AnAverageOfOneIsItselfAndOfNoneIsRefused) {
    const FibreField fibres{{Vec3::UnitX(), Vec3::UnitY()}, {}};
    const auto mean = average(fibres, std::vector<std::int32_t>{1, 0});
    EXPECT_LT((mean[0] - Vec3::UnitY()).norm() + (mean[1] - Vec3::UnitX()).norm(), kRounding);
    EXPECT_EQ(average(fibres, std::vector<std::int32_t>{0, 0}).at(0), Vec3::UnitX());  // a tie
    EXPECT_THROW((void)average(fibres, std::vector<std::int32_t>{0}), InputError);
    EXPECT_THROW((void)average(fibres, std::vector<std::int32_t>{0, 2}), InputError);
    EXPECT_THROW((void)average(fibres, std::vector<std::int32_t>{0, -2}), InputError);
    EXPECT_THROW((void)average(fibres, std::vector<std::int32_t>{0, 1}, std::vector<double>{1, -1}),
                 InputError);
}

TEST(FibreField, GapsTakeTheirNeighboursLine) {
    const TetMesh mesh = test::spindle(2, 12, 12, [](double) { return 2.0; });
    std::vector<Vec3> direction(mesh.tets.size(), Vec3::UnitZ());
    for (std::size_t t = 40; t < direction.size(); t += 2) direction[t] = -Vec3::UnitZ();
    std::fill(direction.begin() + 100, direction.begin() + 400, Vec3::Zero());
    EXPECT_EQ(fill_gaps(mesh, direction), 300u);
    for (const Vec3& v : direction) EXPECT_LT(test::line_angle(v, Vec3::UnitZ()), 1e-6);
    std::fill(direction.begin(), direction.end(), Vec3::Zero());
    EXPECT_THROW(fill_gaps(mesh, direction), MeshError);
}

TEST(FibreField, MeshesThatCannotCarryFibresAreRefusedByNumber) {
    TetMesh mesh = two_tets();
    try {
        std::swap(mesh.tets[1][0], mesh.tets[1][1]);
        require_positive(mesh);
        require_positive({mesh.points, {{1, 2, 3, 4}}, {}});
        FAIL();
    } catch (const MeshError& error) {
        EXPECT_THAT(error.what(), HasSubstr("tetrahedron"));
    }
    EXPECT_THROW(require_positive({mesh.points, {{0, 1, 2, 9}}, {}}), MeshError);
    EXPECT_THROW(require_positive({mesh.points, {}, {}}), MeshError);
}

}  // namespace
}  // namespace myotet::fibres
