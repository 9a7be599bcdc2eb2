// SPDX-License-Identifier: Apache-2.0
#include "Activation/UnitsOf.h"

#include <gtest/gtest.h>

#include "ActivationCase.h"
#include "Core/Errors.h"

namespace myotet::activation {
namespace {

skeleton::Muscle brachialis() {
    skeleton::Muscle muscle;
    muscle.name = "BRA";
    muscle.type = "Thelen2003Muscle";
    muscle.max_isometric_force = 987.26;
    muscle.optimal_fibre_length = 85.8;
    muscle.tendon_slack_length = 53.5;
    muscle.pennation = 0.1;
    return muscle;
}

TEST(UnitsOf, TakesTheNumbersOfTheFile) {
    skeleton::Muscle muscle = brachialis();
    muscle.shape = {{"KshapeActive", 0.5}, {"Flen", 1.8}, {"FmaxTendonStrain", 0.033}};
    muscle.rise = 0.01;
    muscle.rigid_tendon = true;
    const SkeletonUnit out = unit_of(muscle);
    EXPECT_EQ(out.unit.strength, 987.26);
    EXPECT_EQ(out.unit.fibre_length, 85.8);
    EXPECT_EQ(out.unit.tendon_length, 53.5);
    EXPECT_EQ(out.unit.pennation, 0.1);
    EXPECT_EQ(out.dynamics.rise, 0.01);
    EXPECT_TRUE(out.rigid_tendon);
    EXPECT_TRUE(out.note.empty());
    EXPECT_NEAR(out.unit.curves.active(1.5).value, std::exp(-0.5), 1e-12);
    EXPECT_NEAR(out.unit.curves.tendon(1.033).value, 1, 1e-12);
}

TEST(UnitsOf, MillardsLeastPullDependsOnDamping) {
    skeleton::Muscle muscle = brachialis();
    muscle.type = "Millard2012EquilibriumMuscle";
    EXPECT_EQ(unit_of(muscle).unit.curves.active(0.3).value, 0);
    EXPECT_EQ(unit_of(muscle).unit.curves.damping, 0.1);
    muscle.shape = {{"fiber_damping", 0}, {"TendonForceLengthCurve/strain_at_one_norm_force", 0.1}};
    EXPECT_NEAR(unit_of(muscle).unit.curves.active(0.3).value, 0.1, 1e-12);
    EXPECT_NEAR(unit_of(muscle).unit.curves.tendon(1.1).value, 1, 1e-12);
    muscle.rigid_tendon = true;
    EXPECT_EQ(unit_of(muscle).unit.curves.active(0.3).value, 0);
}

TEST(UnitsOf, OtherKindsAreGenericWithANote) {
    skeleton::Model model;
    model.muscles = {brachialis(), brachialis()};
    model.muscles[1].type = "Schutte1993Muscle_Deprecated";
    const auto units = units_of(model);
    ASSERT_EQ(units.size(), 2u);
    EXPECT_NE(units[1].note.find("Schutte1993"), std::string::npos);
}

TEST(UnitsOf, RefusesWithTheMusclesName) {
    skeleton::Muscle muscle = brachialis();
    muscle.optimal_fibre_length = 0;
    try {
        (void)unit_of(muscle);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("BRA"), std::string::npos);
    }
}

TEST(UnitsOf, ElasticUnitsShareATorque) {
    // Two elbow flexors behind elastic tendons: the moments balance, and the slopes of the cost
    // are in proportion to those of the moments.
    const auto unit = unit_of(brachialis()).unit;
    skeleton::Muscle other = brachialis();
    other.max_isometric_force = 600;
    other.tendon_slack_length = 270;
    const std::vector<muscle::MuscleTendon> units = {unit, unit_of(other).unit};
    const std::vector<double> lengths = {53.5 + 80, 270 + 88};
    const Demand demand{.torques = {12000}, .arms = Eigen::RowVector2d(20, 35), .gains = {0, 0}};
    const PullOf pull = [&](std::size_t i, double a) -> Pull {
        const muscle::ElasticPull at = muscle::elastic_pull(units[i], lengths[i], a, 0);
        return {at.force, at.force_by_activation};
    };
    const Distribution found = distribute(demand, pull, {});
    expect_solved(found);
    double moment = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const double arm = demand.arms(0, static_cast<int>(i));
        moment += arm * pull(i, found.activations[i]).force;
        EXPECT_NEAR(found.prices[0] * arm * pull(i, found.activations[i]).slope,
                    2 * found.activations[i], 1e-7);
    }
    EXPECT_NEAR(moment, 12000, 1e-3);
}

}  // namespace
}  // namespace myotet::activation
