// SPDX-License-Identifier: Apache-2.0
#include "Fibres/Laplace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "FibreShapes.h"

namespace myotet::fibres {
namespace {

using ::testing::HasSubstr;
// Factors of a matrix of some thousand rows.
constexpr double kRounding = 1e-10;
// Conjugate gradients stop at a residual of 1e-13.
constexpr double kIteration = 1e-9;
constexpr double kDegrees = 1e-5;
// Degrees. The harmonic flow widens less abruptly than the spindle's fibres do: that
// alone is 0.2 in the mean, and the rest is the coarseness of the meshes.
constexpr double kMean = 1, kMost = 5;

struct Case {
    TetMesh mesh;
    std::vector<std::int32_t> origin, insertion;
};

Case cylinder() {
    Case c{test::shaken_cylinder(5, 40), {}, {}};
    c.origin = test::nodes_at(c.mesh, 0);
    c.insertion = test::nodes_at(c.mesh, 40);
    return c;
}

Case spindle(int rings, int layers) {
    Case c{test::fusiform(rings, layers), {}, {}};
    c.origin = test::nodes_at(c.mesh, 0);
    c.insertion = test::nodes_at(c.mesh, phantoms::kFusiformLength);
    return c;
}

TEST(Laplace, IsExactOnAStraightCylinderHoweverItIsMeshed) {
    const Case c = cylinder();
    for (const int most : {0, 100000}) {
        LaplaceOptions options;
        options.most_factored = most;
        const auto potential = laplace_potential(c.mesh, c.origin, c.insertion, options);
        for (std::size_t n = 0; n < potential.size(); ++n)
            EXPECT_NEAR(potential[n], c.mesh.points[n].z() / 40, kIteration);
        const FibreField fibres = laplace_fibres(c.mesh, c.origin, c.insertion, options);
        EXPECT_LT(test::angle_error(c.mesh, fibres, [](const Vec3&) { return Vec3(0, 0, 1); }).most,
                  kDegrees);
        EXPECT_TRUE(fibres.notes.empty());
    }
}

TEST(Laplace, PointsFromOriginToInsertion) {
    const Case c = cylinder();
    for (const Vec3& v : laplace_fibres(c.mesh, c.origin, c.insertion).direction)
        EXPECT_GT(v.z(), 0.99);
    for (const Vec3& v : laplace_fibres(c.mesh, c.insertion, c.origin).direction)
        EXPECT_LT(v.z(), -0.99);
}

TEST(Laplace, GradientsOfALinearFunctionAreExact) {
    const Case c = cylinder();
    const Vec3 slope(0.3, -2, 1.5);
    std::vector<double> values;
    for (const Vec3& p : c.mesh.points) values.push_back(slope.dot(p) + 4);
    for (const Vec3& g : gradients(c.mesh, values)) EXPECT_LT((g - slope).norm(), kRounding);
}

TEST(Laplace, AveragesKeepWhatIsTheSameEverywhere) {
    const Case c = cylinder();
    const std::vector<Vec3> same(c.mesh.tets.size(), Vec3(1, 2, 3));
    for (const Vec3& g : averaged_at_nodes(c.mesh, same))
        EXPECT_LT((g - same[0]).norm(), kRounding);
}

TEST(Laplace, TurnsWithTheMuscle) {
    Case c = spindle(3, 20);
    const FibreField straight = laplace_fibres(c.mesh, c.origin, c.insertion);
    const Mat3 R = test::some_rotation();
    for (Vec3& p : c.mesh.points) p = R * p + Vec3(100, -200, 50);
    const FibreField turned = laplace_fibres(c.mesh, c.origin, c.insertion);
    for (std::size_t t = 0; t < c.mesh.tets.size(); ++t)
        EXPECT_LT((turned.direction[t] - R * straight.direction[t]).norm(), kIteration);
}

TEST(Laplace, FindsTheFibresOfASpindle) {
    test::AngleError coarse;
    for (const int rings : {4, 8}) {
        const Case c = spindle(rings, 10 * rings);
        const FibreField fibres = laplace_fibres(c.mesh, c.origin, c.insertion);
        const auto error = test::angle_error(c.mesh, fibres, phantoms::fusiform_fibre);
        std::cout << c.mesh.tets.size() << " tetrahedra: mean " << error.mean << ", 95 % "
                  << error.share95 << ", most " << error.most << " degrees\n";
        EXPECT_LT(error.mean, kMean);
        EXPECT_LT(error.most, kMost);
        if (rings == 8) {
            EXPECT_LT(error.mean, coarse.mean);
        }
        coarse = error;
    }
}

TEST(Laplace, FindsTheFibresOfASpindleMeshedElsewhere) {
    const std::string name = std::string(MYOTET_SHARED_DIR) + "/research/febio/d/d_D2_tet4_lc2";
    if (!std::filesystem::exists(name + ".nodes"))
        GTEST_SKIP() << "no meshes made elsewhere on this machine";
    Case c{test::spindle_made_elsewhere(name), {}, {}};
    std::ifstream lines(name + ".fibers");
    c.origin = test::nodes_at(c.mesh, 0);
    c.insertion = test::nodes_at(c.mesh, phantoms::kFusiformLength);
    const FibreField fibres = laplace_fibres(c.mesh, c.origin, c.insertion);
    const auto error = test::angle_error(c.mesh, fibres, phantoms::fusiform_fibre);
    std::cout << c.mesh.tets.size() << " tetrahedra: mean " << error.mean << ", 95 % "
              << error.share95 << ", most " << error.most << " degrees\n";
    EXPECT_LT(error.mean, kMean);
    EXPECT_LT(error.most, kMost);
    LaplaceOptions options;
    options.average_gradients = false;
    const FibreField plain = laplace_fibres(c.mesh, c.origin, c.insertion, options);
    EXPECT_GT(test::angle_error(c.mesh, plain, phantoms::fusiform_fibre).mean, error.mean);
    // The file's own fibres are the phantom's.
    std::size_t t = 0;
    for (Vec3 v; lines >> v[0] >> v[1] >> v[2]; ++t)
        EXPECT_LT(
            test::line_angle(v, phantoms::fusiform_fibre(centroid_of(c.mesh, c.mesh.tets.at(t)))),
            1e-3);
    EXPECT_EQ(t, c.mesh.tets.size());
}

TEST(Laplace, TakesANeighboursLineWhereTheGradientVanishes) {
    Case c{test::spindle(4, 10, 40, [](double) { return 5.0; }), {}, {}};
    c.origin = test::nodes_at(c.mesh, 0);
    c.insertion = test::nodes_at(c.mesh, 40);
    // Two layers of nodes belong to the origin: what lies between has no gradient.
    for (std::size_t n = 0; n < c.mesh.points.size(); ++n)
        if (c.mesh.points[n].z() > 0.01 && c.mesh.points[n].z() < 5)
            c.origin.push_back(static_cast<std::int32_t>(n));
    const FibreField fibres = laplace_fibres(c.mesh, c.origin, c.insertion);
    ASSERT_EQ(fibres.notes.size(), 1u);
    EXPECT_THAT(fibres.notes[0], HasSubstr("288 of 2880"));
    for (const Vec3& v : fibres.direction) EXPECT_LT(test::line_angle(v, Vec3::UnitZ()), kDegrees);
}

TEST(Laplace, RefusesWhatHasNoSolution) {
    const Case c = cylinder();
    const auto message = [](const TetMesh& mesh, const auto& origin, const auto& insertion) {
        try {
            (void)laplace_fibres(mesh, origin, insertion);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    using Nodes = std::vector<std::int32_t>;
    EXPECT_THAT(message(c.mesh, Nodes{}, c.insertion), HasSubstr("origin"));
    EXPECT_THAT(message(c.mesh, c.origin, Nodes{-1}), HasSubstr("-1"));
    EXPECT_THAT(message(c.mesh, c.origin, Nodes{1 << 20}), HasSubstr("1048576"));
    EXPECT_THAT(message(c.mesh, c.origin, c.origin), HasSubstr("other"));
    TetMesh two = c.mesh;
    append(two, c.mesh);
    EXPECT_THAT(message(two, c.origin, c.insertion), HasSubstr("connected part"));
    LaplaceOptions options;
    options.pennation.angle_deg = 90;
    EXPECT_THROW((void)laplace_fibres(c.mesh, c.origin, c.insertion, options), InputError);
}

TEST(Laplace, IsTheSameOnOneThreadAndMany) {
    const Case c = spindle(4, 40);
    LaplaceOptions options;
    options.most_factored = 0;
    const FibreField many = laplace_fibres(c.mesh, c.origin, c.insertion, options);
    const ThreadLimit limit(1);
    EXPECT_EQ(laplace_fibres(c.mesh, c.origin, c.insertion, options).direction, many.direction);
}

}  // namespace
}  // namespace myotet::fibres
