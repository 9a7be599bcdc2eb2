// SPDX-License-Identifier: Apache-2.0
#include "Activation/Distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ActivationCase.h"
#include "Core/Errors.h"

namespace myotet::activation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(Distribution, OfTwoMusclesIsTheClosedForm) {
    // Least a1^2 + a2^2 with r1 g1 a1 + r2 g2 a2 = T: a_i = r_i g_i T / sum (r g)^2.
    Demand demand{.torques = {6000}, .arms = Eigen::RowVector2d(30, 20), .gains = {500, 300}};
    const Distribution found = distribute(demand, {});
    expect_solved(found);
    const double t1 = 15000, t2 = 6000, sum = t1 * t1 + t2 * t2;
    expect_same(found.activations, {t1 * 6000 / sum, t2 * 6000 / sum}, 1e-10);
    EXPECT_NEAR(found.forces[0], 500 * t1 * 6000 / sum, 1e-7);
    EXPECT_NEAR(found.cost, 6000.0 * 6000 / sum, 1e-9);
    // d cost / d T = 2 T / sum.
    EXPECT_NEAR(found.prices[0] / (2 * 6000 / sum), 1, 1e-7);
    // Least stress cubed: (F / A)^2 r / A shared.
    const DistributionOptions cubed{
        .criterion = Criterion::stress, .exponent = 3, .areas = {1000, 400}};
    const Distribution stress = distribute(demand, cubed);
    expect_solved(stress);
    const double ratio = std::sqrt(30.0 / 20 * std::pow(1000.0 / 400, 3));
    EXPECT_NEAR(stress.forces[0] / stress.forces[1], ratio, 1e-6);
}

TEST(Distribution, DoesNotDependOnUnitsWeightsScaleOrOrder) {
    std::mt19937 random(3);
    const Demand demand = random_demand(random, 2, 5);
    DistributionOptions options{.exponent = 3, .weights = {1, 2, 3, 4, 5}};
    const Distribution found = distribute(demand, options);
    Demand scaled = demand;
    for (double& t : scaled.torques) t *= 1e-3;
    scaled.arms *= 1e-3;
    for (double& w : options.weights) w *= 1e6;
    expect_same(distribute(scaled, options).activations, found.activations, kSame);
    Demand turned = demand;
    std::vector<double> expected = found.activations;
    turned.arms = demand.arms.rowwise().reverse();
    for (auto* v : {&turned.gains, &turned.passive, &options.weights, &expected})
        std::reverse(v->begin(), v->end());
    expect_same(distribute(turned, options).activations, expected, kSame);
}

TEST(Distribution, OfAMirroredProblemIsTheSame) {
    std::mt19937 random(4);
    const Demand demand = random_demand(random, 2, 6);
    Demand mirrored = demand;
    mirrored.arms *= -1;
    for (double& t : mirrored.torques) t *= -1;
    expect_same(distribute(mirrored, {}).activations, distribute(demand, {}).activations, kSame);
}

TEST(Distribution, CostsMoreTheMoreIsAskedAndTheLessIsAllowed) {
    std::mt19937 random(5);
    Demand demand{.torques = {0}, .arms = Eigen::RowVector3d(30, 25, 10), .gains = {500, 300, 800}};
    double before = -1;
    for (double torque = 0; torque < 25000; torque += 1000) {
        demand.torques[0] = torque;
        const Distribution found = distribute(demand, {});
        expect_solved(found);
        EXPECT_GT(found.cost, before);
        before = found.cost;
        Demand narrower = demand;
        narrower.highest = {0.9, 1, 1};
        EXPECT_GE(distribute(narrower, {}).cost, found.cost - 1e-9);
    }
}

