// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/ElasticBody.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Parallel.h"
#include "Dynamics/NodeAlgebra.h"
#include "DynamicsShapes.h"
#include "Elasticity/Materials.h"

namespace myotet::dynamics {
namespace {

using elasticity::NeoHookean;

// Central differences over this step err by its square and by rounding / step.
constexpr double kStep = 1e-5, kDifference = 1e-6;

// Stiff below, soft above.
class TwoTissues final : public elasticity::TetLaw {
public:
    explicit TwoTissues(const TetMesh& mesh) {
        for (const Tet& t : mesh.tets) soft_.push_back(mesh.points[t[0]].z() > 1);
    }
    [[nodiscard]] double energy(std::size_t t, const Mat3& F) const override {
        return law_[soft_[t]].energy(F);
    }
    [[nodiscard]] Mat3 stress(std::size_t t, const Mat3& F) const override {
        return law_[soft_[t]].stress(F);
    }
    [[nodiscard]] elasticity::Tangent tangent(std::size_t t, const Mat3& F) const override {
        return law_[soft_[t]].tangent(F);
    }

private:
    NeoHookean law_[2] = {{elasticity::lame_from(3, 0.4)}, {elasticity::lame_from(1, 0.45)}};
    std::vector<int> soft_;
};

struct Bent {
    TetMesh mesh = test::block(2, 1.3);
    ElasticBody body{mesh, std::make_shared<TwoTissues>(mesh)};
    NodeVectors x = mesh.points;

    explicit Bent(double size = 0.15) { add_scaled(1, test::random_vectors(x.size(), size, 2), x); }
    NodeVectors forces(const NodeVectors& at) {
        NodeVectors f(at.size(), Vec3::Zero());
        EXPECT_TRUE(std::isfinite(body.move_to(at)));
        body.add_forces(f);
        return f;
    }
    BlockMatrix stiffness() {
        BlockMatrix K = block_pattern(x.size(), body.cliques());
        (void)body.move_to(x);
        body.add_stiffness(K);
        return K;
    }
};

TEST(ElasticBody, RigidMotionStoresNoEnergyAndPullsNowhere) {
    Bent block(0);
    const Mat3 Q = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vec3& p : block.x) p = Q * p + Vec3(4, 5, 6);
    EXPECT_NEAR(block.body.move_to(block.x), 0, 1e-13);
    for (const Vec3& f : block.forces(block.x)) EXPECT_LT(f.norm(), 1e-13);
}

TEST(ElasticBody, ForcesAreMinusTheGradientOfTheEnergy) {
    Bent block;
    const NodeVectors f = block.forces(block.x);
    for (unsigned seed = 1; seed < 6; ++seed) {
        const NodeVectors d = test::random_vectors(block.x.size(), 1, seed);
        NodeVectors up = block.x, down = block.x;
        add_scaled(kStep, d, up);
        add_scaled(-kStep, d, down);
        const double slope = (block.body.move_to(up) - block.body.move_to(down)) / (2 * kStep);
        EXPECT_NEAR(dot(f, d), -slope, kDifference * (1 + std::abs(slope)));
    }
}

TEST(ElasticBody, StiffnessIsMinusTheDerivativeOfTheForcesAndSymmetric) {
    Bent block;
    const BlockMatrix K = block.stiffness();
    for (unsigned seed = 1; seed < 6; ++seed) {
        const NodeVectors d = test::random_vectors(block.x.size(), 1, seed),
                          e = test::random_vectors(block.x.size(), 1, seed + 10);
        NodeVectors up = block.x, down = block.x;
        add_scaled(kStep, d, up);
        add_scaled(-kStep, d, down);
        NodeVectors slope = block.forces(down);
        add_scaled(-1, block.forces(up), slope);
        const NodeVectors product = multiply(K, d);
        for (std::size_t n = 0; n < d.size(); ++n)
            EXPECT_LT((product[n] - slope[n] / (2 * kStep)).norm(),
                      kDifference * (1 + product[n].norm()));
        EXPECT_NEAR(dot(e, product), dot(d, multiply(K, e)), 1e-11 * std::abs(dot(e, product)));
    }
}

TEST(ElasticBody, TheLargestStepIsThatOfTheFirstTetrahedron) {
    Bent block(0);
    NodeVectors by(block.x.size(), Vec3::Zero());
    EXPECT_EQ(block.body.largest_step(block.x, by), 1);
    by[13] = Vec3(0, 0, -2.6);  // the middle node meets the plane below half way
    EXPECT_NEAR(block.body.largest_step(block.x, by), 0.5, 1e-12);
    add_scaled(0.49, by, block.x);
    EXPECT_TRUE(std::isfinite(block.body.move_to(block.x)));
    add_scaled(0.02, by, block.x);
    EXPECT_FALSE(std::isfinite(block.body.move_to(block.x)));
}

TEST(ElasticBody, SameBytesOnOneThreadOrMany) {
    const auto on = [](int threads) {
        const ThreadLimit limit(threads);
        const TetMesh mesh = test::block(6, 1);
        ElasticBody body(mesh, std::make_shared<TwoTissues>(mesh));
        NodeVectors x = mesh.points;
        add_scaled(1, test::random_vectors(x.size(), 0.1, 2), x);
        const double energy = body.move_to(x);
        NodeVectors f(x.size(), Vec3::Zero());
        body.add_forces(f);
        BlockMatrix K = block_pattern(x.size(), body.cliques());
        body.add_stiffness(K);
        return std::tuple(energy, f, K.value);
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::dynamics
