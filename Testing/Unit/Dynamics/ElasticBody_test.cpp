// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/ElasticBody.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
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
class TwoTissues final : public elasticity::PointLaw {
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

// Soft tissue whose volume's energy is apart.
class Soft final : public elasticity::PointLaw {
public:
    [[nodiscard]] double energy(std::size_t, const Mat3& F) const override {
        return law_.energy(F);
    }
    [[nodiscard]] Mat3 stress(std::size_t, const Mat3& F) const override { return law_.stress(F); }
    [[nodiscard]] elasticity::Tangent tangent(std::size_t, const Mat3& F) const override {
        return law_.tangent(F);
    }
    [[nodiscard]] elasticity::VolumeLaw volume(std::size_t) const override { return {20}; }

private:
    NeoHookean law_{{1, 0.5}};
};

// A body of each kind of points.
struct Any {
    ElasticBody body;
    NodeVectors rest;
};
enum class Kind { linear, patches, patches_of_volume, quadratic };
constexpr Kind kKinds[] = {Kind::linear, Kind::patches, Kind::patches_of_volume, Kind::quadratic};

Any make(Kind kind, int cubes) {
    const TetMesh mesh = test::block(cubes, 1.3);
    const auto of = [](elasticity::Points points, const NodeVectors& rest) {
        return Any{{std::move(points), rest.size(), std::make_shared<Soft>()}, rest};
    };
    if (kind == Kind::linear) return of(elasticity::linear_points(mesh), mesh.points);
    if (kind == Kind::patches) return of(elasticity::patch_points(mesh), mesh.points);
    if (kind == Kind::patches_of_volume)
        return of(elasticity::patch_points(mesh, {.mean_share = 0}), mesh.points);
    const elasticity::QuadraticMesh quadratic = elasticity::quadratic_mesh(mesh);
    return of(elasticity::quadratic_points(quadratic), quadratic.points);
}
NodeVectors bent(const Any& any) {
    NodeVectors x = any.rest;
    add_scaled(1, test::random_vectors(x.size(), 0.06, 2), x);
    return x;
}
NodeVectors forces(Any& any, const NodeVectors& at) {
    NodeVectors f(at.size(), Vec3::Zero());
    EXPECT_TRUE(std::isfinite(any.body.move_to(at)));
    any.body.add_forces(f);
    return f;
}

TEST(ElasticBodyOfAnyPoints, RigidMotionStoresNoEnergyAndPullsNowhere) {
    const Mat3 Q = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (const Kind kind : kKinds) {
        Any any = make(kind, 2);
        for (Vec3& p : any.rest) p = Q * p + Vec3(4, 5, 6);
        EXPECT_NEAR(any.body.move_to(any.rest), 0, 1e-12);
        for (const Vec3& f : forces(any, any.rest)) EXPECT_LT(f.norm(), 1e-12);
    }
}

TEST(ElasticBodyOfAnyPoints, ForcesAndStiffnessAreDerivatives) {
    for (const Kind kind : kKinds) {
        Any any = make(kind, 2);
        const NodeVectors x = bent(any), f = forces(any, x);
        BlockMatrix K = block_pattern(x.size(), any.body.cliques());
        any.body.add_stiffness(K);
        for (unsigned seed = 1; seed < 4; ++seed) {
            const NodeVectors d = test::random_vectors(x.size(), 1, seed),
                              e = test::random_vectors(x.size(), 1, seed + 10);
            NodeVectors up = x, down = x;
            add_scaled(kStep, d, up);
            add_scaled(-kStep, d, down);
            const double slope = (any.body.move_to(up) - any.body.move_to(down)) / (2 * kStep);
            EXPECT_NEAR(dot(f, d), -slope, kDifference * (1 + std::abs(slope)));
            NodeVectors change = forces(any, down);
            add_scaled(-1, forces(any, up), change);
            const NodeVectors product = multiply(K, d);
            for (std::size_t n = 0; n < d.size(); ++n)
                EXPECT_LT((product[n] - change[n] / (2 * kStep)).norm(),
                          kDifference * (1 + product[n].norm()));
            EXPECT_NEAR(dot(e, product), dot(d, multiply(K, e)),
                        1e-11 * std::sqrt(dot(product, product) * dot(e, e)));
        }
    }
}

TEST(ElasticBodyOfAnyPoints, PatchTestUniformStrainIsInEquilibrium) {
    Mat3 A;
    A << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, 0.1, -0.2, 1.1;
    const Mat3 P = Soft().stress(0, A) + Soft().volume(0).pressure(A.determinant()) *
                                             A.determinant() * A.inverse().transpose();
    for (const Kind kind : kKinds) {
        Any any = make(kind, 3);
        NodeVectors x = any.rest;
        for (Vec3& p : x) p = A * p + Vec3(1, 2, 3);
        const NodeVectors f = forces(any, x);
        for (std::size_t n = 0; n < x.size(); ++n) {
            const bool outside = any.rest[n].minCoeff() < 0.1 || any.rest[n].maxCoeff() > 3.8;
            if (!outside) {
                EXPECT_LT(f[n].norm(), 1e-12);
            }
        }
        // Pressures of patches are their tetrahedra's alone: a mean of the shape has none.
        const bool grouped = any.body.points().groups.size() > 0;
        const std::size_t points =
            grouped ? any.body.points().groups.point.size() : any.body.points().size();
        for (std::size_t q = 0; q < points; ++q) {
            EXPECT_LT((any.body.law_stress(q) + any.body.volume_stress(q) - P).norm(), 1e-11);
            EXPECT_LT((any.body.gradients()[q] - A).norm(), 1e-13);
        }
        const double volume = std::pow(3 * 1.3, 3);
        EXPECT_NEAR(any.body.move_to(x) / volume,
                    Soft().energy(0, A) + Soft().volume(0).energy(A.determinant()), 1e-12);
    }
}

TEST(ElasticBodyOfAnyPoints, TheLargestStepEndsAtTheFirstFlatPoint) {
    for (const Kind kind : kKinds) {
        Any any = make(kind, 2);
        NodeVectors by(any.rest.size(), Vec3::Zero());
        by[13] = Vec3(0, 0, -26);
        const double step = any.body.largest_step(any.rest, by);
        EXPECT_GT(step, 0);
        EXPECT_LT(step, 1);
        NodeVectors before = any.rest, after = any.rest;
        add_scaled(0.999 * step, by, before);
        add_scaled(1.001 * step, by, after);
        EXPECT_TRUE(std::isfinite(any.body.move_to(before)));
        EXPECT_FALSE(std::isfinite(any.body.move_to(after)));
    }
}

TEST(ElasticBodyOfAnyPoints, SameBytesOnOneThreadOrMany) {
    for (const Kind kind : kKinds) {
        const auto on = [&](int threads) {
            const ThreadLimit limit(threads);
            Any any = make(kind, kind == Kind::quadratic ? 4 : 6);
            const NodeVectors x = bent(any), f = forces(any, x);
            BlockMatrix K = block_pattern(x.size(), any.body.cliques());
            any.body.add_stiffness(K);
            return std::tuple(any.body.move_to(x), f, K.value);
        };
        EXPECT_EQ(on(1), on(3));
    }
}

}  // namespace
}  // namespace myotet::dynamics