TEST(Distribution, SharesAmongEqualMusclesEqually) {
    const Demand demand{.torques = {10000},
                        .arms = Eigen::RowVectorXd::Constant(7, 30),
                        .gains = std::vector<double>(7, 100)};
    for (const double p : {2.0, 3.0}) {
        const Distribution found = distribute(demand, {.exponent = p});
        expect_solved(found);
        for (const double a : found.activations) EXPECT_NEAR(a, 10000.0 / 21000, kSame);
    }
    // Cut in two, by volumes: the halves do what the whole did.
    const Demand whole{.torques = {9000}, .arms = Eigen::RowVector2d(30, 20), .gains = {400, 300}};
    const Demand halves{
        .torques = {9000}, .arms = Eigen::RowVector3d(30, 30, 20), .gains = {200, 200, 300}};
    const Distribution one = distribute(whole, {.weights = {2, 1}});
    const Distribution two = distribute(halves, {.weights = {1, 1, 1}});
    EXPECT_NEAR(one.activations[0], two.activations[0], kSame);
    EXPECT_NEAR(one.activations[0], two.activations[1], kSame);
}

TEST(Distribution, OfOneMuscleDoesWhatItMust) {
    const Demand demand{.torques = {6000},
                        .arms = Eigen::MatrixXd::Constant(1, 1, 20),
                        .gains = {500},
                        .passive = {100}};
    const Distribution found = distribute(demand, {});
    expect_solved(found);
    EXPECT_NEAR(found.activations[0], (300.0 - 100) / 500, 1e-10);
    EXPECT_EQ(found.bounds[0], 0);
}

TEST(Distribution, ReachesTheVeryMost) {
    const Demand demand{
        .torques = {10000}, .arms = Eigen::RowVector2d(20, -10), .gains = {500, 300}};
    const Distribution found = distribute(demand, {});
    expect_solved(found);
    expect_same(found.activations, {1, 0}, kSame);
    EXPECT_EQ(found.bounds, (std::vector<int>{1, -1}));
}

TEST(Distribution, SaysWhatMusclesCannotDo) {
    Demand demand{
        .torques = {12000, 100}, .arms = Eigen::Matrix2d{{20, -10}, {0, 5}}, .gains = {500, 300}};
    const DistributionOptions named{.coordinate_names = {"shoulder", "elbow"}};
    const Distribution found = distribute(demand, named);
    EXPECT_EQ(found.status, Status::infeasible);
    EXPECT_NE(found.message.find("shoulder"), std::string::npos) << found.message;
    EXPECT_NEAR(found.activations[0], 1, kSame);
    double missing = std::abs(found.missing[0]) / 12000 + std::abs(found.missing[1]) / 1500;
    EXPECT_GT(missing, 0.1);
    EXPECT_LE(found.torque_residual, kTorque);
    // No muscle passes the second coordinate.
    demand.arms.row(1).setZero();
    demand.torques[0] = 5000;
    const Distribution none = distribute(demand, named);
    EXPECT_EQ(none.status, Status::infeasible);
    EXPECT_NE(none.message.find("elbow"), std::string::npos) << none.message;
    EXPECT_EQ(none.message.find("shoulder"), std::string::npos) << none.message;
    EXPECT_NEAR(none.missing[1], 100, 1e-6);
    EXPECT_EQ(none.missing[0], 0);
}

TEST(Distribution, ReservesHelpOnlyWhereMusclesCannot) {
    std::mt19937 random(6);
    for (int trial = 0; trial < 20; ++trial) {
        Demand demand = random_demand(random, 2, 6);
        const DistributionOptions helped{.reserves = {1000, 1000}};
        const Distribution alone = distribute(demand, {}), both = distribute(demand, helped);
        expect_solved(both);
        expect_same(both.activations, alone.activations, kSame);
        for (const double r : both.reserves) EXPECT_NEAR(r, 0, kTorque);
        double most = 0;
        for (std::size_t i = 0; i < 6; ++i) {
            const double arm = demand.arms(0, static_cast<Eigen::Index>(i));
            most += arm * (demand.passive[i] + (arm > 0 ? demand.gains[i] : 0));
        }
        demand.torques[0] = most + 5000;
        const Distribution beyond = distribute(demand, helped);
        expect_solved(beyond);
        EXPECT_GE(beyond.reserves[0], 5000 - kTorque);
    }
}

