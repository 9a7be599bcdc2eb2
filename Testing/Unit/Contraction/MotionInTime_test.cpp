// SPDX-License-Identifier: Apache-2.0
// Scenes with inertia, and with weight.
#include "BlockScene.h"

namespace myotet::contraction {
namespace {

using namespace test;

// 9810 mm/s^2 on 192 mm^3 of 1.06e-9 t/mm^3.
constexpr double kWeight = 9810 * kVolume * 1.06e-9;
// Equilibria leave this part of all nodal forces.
constexpr double kSolved = 1e-5;

double pulls(const History& h, const std::string& axis) {
    return column(h, "muscle_at_fixed_force_" + axis).back() +
           column(h, "muscle_at_fixed_2_force_" + axis).back();
}

TEST(MotionInTime, AtRestWhatHoldsABodyHoldsItsWeight) {
    for (const char* elements : {"linear", "patches", "quadratic"}) {
        const BlockFolder block;
        const History h =
            block.run({.elements = elements, .activation = "0", .more = "gravity: [0, -9810, 0]\n"})
                .history;
        EXPECT_NEAR(pulls(h, "y"), -kWeight, kSolved * kWeight) << elements;
        EXPECT_NEAR(pulls(h, "x"), 0, kSolved * kWeight) << elements;
        EXPECT_NEAR(pulls(h, "z"), 0, kSolved * kSigmaMax * kArea) << elements;
    }
}

// Twice the density, twice the weight.
TEST(MotionInTime, WeightGoesWithDensity) {
    const BlockFolder block;
    const History h = block
                          .run({.material = "heavy",
                                .activation = "0",
                                .more = "gravity: [0, 0, -9810]\nmaterials:\n  heavy: {model: "
                                        "teran2003_muscle, density_kg_m3: 2120}\n"})
                          .history;
    EXPECT_NEAR(pulls(h, "z"), -2 * kWeight, 2 * kSolved * kWeight);
}

// With damping both come to rest where the quasi-static scheme says: what is left fades as
// exp(-damping t / 2), by e^-10. The slowest vibration takes some 5 ms, ten of these steps.
TEST(MotionInTime, BothSchemesComeToRestInEquilibrium) {
    const BlockText still{.activation = "0", .more = "gravity: [0, -9810, 0]\n"};
    const BlockFolder quiet;
    Loaded at_rest = quiet.load(still);
    Simulation equilibrium(at_rest.scene, at_rest.model, {});
    ASSERT_TRUE(equilibrium.begin().converged);
    double sag = 0;
    for (std::size_t n = 0; n < at_rest.model.rest.size(); ++n)
        sag = std::max(sag, (equilibrium.positions()[n] - at_rest.model.rest[n]).norm());
    ASSERT_GT(sag, 1e-4);
    for (const char* scheme : {"backward-euler", "generalized-alpha"}) {
        BlockText moving = still;
        moving.time = std::string("end: 0.05, step: 0.0005, damping: 400, scheme: ") + scheme;
        const BlockFolder block;
        Loaded loaded = block.load(moving);
        Simulation simulation(loaded.scene, loaded.model, {});
        ASSERT_TRUE(simulation.begin().converged);
        EXPECT_EQ(simulation.positions(), loaded.model.rest);
        const StepSummary summary = simulation.advance(0.05);
        ASSERT_TRUE(summary.converged) << summary.message;
        EXPECT_EQ(summary.steps, 100);
        for (std::size_t n = 0; n < loaded.model.rest.size(); ++n)
            EXPECT_LT((simulation.positions()[n] - equilibrium.positions()[n]).norm(), 0.01 * sag)
                << scheme;
    }
}

// Nothing holds it: it falls by g t^2 / 2, which the second-order scheme meets exactly and
// backward Euler, first order, by one step's part.
TEST(MotionInTime, AFreeBodyFalls) {
    const BlockFolder block;
    for (const char* scheme : {"backward-euler", "generalized-alpha"}) {
        Loaded loaded = block.load_text(
            "bodies:\n  muscle: {mesh: block.vtu, material: teran2003_muscle, fibres: {from: "
            "constant, direction: [0, 0, 1]}}\ngravity: [0, 0, -9810]\ntime: {end: 0.1, step: "
            "0.01, scheme: " +
            std::string(scheme) + "}\n");
        Simulation simulation(loaded.scene, loaded.model, {});
        ASSERT_TRUE(simulation.begin().converged);
        ASSERT_TRUE(simulation.advance(0.1).converged);
        const double fallen = 9810 * 0.01 / 2;
        const bool first_order = std::string(scheme) == "backward-euler";
        const double expected = first_order ? 1.1 * fallen : fallen;  // g dt^2 n (n + 1) / 2
        for (std::size_t n = 0; n < loaded.model.rest.size(); ++n)
            EXPECT_NEAR((loaded.model.rest[n] - simulation.positions()[n]).z(), expected,
                        1e-6 * fallen)
                << scheme;
    }
}

}  // namespace
}  // namespace myotet::contraction
