// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/QuasiStatic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Dynamics/ElasticBody.h"
#include "DynamicsShapes.h"
#include "Elasticity/Materials.h"

namespace myotet::dynamics {
namespace {

using elasticity::NeoHookean;

// A block between two plates; the upper one is moved by `pose` of the load.
struct Bench {
    TetMesh mesh;
    ElasticBody body;
    NodeVectors x;
    LoadCase load_case;

    Bench(int cubes, const std::function<Vec3(const Vec3&, double)>& pose)
        : mesh(test::block(cubes, 1)),
          body(mesh, std::make_shared<elasticity::OneLaw<NeoHookean>>(
                         NeoHookean{elasticity::lame_from(1, 0.45)})),
          x(mesh.points) {
        for (std::size_t n = 0; n < x.size(); ++n)
            if (x[n].z() == 0 || x[n].z() == cubes)
                load_case.held.push_back(static_cast<std::int32_t>(n));
        load_case.potentials = {&body};
        load_case.apply = [this, cubes, pose](double load, NodeVectors& at) {
            for (const std::int32_t n : load_case.held)
                if (mesh.points[n].z() == cubes) at[n] = pose(mesh.points[n], load);
        };
    }
};

Vec3 squeezed(const Vec3& p, double load) { return {p.x(), p.y(), p.z() * (1 - 0.5 * load)}; }

Vec3 twisted(const Vec3& p, double load) {
    const Vec3 centre(1.5, 1.5, 0);
    const Eigen::AngleAxisd turn(std::numbers::pi * load, Vec3::UnitZ());
    return centre + turn * (p - centre);
}

TEST(ApplyLoad, SqueezesABlockToHalfItsHeight) {
    Bench bench(3, squeezed);
    std::vector<double> loads;
    const LoadSummary summary = apply_load(bench.load_case, {}, bench.x, [&](const LoadState& s) {
        loads.push_back(s.load);
        EXPECT_TRUE(std::isfinite(bench.body.move_to(s.x)));
        EXPECT_LE(s.equilibrium.residual, EquilibriumOptions{}.tolerance);
    });
    EXPECT_TRUE(summary.completed) << summary.message;
    EXPECT_EQ(summary.load, 1);
    EXPECT_EQ(loads.front(), 0);
    EXPECT_EQ(loads.back(), 1);
    EXPECT_EQ(static_cast<int>(loads.size()), summary.steps + 1);
    EXPECT_GT(summary.iterations, 0);
    EXPECT_EQ(bench.x.back().z(), 1.5);
}

TEST(ApplyLoad, TwistsABlockByHalfATurn) {
    Bench bench(3, twisted);
    const LoadSummary summary = apply_load(bench.load_case, {}, bench.x, {});
    EXPECT_TRUE(summary.completed) << summary.message;
    EXPECT_TRUE(std::isfinite(bench.body.move_to(bench.x)));
}

TEST(ApplyLoad, WorkOfThePlatesIsTheEnergyStored) {
    // The trapezoidal rule over the steps: its error falls with their square.
    const auto error = [](double step) {
        Bench bench(3, [](const Vec3& p, double s) { return squeezed(twisted(p, 0.3 * s), s); });
        LoadOptions options{.first_step = step, .most_step = step};
        options.equilibrium.tolerance = 1e-9;
        double work = 0, energy = 0;
        NodeVectors x_before, f_before;
        const LoadSummary summary =
            apply_load(bench.load_case, options, bench.x, [&](const LoadState& s) {
                for (std::size_t n = 0; n < x_before.size(); ++n)
                    work -= 0.5 * (s.forces[n] + f_before[n]).dot(s.x[n] - x_before[n]);
                x_before = s.x;
                f_before = s.forces;
                energy = s.equilibrium.energy;
            });
        EXPECT_TRUE(summary.completed) << summary.message;
        EXPECT_GT(energy, 1);
        return std::abs(work / energy - 1);
    };
    const double coarse = error(0.1), fine = error(0.05);
    EXPECT_LT(fine, 2e-3);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}

TEST(ApplyLoad, ARigidMotionStoresNothing) {
    Bench bench(2, [](const Vec3& p, double) { return p; });
    const auto moved = [](const Vec3& p, double s) -> Vec3 {
        return Eigen::AngleAxisd(3 * s, Vec3(1, 2, 2) / 3) * p + 10 * s * Vec3(1, 0, -1);
    };
    bench.load_case.apply = [&](double load, NodeVectors& at) {
        for (const std::int32_t n : bench.load_case.held) at[n] = moved(bench.mesh.points[n], load);
    };
    const LoadSummary summary = apply_load(bench.load_case, {}, bench.x, {});
    EXPECT_TRUE(summary.completed) << summary.message;
    for (std::size_t n = 0; n < bench.x.size(); ++n)
        EXPECT_LT((bench.x[n] - moved(bench.mesh.points[n], 1)).norm(), 1e-8);
}

TEST(ApplyLoad, StopsWhereTheLoadCannotBeBorneAndSaysSo) {
    // Below a height of zero nothing is positive.
    Bench bench(2, [](const Vec3& p, double load) {
        return Vec3(p.x(), p.y(), p.z() * (1 - 1.25 * load));
    });
    NodeVectors last;
    const LoadSummary summary =
        apply_load(bench.load_case, {}, bench.x, [&](const LoadState& s) { last = s.x; });
    EXPECT_FALSE(summary.completed);
    EXPECT_GT(summary.load, 0.6);
    EXPECT_LT(summary.load, 0.8);
    EXPECT_GT(summary.failed_steps, 0);
    EXPECT_NE(summary.message.find("no equilibrium beyond"), std::string::npos);
    EXPECT_EQ(bench.x, last);
}

TEST(ApplyLoad, ALawMayDependOnTheLoad) {
    // The rest height of a spring along z, as activation would change it.
    class Contracting final : public elasticity::PointLaw {
    public:
        double stretch = 1;
        double energy(std::size_t, const Mat3& F) const override { return law_.energy(F * to()); }
        Mat3 stress(std::size_t, const Mat3& F) const override {
            return law_.stress(F * to()) * to();
        }
        elasticity::Tangent tangent(std::size_t, const Mat3& F) const override {
            elasticity::Tangent C = law_.tangent(F * to());
            for (int i = 6; i < 9; ++i) {
                C.row(i) /= stretch;
                C.col(i) /= stretch;
            }
            return C;
        }

    private:
        [[nodiscard]] Mat3 to() const { return Vec3(1, 1, 1 / stretch).asDiagonal(); }
        NeoHookean law_{elasticity::lame_from(1, 0.3)};
    };
    const auto law = std::make_shared<Contracting>();
    const TetMesh mesh = test::block(2, 1);
    ElasticBody body(mesh, law);
    NodeVectors x = mesh.points;
    // Three nodes hold it without straining it: contraction along z alone is free.
    const LoadCase load_case{
        {&body}, {0, 1, 3}, [&](double load, NodeVectors&) { law->stretch = 1 - 0.3 * load; }};
    const LoadSummary summary = apply_load(load_case, {}, x, {});
    EXPECT_TRUE(summary.completed) << summary.message;
    for (std::size_t n = 0; n < x.size(); ++n)
        EXPECT_LT((x[n] - Vec3(mesh.points[n].cwiseProduct(Vec3(1, 1, 0.7)))).norm(), 1e-4);
}

TEST(ApplyLoad, RefusesOptionsThatMakeNoSense) {
    Bench bench(2, squeezed);
    const auto run = [&](const LoadOptions& options) {
        return apply_load(bench.load_case, options, bench.x, {});
    };
    EXPECT_THROW((void)run({.first_step = 0}), InputError);
    EXPECT_THROW((void)run({.most_step = 0.05}), InputError);
    EXPECT_THROW((void)run({.least_step = std::nan("")}), InputError);
    EXPECT_THROW((void)run({.easy_iterations = -1}), InputError);
    bench.load_case.apply = {};
    EXPECT_THROW((void)run({}), InputError);
}

TEST(ApplyLoad, SameBytesOnOneThreadOrMany) {
    const auto on = [](int threads) {
        const ThreadLimit limit(threads);
        Bench bench(5, squeezed);
        EXPECT_TRUE(apply_load(bench.load_case, {}, bench.x, {}).completed);
        return bench.x;
    };
    EXPECT_EQ(on(1), on(3));
}

}  // namespace
}  // namespace myotet::dynamics