TEST(Distribution, LeavesAHeldCoordinateToWhatHoldsIt) {
    const Demand demand{
        .torques = {6000, 77}, .arms = Eigen::Matrix2d{{30, 20}, {10, -40}}, .gains = {500, 300}};
    const Distribution found = distribute(demand, {.reserves = {0, kInfinity}});
    expect_solved(found);
    Demand alone = demand;
    alone.torques = {6000};
    alone.arms = demand.arms.topRows(1);
    expect_same(found.activations, distribute(alone, {}).activations, kSame);
    EXPECT_NEAR(found.reserves[1], 77 - 10 * found.forces[0] + 40 * found.forces[1], 1e-9);
}

TEST(Distribution, LeavesMusclesWithoutGainAtTheirLeast) {
    const Demand demand{.torques = {6000},
                        .arms = Eigen::RowVector3d(30, 20, 25),
                        .gains = {500, 0, 300},
                        .lowest = {0, 0.05, 0}};
    for (const Criterion criterion : {Criterion::activation, Criterion::stress}) {
        const Distribution found = distribute(demand, {.criterion = criterion, .areas = {9, 9, 9}});
        expect_solved(found);
        EXPECT_NEAR(found.activations[1], 0.05, kSame);
        EXPECT_EQ(found.bounds[1], -1);
    }
}

TEST(Distribution, OfRedundantCoordinatesIsThatOfOne) {
    Demand demand{
        .torques = {6000, 6000}, .arms = Eigen::Matrix2d{{30, 20}, {30, 20}}, .gains = {500, 300}};
    const Distribution twice = distribute(demand, {});
    expect_solved(twice);
    EXPECT_NEAR(twice.activations[0], 15000.0 * 6000 / (15000.0 * 15000 + 6000 * 6000), kSame);
}

TEST(Distribution, KeepsGivenActivationsAndBounds) {
    Demand demand{.torques = {9000},
                  .arms = Eigen::RowVector3d(30, 20, -25),
                  .gains = {500, 300, 400},
                  .lowest = {0.2, 0.1, 0.3},
                  .highest = {0.4, 1, 0.3}};
    const Distribution found = distribute(demand, {});
    expect_solved(found);
    EXPECT_DOUBLE_EQ(found.activations[2], 0.3);
    EXPECT_LE(found.activations[0], 0.4);
    EXPECT_NEAR(found.activations[1], (9000 + 3000 - 15000 * 0.4) / 6000, kSame);
    const Demand all{.torques = {1000},
                     .arms = Eigen::MatrixXd::Constant(1, 1, 10),
                     .gains = {500},
                     .lowest = {0.2},
                     .highest = {0.2}};
    expect_solved(distribute(all, {}));
}

TEST(Distribution, FollowsWhatWasMeasured) {
    Demand demand{.torques = {6000},
                  .arms = Eigen::RowVector3d(30, 20, -25),
                  .gains = {500, 300, 400},
                  .measured = {kUnknown, kUnknown, 0.25}};
    const Distribution much = distribute(demand, {.tracking = 1e4});
    expect_solved(much);
    EXPECT_NEAR(much.activations[2], 0.25, 1e-3);
    // Between: with T the weight and t the torques, 2 a = l t, but of the third
    // 2 a + 2 T (a - 0.25) = l t.
    const double T = 10, t0 = 15000, t1 = 6000, t2 = -10000;
    const double l =
        (6000 - t2 * 0.5 * T / (2 + 2 * T)) / ((t0 * t0 + t1 * t1) / 2 + t2 * t2 / (2 + 2 * T));
    const Distribution some = distribute(demand, {.tracking = T});
    expect_solved(some);
    expect_same(some.activations, {l * t0 / 2, l * t1 / 2, (l * t2 + 0.5 * T) / (2 + 2 * T)},
                kSame);
    EXPECT_LT(distribute(demand, {}).activations[2], kSame);
}

