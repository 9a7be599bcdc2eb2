// SPDX-License-Identifier: Apache-2.0
// Curves that must keep to what muscles can: redundant muscles, hard torques, and an arm.
#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "Activation/FitCost.h"
#include "Activation/SharedCurves.h"
#include "ActivationCase.h"
#include "Skeleton/ReadOsim.h"

namespace myotet::activation {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Slopes of costs of size 1, beside stiffnesses of 1e5, and costs that should be one.
constexpr double kFlat = 1e-7, kSameCost = 1e-9;

// Two joints and six muscles like those of an upper arm: two extensors with equal arms, arms
// and gains that change, torques that swing and step faster than muscles can. Some bounds hold
// all the time, and limits of excitation in turns.
FitTargets pushed_hard() {
    FitTargets targets;
    for (int k = 0; k <= 100; ++k) {
        const double t = 0.01 * k, w = 2 * std::numbers::pi * t;
        const double b = 30 + 15 * std::sin(w - 1), g = 1 + 0.3 * std::sin(2 * w);
        targets.times.push_back(t);
        targets.demands.push_back(
            {.torques = {2000 * std::cos(w), 4000 * std::sin(w) + (k > 30 ? 5000 : 0)},
             .arms = MatrixXd{{-20, 0, 0, 25, 20, 0}, {-20, -20, -20, b, b, 20}},
             .gains = {600 * g, 500 / g, 500 / g, 500, 350 * g, 700 / g}});
    }
    return targets;
}

// The torque of an elbow that is held: one flexor, three extensors with equal arms.
FitTargets held() {
    FitTargets targets;
    for (int k = 0; k <= 60; ++k) {
        targets.times.push_back(0.01 * k);
        targets.demands.push_back({.torques = {-6000},
                                   .arms = MatrixXd{{30, -20, -20, -20}},
                                   .gains = {600, 500, 400, 400}});
    }
    return targets;
}

FitOptions limited(double spacing, std::size_t muscles) {
    return {.spacing = spacing,
            .torque_error = 90,
            .effort = 0.3,
            .excitation_error = 0.01,
            .dynamics = {muscles, muscle::ActivationDynamics{}}};
}

struct Found {
    BoundsResult result;
    VectorXd x, slope;
};
Found found_from(const FitCost& cost, const VectorXd& start) {
    Found found{.x = start};
    const VectorXd none = VectorXd::Zero(start.size()), all = VectorXd::Ones(start.size());
    found.result = least_within_bounds(
        [&cost](const VectorXd& x, double barrier, bool with) { return cost.at(x, barrier, with); },
        none, all, {.slope = 1e-9}, found.x);
    found.slope = cost.at(found.x, 0, true).slope;
    return found;
}

TEST(FitLimits, ConvergesWhereTorquesAreFasterThanMuscles) {
    for (const double spacing : {0.1, 0.05})
        for (const double error : {0.01, 0.001}) {
            FitOptions options = limited(spacing, 6);
            options.excitation_error = error;
            const CurveFit fit = fit_curves(pushed_hard(), options);
            EXPECT_EQ(fit.summary.status, Status::converged) << fit.summary.message;
            EXPECT_LE(fit.summary.slope, kFlat);
            EXPECT_LE(fit.summary.excitation_out, 0.02);
        }
}

TEST(FitLimits, FromAnyStartItIsTheSameLeast) {
    const FitTargets targets = pushed_hard();
    const FitOptions options = limited(0.1, 6);
    const FitCost cost(targets, options, {0, 1, 10});
    const Found one = found_from(cost, VectorXd::Constant(6 * 13, 0.1));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int trial = 0; trial < 5; ++trial) {
        VectorXd start(6 * 13);
        for (double& c : start) c = unit(random);
        const Found other = found_from(cost, start);
        EXPECT_NEAR(other.result.cost, one.result.cost, kSameCost * one.result.cost);
        EXPECT_LE((other.x - one.x).cwiseAbs().maxCoeff(), 1e-5);
    }
    // Karush, Kuhn and Tucker's conditions.
    int at_bounds = 0;
    for (Eigen::Index i = 0; i < one.x.size(); ++i) {
        EXPECT_GE(one.x[i], 0);
        EXPECT_LE(one.x[i], 1);
        if (one.x[i] > 0) {
            EXPECT_LE(one.slope[i], kFlat);
        }
        if (one.x[i] < 1) {
            EXPECT_GE(one.slope[i], -kFlat);
        }
        at_bounds += one.x[i] == 0 || one.x[i] == 1;
    }
    EXPECT_GT(at_bounds, 5) << "the case tests bounds";
}

TEST(FitLimits, IsTheBestOfEachTimeWhereThatIsConstant) {
    const FitTargets targets = held();
    const CurveFit fit = fit_curves(targets, limited(0.05, 4));
    ASSERT_EQ(fit.summary.status, Status::converged) << fit.summary.message;
    const Distribution best = distribute(targets.demands.front(), DistributionOptions{});
    // Effort takes from torques 2 effort torque_error^2 / capacity^2 of itself: 1e-4.
    for (const double t : {0.0, 0.13, 0.3, 0.6})
        expect_same(fit.curves.activations(t), best.activations, 2e-4);
}

