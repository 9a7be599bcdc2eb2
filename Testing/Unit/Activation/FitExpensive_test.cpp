// SPDX-License-Identifier: Apache-2.0
#include "Activation/FitExpensive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"
#include "Core/Progress.h"

namespace myotet::activation {
namespace {

// Of coefficients within a range of 1: least_step times a step of 0.05.
constexpr double kFound = 1e-4;

// A muscle's force over time, from the knots of its activation, a little curved and each time
// after the last, as a simulation's would be.
Evaluation contraction(const std::vector<double>& c, const std::vector<double>& target) {
    Evaluation out;
    double force = 0;
    for (int k = 0; k < 20; ++k) {
        const double t = k / 19.0 * (static_cast<double>(c.size()) - 1);
        const auto knot = std::min(static_cast<std::size_t>(t), c.size() - 2);
        const double a = c[knot] + (t - static_cast<double>(knot)) * (c[knot + 1] - c[knot]);
        force += 0.5 * (100 * (1.2 * a - 0.2 * a * a) + 3 - force);
        out.residuals.push_back(
            (force - (target.empty() ? 0 : target[static_cast<std::size_t>(k)])) / 5);
    }
    return out;
}
std::vector<double> target_of(const std::vector<double>& c) {
    std::vector<double> target = contraction(c, {}).residuals;
    for (double& t : target) t *= 5;
    return target;
}
ExpensiveOptions within_unit(std::size_t n) {
    return {.lowest = std::vector<double>(n, 0), .highest = std::vector<double>(n, 1)};
}
struct Count final : ProgressSink {
    int notes = 0;
    double last = 0;
    void report(std::string_view, double fraction) override { last = fraction; }
    void warn(std::string_view) override {}
    void note(std::string_view) override { ++notes; }
};

TEST(FitExpensive, FindsKnownActivationsWithFewRuns) {
    const std::vector<double> known = {0.1, 0.7, 0.9, 0.4, 0.2};
    const std::vector<double> target = target_of(known);
    Count progress;
    int runs = 0;
    const Evaluate run = [&](const std::vector<double>& c) {
        ++runs;
        return contraction(c, target);
    };
    ExpensiveOptions options = within_unit(5);
    options.goal = 1e-4;
    options.least_step = 1e-6;
    const ExpensiveFit fit = fit_expensive(run, std::vector<double>(5, 0.3), options, progress);
    EXPECT_EQ(fit.status, Status::converged) << fit.message;
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(fit.coefficients[i], known[i], kFound);
    // One at the start, five for derivatives, a few to learn how pulls bend.
    EXPECT_LE(fit.evaluations, 14);
    EXPECT_EQ(fit.evaluations, runs);
    EXPECT_EQ(progress.notes, runs);
    EXPECT_LE(fit.rms, 1e-4);
    ASSERT_EQ(fit.history.size(), static_cast<std::size_t>(runs));
    for (std::size_t k = 1; k < fit.history.size(); ++k)
        EXPECT_LE(fit.history[k], fit.history[k - 1]);
}

TEST(FitExpensive, UsesSensitivitiesThatAreGiven) {
    // Rosenbrock's valley as a sum of squares.
    const Evaluate run = [](const std::vector<double>& c) {
        Evaluation out{{10 * (c[1] - c[0] * c[0]), 1 - c[0]}, Eigen::MatrixXd(2, 2), ""};
        out.sensitivities << -20 * c[0], 10, -1, 0;
        return out;
    };
    SilentProgress silent;
    const ExpensiveOptions options{
        .lowest = {-2, -2}, .highest = {2, 2}, .evaluations = 60, .goal = 1e-8, .least_step = 1e-8};
    const ExpensiveFit fit = fit_expensive(run, {-1.2, 1}, options, silent);
    EXPECT_EQ(fit.status, Status::converged) << fit.message;
    EXPECT_NEAR(fit.coefficients[0], 1, 1e-6);
    EXPECT_NEAR(fit.coefficients[1], 1, 1e-6);
}

TEST(FitExpensive, StaysWithinBounds) {
    // Of (c0 - 2)^2 + (c0 + c1 - 1.5)^2 + (c1 - 0.2)^2 within [0, 1]: c0 = 1, c1 = 0.35.
    const Evaluate run = [](const std::vector<double>& c) {
        for (const double x : c) EXPECT_TRUE(x >= 0 && x <= 1);
        return Evaluation{{c[0] - 2, c[0] + c[1] - 1.5, c[1] - 0.2}, {}, ""};
    };
    SilentProgress silent;
    const ExpensiveFit fit = fit_expensive(run, {0.5, 0.5}, within_unit(2), silent);
    EXPECT_EQ(fit.status, Status::converged) << fit.message;
    EXPECT_DOUBLE_EQ(fit.coefficients[0], 1);
    EXPECT_NEAR(fit.coefficients[1], 0.35, kFound);
    EXPECT_LE(fit.evaluations, 10);
}

TEST(FitExpensive, GoesRoundWhereTheSimulationFails) {
    const Evaluate run = [](const std::vector<double>& c) -> Evaluation {
        if (c[0] > 0.72) return {{}, {}, "an element turned inside out"};
        return {{std::exp(3 * c[0]) - std::exp(3 * 0.7), c[1] - 0.4}, {}, ""};
    };
    SilentProgress silent;
    const ExpensiveFit fit = fit_expensive(run, {0.1, 0.9}, within_unit(2), silent);
    EXPECT_EQ(fit.status, Status::converged) << fit.message;
    EXPECT_GT(fit.failures, 0);
    EXPECT_NEAR(fit.coefficients[0], 0.7, 10 * kFound);
    EXPECT_NEAR(fit.coefficients[1], 0.4, 10 * kFound);
}

TEST(FitExpensive, SaysWhyItEnds) {
    SilentProgress silent;
    const Evaluate fails = [](const std::vector<double>&) { return Evaluation{{}, {}, "no file"}; };
    const ExpensiveFit failed = fit_expensive(fails, {0.5}, within_unit(1), silent);
    EXPECT_EQ(failed.status, Status::infeasible);
    EXPECT_NE(failed.message.find("no file"), std::string::npos);
    const std::vector<double> target = target_of({0.1, 0.9, 0.4});
    const Evaluate run = [&](const std::vector<double>& c) { return contraction(c, target); };
    ExpensiveOptions options = within_unit(3);
    options.evaluations = 5;
    const ExpensiveFit few = fit_expensive(run, {0.3, 0.3, 0.3}, options, silent);
    EXPECT_EQ(few.status, Status::not_converged);
    EXPECT_EQ(few.evaluations, 5);
    EXPECT_LT(few.rms, few.first_rms);
    // What does not depend on a coefficient leaves it where it was.
    const Evaluate flat = [](const std::vector<double>& c) {
        return Evaluation{{c[0] - 0.5, 1}, {}, ""};
    };
    const ExpensiveFit idle = fit_expensive(flat, {0.2, 0.3}, within_unit(2), silent);
    EXPECT_EQ(idle.status, Status::converged) << idle.message;
    EXPECT_NEAR(idle.coefficients[0], 0.5, 10 * kFound);
    EXPECT_NEAR(idle.coefficients[1], 0.3, kFound);
}

TEST(FitExpensive, IsTheSameEachTime) {
    const std::vector<double> target = target_of({0.1, 0.9, 0.4});
    const Evaluate run = [&](const std::vector<double>& c) { return contraction(c, target); };
    SilentProgress silent;
    const ExpensiveFit one = fit_expensive(run, {0.3, 0.3, 0.3}, within_unit(3), silent);
    const ExpensiveFit two = fit_expensive(run, {0.3, 0.3, 0.3}, within_unit(3), silent);
    EXPECT_EQ(one.coefficients, two.coefficients);
    EXPECT_EQ(one.evaluations, two.evaluations);
}

TEST(FitExpensive, RefusesWhatHasNoMeaning) {
    SilentProgress silent;
    const Evaluate run = [](const std::vector<double>& c) { return Evaluation{{c[0]}, {}, ""}; };
    EXPECT_THROW((void)fit_expensive(run, {2}, within_unit(1), silent), InputError);
    EXPECT_THROW((void)fit_expensive(run, {}, within_unit(0), silent), InputError);
    EXPECT_THROW((void)fit_expensive(run, {0.5}, within_unit(2), silent), InputError);
    ExpensiveOptions options = within_unit(1);
    options.steps = {0};
    EXPECT_THROW((void)fit_expensive(run, {0.5}, options, silent), InputError);
    int calls = 0;
    const Evaluate changing = [&](const std::vector<double>&) {
        return Evaluation{std::vector<double>(static_cast<std::size_t>(++calls), 1.0), {}, ""};
    };
    EXPECT_THROW((void)fit_expensive(changing, {0.5}, within_unit(1), silent), InputError);
}

}  // namespace
}  // namespace myotet::activation
