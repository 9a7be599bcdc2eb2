// SPDX-License-Identifier: Apache-2.0
#include "Activation/FitCurves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "Activation/FitTerms.h"
#include "ActivationCase.h"
#include "Core/Errors.h"

namespace myotet::activation {
namespace {

// What a fit must recover of activations that made its targets.
constexpr double kRecovered = 1e-3;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kTurn = 2 * std::numbers::pi;

double known(int muscle, double t) { return 0.4 + 0.25 * std::sin(kTurn * t + muscle); }

// Arms and gains that change over a second, and torques of known activations.
FitTargets simulated(int coordinates, int muscles) {
    FitTargets targets;
    for (int k = 0; k <= 100; ++k) {
        const double t = 0.01 * k;
        Demand demand;
        demand.arms.resize(coordinates, muscles);
        Eigen::VectorXd forces(muscles);
        for (int i = 0; i < muscles; ++i) {
            demand.gains.push_back(300 + 100 * i + 50 * std::cos(3 * t + i));
            demand.passive.push_back(5 + i);
            forces[i] = demand.passive.back() + demand.gains.back() * known(i, t);
            for (int c = 0; c < coordinates; ++c)
                demand.arms(c, i) = 30 * std::cos((1 + c) * (0.9 * i + 0.3) + 0.4 * t);
        }
        const Eigen::VectorXd torques = demand.arms * forces;
        demand.torques.assign(torques.data(), torques.data() + coordinates);
        targets.times.push_back(t);
        targets.demands.push_back(demand);
    }
    return targets;
}
double worst(const ActivationCurves& curves) {
    double largest = 0;
    for (double t = 0; t <= 1; t += 0.005) {
        const std::vector<double> a = curves.activations(t);
        for (std::size_t i = 0; i < a.size(); ++i)
            largest = std::max(largest, std::abs(a[i] - known(static_cast<int>(i), t)));
    }
    return largest;
}
const FitOptions kExact{.effort = 1e-9, .smoothness = 1e-14};

TEST(FitCurves, RecoversActivationsFromTorques) {
    const CurveFit fit = fit_curves(simulated(3, 3), kExact);
    EXPECT_EQ(fit.summary.status, Status::converged) << fit.summary.message;
    EXPECT_LE(worst(fit.curves), kRecovered);
    EXPECT_LE(fit.summary.torque_rms, 1);
    EXPECT_FALSE(fit.summary.held_by_bounds);
}

TEST(FitCurves, RecoversActivationsFromForces) {
    FitTargets targets = simulated(1, 2);
    for (std::size_t k = 0; k < targets.times.size(); ++k) {
        std::vector<double> row;
        for (int i = 0; i < 2; ++i) {
            const auto at = static_cast<std::size_t>(i);
            row.push_back(targets.demands[k].passive[at] +
                          targets.demands[k].gains[at] * known(i, targets.times[k]));
        }
        if (k % 3 == 0) row[1] = kUnknown;
        targets.forces.push_back(row);
        targets.demands[k].torques.clear();
        targets.demands[k].arms.resize(0, 2);
    }
    const CurveFit fit = fit_curves(targets, kExact);
    EXPECT_EQ(fit.summary.status, Status::converged) << fit.summary.message;
    EXPECT_LE(worst(fit.curves), kRecovered);
    EXPECT_LE(fit.summary.force_rms, 0.05);
}

TEST(FitCurves, SharesBetweenTorquesAndWhatWasMeasured) {
    // Three muscles, one coordinate: electromyography of two tells the third.
    FitTargets targets = simulated(1, 3);
    for (std::size_t k = 0; k < targets.times.size(); ++k)
        targets.demands[k].measured = {known(0, targets.times[k]), known(1, targets.times[k]),
                                       kUnknown};
    const CurveFit fit = fit_curves(targets, kExact);
    EXPECT_EQ(fit.summary.status, Status::converged) << fit.summary.message;
    EXPECT_LE(worst(fit.curves), kRecovered);
    EXPECT_LE(fit.summary.measured_rms, kRecovered);
}

TEST(FitCurves, OfCurvedPullsToo) {
    FitTargets targets = simulated(2, 2);
    targets.pull = [&targets](std::size_t k, std::size_t i, double a) -> Pull {
        const Demand& demand = targets.demands[k];
        return {demand.passive[i] + demand.gains[i] * (1.3 * a - 0.3 * a * a),
                demand.gains[i] * (1.3 - 0.6 * a)};
    };
    for (std::size_t k = 0; k < targets.times.size(); ++k) {
        Eigen::Vector2d forces;
        for (std::size_t i = 0; i < 2; ++i)
            forces[static_cast<Eigen::Index>(i)] =
                targets.pull(k, i, known(static_cast<int>(i), targets.times[k])).force;
        const Eigen::VectorXd torques = targets.demands[k].arms * forces;
        targets.demands[k].torques = {torques[0], torques[1]};
    }
    const CurveFit fit = fit_curves(targets, kExact);
    EXPECT_EQ(fit.summary.status, Status::converged) << fit.summary.message;
    EXPECT_LE(worst(fit.curves), kRecovered);
}

TEST(FitCurves, SlopeIsThatOfTheCost) {
    FitTargets targets = simulated(2, 3);
    for (Demand& demand : targets.demands) demand.measured = {0.2, kUnknown, 0.7};
    const FitOptions options{.intervals = 6, .dynamics = {3, muscle::ActivationDynamics{}}};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    ActivationCurves curves{{0, 1, 6}, Eigen::MatrixXd(3, 9)};
    for (double& c : curves.coefficients.reshaped()) c = unit(random);
    const FitValue value = fit_value(targets, options, curves);
    for (Eigen::Index j = 0; j < 9; ++j)
        for (Eigen::Index i = 0; i < 3; ++i) {
            const double step = 1e-7;
            ActivationCurves up = curves, down = curves;
            up.coefficients(i, j) += step;
            down.coefficients(i, j) -= step;
            const double difference =
                (fit_value(targets, options, up).cost - fit_value(targets, options, down).cost) /
                (2 * step);
            // Rounding of the cost over the step.
            EXPECT_NEAR(difference, value.slope(i, j),
                        1e-8 * value.cost + 1e-6 * std::abs(difference));
        }
}

TEST(FitCurves, StaysWithinBoundsAndSaysSo) {
    FitTargets targets = simulated(3, 3);
    FitOptions options = kExact;
    options.highest = {0.5, 1, 1};
    options.lowest = {0, 0.3, 0};
    const CurveFit fit = fit_curves(targets, options);
    EXPECT_EQ(fit.summary.status, Status::converged) << fit.summary.message;
    EXPECT_TRUE(fit.summary.held_by_bounds);
    for (double t = 0; t <= 1; t += 0.01) {
        EXPECT_LE(fit.curves.activations(t)[0], 0.5 + 1e-12);
        EXPECT_GE(fit.curves.activations(t)[1], 0.3 - 1e-12);
    }
}

TEST(FitCurves, RisesAndFallsNoFasterThanMusclesCan) {
    // Torques that jump: without limits activation falls at once, with them as the muscle relaxes.
    FitTargets targets;
    for (int k = 0; k <= 200; ++k) {
        targets.times.push_back(0.0025 * k);
        const bool on = k > 60 && k < 120;
        targets.demands.push_back({.torques = {on ? 8000.0 : 500.0},
                                   .arms = Eigen::MatrixXd::Constant(1, 1, 20),
                                   .gains = {500}});
    }
    FitOptions options{.spacing = 0.01, .smoothness = 1e-13};
    const CurveFit free = fit_curves(targets, options);
    options.dynamics = {muscle::ActivationDynamics{}};
    const CurveFit limited = fit_curves(targets, options);
    const auto out_of = [&](const ActivationCurves& curves) {
        double out = 0;
        for (double t = 0; t <= 0.5; t += 0.001) {
            const double u =
                implied_excitation({}, curves.activations(t)[0], curves.rates(t)[0]).value;
            out = std::max({out, -u, u - 1});
        }
        return out;
    };
    EXPECT_GT(out_of(free.curves), 0.5);
    // A penalty gives way a little, most between the times it looks at.
    EXPECT_LT(out_of(limited.curves), 0.05);
    EXPECT_LT(limited.summary.excitation_out, 0.05);
    EXPECT_EQ(limited.summary.status, Status::converged) << limited.summary.message;
}

TEST(FitCurves, ImpliesTheExcitationThatDrivesIt) {
    const muscle::ActivationDynamics dynamics;
    for (const double a : {0.01, 0.3, 0.8})
        for (const double u : {0.0, 0.2, 0.5, 1.0})
            EXPECT_NEAR(implied_excitation(dynamics, a, dynamics.rate(a, u)).value, u, 1e-12);
    for (const double rate : {-4.0, -0.5, 0.5, 8.0}) {
        const double step = 1e-6;
        const Excitation at = implied_excitation(dynamics, 0.4, rate);
        const auto value = [&](double a, double r) {
            return implied_excitation(dynamics, a, r).value;
        };
        EXPECT_NEAR((value(0.4 + step, rate) - value(0.4 - step, rate)) / (2 * step),
                    at.by_activation, 1e-8);
        EXPECT_NEAR((value(0.4, rate + step) - value(0.4, rate - step)) / (2 * step), at.by_rate,
                    1e-8);
    }
}

TEST(FitCurves, IsTheSameEachTime) {
    const FitTargets targets = simulated(2, 4);
    const CurveFit one = fit_curves(targets, {}), two = fit_curves(targets, {});
    EXPECT_EQ(one.summary.status, Status::converged) << one.summary.message;
    EXPECT_EQ(one.curves.coefficients, two.curves.coefficients);
}

TEST(FitCurves, RefusesWhatHasNoMeaning) {
    const FitTargets good = simulated(2, 2);
    EXPECT_THROW((void)fit_curves(good, {.spacing = 0}), InputError);
    EXPECT_THROW((void)fit_curves(good, {.torque_error = kUnknown}), InputError);
    EXPECT_THROW((void)fit_curves(good, {.dynamics = {{}}}), InputError);
    EXPECT_THROW((void)fit_curves(good, {.lowest = {0.5, 0.5}, .highest = {0.4, 1}}), InputError);
    FitTargets bad = good;
    bad.times[3] = bad.times[2];
    EXPECT_THROW((void)fit_curves(bad, {}), InputError);
    bad = good;
    bad.demands.pop_back();
    EXPECT_THROW((void)fit_curves(bad, {}), InputError);
    bad = good;
    bad.forces = {{1, 2}};
    EXPECT_THROW((void)fit_curves(bad, {}), InputError);
}

}  // namespace
}  // namespace myotet::activation