TEST(Distribution, DrivesMusclesBySynergies) {
    Demand demand{
        .torques = {6000}, .arms = Eigen::RowVector3d(30, 20, -25), .gains = {500, 300, 400}};
    DistributionOptions options;
    options.synergies = Eigen::MatrixXd{{1, 0}, {0.5, 0}, {0, 1}};
    const Distribution found = distribute(demand, options);
    expect_solved(found);
    // One synergy does it: 15000 c + 3000 c = 6000.
    EXPECT_NEAR(found.amounts[0], 1.0 / 3, kSame);
    EXPECT_NEAR(found.activations[1], 1.0 / 6, kSame);
    EXPECT_NEAR(found.amounts[1], 0, kSame);
    // The identity's synergies are muscles.
    std::mt19937 random(7);
    const Demand any = random_demand(random, 2, 6);
    options.synergies = Eigen::MatrixXd::Identity(6, 6);
    const Distribution same = distribute(any, options);
    expect_solved(same);
    expect_same(same.activations, distribute(any, {}).activations, kSame);
    // Synergies that cannot do what is asked, and bounds they cannot keep.
    options.synergies = Eigen::MatrixXd{{0.0}, {0.0}, {1.0}};
    EXPECT_EQ(distribute(demand, options).status, Status::infeasible);
    options.synergies = Eigen::MatrixXd{{1.0}, {1.0}, {0.0}};
    demand.lowest = {0, 0, 0.2};
    const Distribution outside = distribute(demand, options);
    EXPECT_EQ(outside.status, Status::infeasible) << outside.message;
    EXPECT_NE(outside.message.find("muscle 2"), std::string::npos) << outside.message;
}

TEST(Distribution, OfCurvedPullsSolvesTheirConditions) {
    // Pulls that saturate, as behind an elastic tendon: F = g (1.2 a - 0.2 a^2) + 10.
    Demand demand{.torques = {6000, 1000},
                  .arms = Eigen::MatrixXd{{30, 20, -25, 12}, {5, -10, 14, 9}},
                  .gains = {500, 300, 400, 350}};
    const PullOf pull = [&](std::size_t i, double a) -> Pull {
        return {demand.gains[i] * (1.2 * a - 0.2 * a * a) + 10, demand.gains[i] * (1.2 - 0.4 * a)};
    };
    const Distribution found = distribute(demand, pull, {});
    expect_solved(found);
    double worst = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double a = found.activations[i];
        EXPECT_NEAR(found.forces[i], pull(i, a).force, 1e-6);
        double slope = 2 * a;
        for (int c = 0; c < 2; ++c)
            slope -= found.prices[static_cast<std::size_t>(c)] *
                     demand.arms(c, static_cast<int>(i)) * pull(i, a).slope;
        worst = std::max(worst, found.bounds[i] == 0 ? std::abs(slope) : std::max(0.0, -slope));
    }
    EXPECT_LE(worst, 1e-8);
    // Proportional pulls are the convex problem.
    const PullOf straight = [&](std::size_t i, double a) -> Pull {
        return {demand.gains[i] * a, demand.gains[i]};
    };
    expect_same(distribute(demand, straight, {}).activations, distribute(demand, {}).activations,
                kSame);
}

TEST(Distribution, RefusesWhatHasNoMeaning) {
    const Demand good{.torques = {6000}, .arms = Eigen::RowVector2d(30, 20), .gains = {500, 300}};
    EXPECT_THROW((void)distribute(good, {.exponent = 1}), InputError);
    EXPECT_THROW((void)distribute(good, {.criterion = Criterion::stress}), InputError);
    EXPECT_THROW((void)distribute(good, {.weights = {1}}), InputError);
    EXPECT_THROW((void)distribute(good, {.weights = {1, -1}}), InputError);
    EXPECT_THROW((void)distribute(good, {.reserves = {kUnknown}}), InputError);
    Demand bad = good;
    bad.torques[0] = kUnknown;
    EXPECT_THROW((void)distribute(bad, {}), InputError);
    bad = good;
    bad.lowest = {0.5, 0};
    bad.highest = {0.4, 1};
    EXPECT_THROW((void)distribute(bad, {}), InputError);
    bad = good;
    bad.arms = Eigen::RowVector3d(1, 2, 3);
    EXPECT_THROW((void)distribute(bad, {}), InputError);
}

}  // namespace
}  // namespace myotet::activation