// A term of a time as Ceres wants it.
class CeresTerm final : public ceres::CostFunction {
public:
    CeresTerm(const TargetTerm& term, const SplineBasis::Local& local, int muscles)
        : term_(term), local_(local), muscles_(muscles) {
        set_num_residuals(term.residuals());
        mutable_parameter_block_sizes()->assign(4, muscles);
    }
    bool Evaluate(double const* const* columns, double* residuals,
                  double** jacobians) const override {
        VectorXd a = VectorXd::Zero(muscles_);
        for (std::size_t j = 0; j < 4; ++j)
            a += local_.value[j] * Eigen::Map<const VectorXd>(columns[j], muscles_);
        const TermValues now = term_.evaluate(a);
        Eigen::Map<VectorXd>(residuals, num_residuals()) = now.residuals;
        using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        for (std::size_t j = 0; jacobians != nullptr && j < 4; ++j)
            Eigen::Map<RowMajor>(jacobians[j], num_residuals(), muscles_) =
                local_.value[j] * now.by_activation;
        return true;
    }

private:
    TargetTerm term_;
    SplineBasis::Local local_;
    int muscles_;
};

TEST(FitLimits, AgreesWithCeresWhereNoBoundHolds) {
    // Without limits of excitation; what was measured keeps activations from bounds.
    FitTargets targets = held();
    for (std::size_t k = 0; k < targets.times.size(); ++k)
        targets.demands[k].measured = {0.3, 0.5, 0.4 + 0.2 * std::sin(10 * targets.times[k]), 0.6};
    const FitOptions options{.torque_error = 2000, .smoothness = 0};
    const CurveFit ours = fit_curves(targets, options);
    ASSERT_EQ(ours.summary.status, Status::converged) << ours.summary.message;
    ActivationCurves curves = ours.curves;
    curves.coefficients.setConstant(0.1);
    ceres::Problem problem;
    const auto column = [&](int j) { return curves.coefficients.col(j).data(); };
    for (int j = 0; j < curves.basis.count(); ++j) {
        problem.AddParameterBlock(column(j), 4);
        for (int i = 0; i < 4; ++i) {
            problem.SetParameterLowerBound(column(j), i, 0);
            problem.SetParameterUpperBound(column(j), i, 1);
        }
    }
    for (std::size_t k = 0; k < targets.times.size(); ++k) {
        const SplineBasis::Local local = curves.basis.at(targets.times[k]);
        const int first = local.first;
        problem.AddResidualBlock(
            new CeresTerm(TargetTerm(targets, options, k), local, 4), nullptr,
            {column(first), column(first + 1), column(first + 2), column(first + 3)});
    }
    ceres::Solver::Options how;
    how.linear_solver_type = ceres::DENSE_QR;
    how.function_tolerance = 1e-14;
    how.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(how, &problem, &summary);
    EXPECT_NEAR(ours.summary.cost, summary.final_cost, kSameCost * summary.final_cost);
    EXPECT_LE((ours.curves.coefficients - curves.coefficients).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(FitLimits, ManyMusclesToo) {
    std::mt19937 random(1);
    const Demand one = random_demand(random, 7, 40);
    FitTargets targets;
    for (int k = 0; k <= 100; ++k) {
        Demand demand = one;
        for (double& torque : demand.torques) torque *= k < 40 ? 0.2 : 1;
        targets.times.push_back(0.01 * k);
        targets.demands.push_back(demand);
    }
    FitOptions options = limited(0.05, 40);
    options.effort = 10;
    const CurveFit fit = fit_curves(targets, options);
    EXPECT_EQ(fit.summary.status, Status::converged) << fit.summary.message;
    EXPECT_LE(fit.summary.iterations, 100);
}

TEST(FitLimits, OfAnArmConverges) {
    const skeleton::Model model = skeleton::read_osim(MYOTET_SOURCE_DIR "/Data/arm/arm.osim");
    const skeleton::Table keys{.in_degrees = true,
                               .columns = {"elbow_flexion", "shoulder_flexion"},
                               .times = {0, 0.3, 0.8, 1.3},
                               .rows = {{0, 0}, {0, 0}, {30, 0}, {60, 0}}};
    const auto trajectory = skeleton::make_trajectory(keys, model, skeleton::key_framed());
    std::vector<double> times;
    for (int k = 0; k <= 130; ++k) times.push_back(0.01 * k);
    SilentProgress silent;
    const MuscleMotion motion = follow_muscles(model, trajectory, times, false, silent);
    for (const Tendons tendons : {Tendons::elastic, Tendons::rigid}) {
        SharingOptions options{.tendons = tendons};
        options.held = {true, false};
        const Sharing each = share(model, motion, options, silent);
        for (const double spacing : {0.1, 0.05}) {
            const SharedCurves curves = share_by_curves(model, motion, options, each, spacing);
            EXPECT_EQ(curves.fit.status, Status::converged) << curves.fit.message;
            EXPECT_LE(curves.fit.slope, kFlat);
            EXPECT_LE(curves.fit.iterations, 60);
            EXPECT_LE(curves.fit.excitation_out, 0.01);
            // Measured 0.0030 and 0.0077: the torque has corners, which curves round.
            double squares = 0;
            for (std::size_t t = 0; t < times.size(); ++t)
                for (std::size_t m = 0; m < 3; ++m)
                    squares += std::pow(curves.activations[t][m] - each.at[t].activations[m], 2);
            EXPECT_LE(std::sqrt(squares / (3 * 131.0)), 0.1 * spacing);
        }
    }
}

}  // namespace
}  // namespace myotet::activation
