// SPDX-License-Identifier: Apache-2.0
#include "Play/SoftBody.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "Core/Errors.h"
#include "Dynamics/ElasticBody.h"
#include "Support/PlayShapes.h"

namespace myotet::play {
namespace {

using dynamics::BlockMatrix;
using dynamics::NodeVectors;
using elasticity::NeoHookean;

constexpr double kRounding = 1e-11;

struct Case {
    TetMesh mesh = test::block_at({0, 0, 0}, {6, 5, 4}, {3, 2, 2});
    elasticity::Lame lame = elasticity::lame_from(0.05, 0.45);
    SoftBody soft{mesh.points, mesh.tets, std::vector<elasticity::Lame>(mesh.tets.size(), lame)};
    dynamics::ElasticBody exact{mesh,
                                std::make_shared<elasticity::OneLaw<NeoHookean>>(NeoHookean{lame})};
    BlockMatrix K = dynamics::block_pattern(mesh.points.size(), soft.cliques());

    [[nodiscard]] Eigen::MatrixXd stiffness(const dynamics::Potential& of) {
        K.set_zero();
        of.add_stiffness(K);
        const auto rows = static_cast<Eigen::Index>(K.rows());
        Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * rows, 3 * rows);
        for (Eigen::Index n = 0; n < rows; ++n)
            for (std::size_t i = K.row_start[n]; i < K.row_start[n + 1]; ++i)
                dense.block<3, 3>(3 * n, 3 * K.column[i]) = K.value[i];
        return dense;
    }
};

TEST(SoftBody, energy_and_forces_are_those_of_the_law) {
    Case c;
    const NodeVectors x = test::shaken(c.mesh.points, 0.3, 1);
    const double energy = c.soft.move_to(x), exact = c.exact.move_to(x);
    EXPECT_NEAR(energy, exact, kRounding * exact);
    NodeVectors f(x.size(), Vec3::Zero()), g = f;
    c.soft.add_forces(f);
    c.exact.add_forces(g);
    for (std::size_t n = 0; n < x.size(); ++n) EXPECT_LT((f[n] - g[n]).norm(), kRounding);
}

TEST(SoftBody, stiffness_at_rest_is_the_law_s) {
    Case c;
    (void)c.soft.move_to(c.mesh.points);
    (void)c.exact.move_to(c.mesh.points);
    const Eigen::MatrixXd exact = c.stiffness(c.exact);
    EXPECT_LT((c.stiffness(c.soft) - exact).norm(), kRounding * exact.norm());
}

// One tetrahedron, whose tangent's negative eigenvalues are taken away.
Eigen::MatrixXd projected(const elasticity::RestTet& rest, const Mat3& F, const NeoHookean& law) {
    Eigen::SelfAdjointEigenSolver<elasticity::Tangent> solver(law.tangent(F));
    const elasticity::Tangent positive = solver.eigenvectors() *
                                         solver.eigenvalues().cwiseMax(0).asDiagonal() *
                                         solver.eigenvectors().transpose();
    Eigen::MatrixXd K(12, 12);
    for (int a = 0; a < 4; ++a) {
        const auto row = rest.stiffness_row(positive, a);
        for (int b = 0; b < 4; ++b) K.block<3, 3>(3 * a, 3 * b) = row[b];
    }
    return K;
}

TEST(SoftBody, negative_curvature_is_taken_away_and_no_more) {
    const NodeVectors rest{{0, 0, 0}, {3, 0, 0}, {0.2, 2, 0}, {0.5, 0.3, 4}};
    const std::vector<Tet> tet{{0, 1, 2, 3}};
    const NeoHookean law{elasticity::lame_from(0.05, 0.45)};
    SoftBody body(rest, tet, std::vector<elasticity::Lame>{law.lame});
    const elasticity::RestTet at_rest = elasticity::rest_tet({rest[0], rest[1], rest[2], rest[3]});
    BlockMatrix K = dynamics::block_pattern(4, body.cliques());
    int compressed = 0, dilated = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const NodeVectors x = test::shaken(rest, 1.5, seed);
        if (!std::isfinite(body.move_to(x))) continue;
        K.set_zero();
        body.add_stiffness(K);
        Eigen::MatrixXd dense(12, 12);
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) dense.block<3, 3>(3 * a, 3 * b) = K.value[4 * a + b];
        const Mat3 F = at_rest.gradient({x[0], x[1], x[2], x[3]});
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense);
        EXPECT_GT(solver.eigenvalues()[0], -1e-9 * solver.eigenvalues()[11]) << seed;
        if (law.lame.mu - law.lame.lambda * std::log(F.determinant()) < 0) {
            ++dilated;
            continue;  // bounded, not projected
        }
        ++compressed;
        const Eigen::MatrixXd wanted = projected(at_rest, F, law);
        EXPECT_LT((dense - wanted).norm(), 1e-7 * wanted.norm()) << seed;
    }
    EXPECT_GT(compressed, 40);
    EXPECT_GT(dilated, 10);
}

TEST(SoftBody, an_inverted_tetrahedron_costs_infinitely_much_and_steps_end_before) {
    Case c;
    NodeVectors by(c.mesh.points.size(), Vec3::Zero());
    by[c.mesh.tets[0][0]] = {30, 20, 10};
    (void)c.soft.move_to(c.mesh.points);
    const double s = c.soft.largest_step(c.mesh.points, by);
    EXPECT_NEAR(s, c.exact.largest_step(c.mesh.points, by), kRounding);
    for (const double part : {0.99, 1.01}) {
        NodeVectors x = c.mesh.points;
        for (std::size_t n = 0; n < x.size(); ++n) x[n] += part * s * by[n];
        EXPECT_EQ(std::isfinite(c.soft.move_to(x)), part < 1);
    }
}

TEST(SoftBody, says_what_is_wrong) {
    const NodeVectors flat{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {1, 1, 0}};
    const std::vector<elasticity::Lame> one(1);
    EXPECT_THROW(SoftBody(flat, {{0, 1, 2, 3}}, one), MeshError);
    EXPECT_THROW(SoftBody(flat, {{0, 1, 2, 3}, {0, 1, 2, 3}}, one), InputError);
}

}  // namespace
}  // namespace myotet::play
