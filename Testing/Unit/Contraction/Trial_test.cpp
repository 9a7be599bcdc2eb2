// SPDX-License-Identifier: Apache-2.0
// Runs that write nothing, one after the other on one model; activations that are sought.
#include "Contraction/Trial.h"

#include "BlockScene.h"
#include "Contraction/FitActivation.h"

namespace myotet::contraction {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;

BlockText text_with(const std::string& scheme) {
    BlockText text{.time = "end: 0.5, step: 0.125, scheme: " + scheme};
    if (scheme == "quasi-static") return text;
    text.fibres += "\n    force_velocity: hill";
    text.material = "wet";
    text.more = "materials:\n  wet: {model: teran2003_muscle, viscosity: 1.0e-3}\n";
    return text;
}

TEST(Trial, LeavesNothingBehindAndAgreesWithARunThatWrites) {
    for (const char* scheme : {"quasi-static", "backward-euler", "generalized-alpha"}) {
        const BlockFolder block;
        Loaded loaded = block.load(text_with(scheme));
        const SilentProgress silent;
        const Trial first = try_scene(loaded.scene, loaded.model, {}, silent);
        ASSERT_TRUE(first.completed) << scheme << ": " << first.message;
        const Curve before = loaded.scene.bodies[0].activation;
        loaded.scene.bodies[0].activation = constant_curve(0.7);
        const Trial other = try_scene(loaded.scene, loaded.model, {}, silent);
        EXPECT_NE(other.history.rows, first.history.rows) << scheme;
        loaded.scene.bodies[0].activation = before;
        const Trial again = try_scene(loaded.scene, loaded.model, {}, silent);
        EXPECT_EQ(again.history.rows, first.history.rows) << scheme;
        EXPECT_EQ(block.run(loaded).history.rows, first.history.rows) << scheme;
    }
}

TEST(Trial, ThatIsStoppedSaysSo) {
    const BlockFolder block;
    Loaded loaded = block.load(BlockText{});
    StopAfter stop(0);
    stop.report("", 0);
    (void)stop.interrupted();  // asked once: from now on it says yes
    const Trial trial = try_scene(loaded.scene, loaded.model, {}, stop);
    EXPECT_TRUE(trial.interrupted);
    EXPECT_FALSE(trial.completed);
    EXPECT_TRUE(trial.history.rows.empty());
}

// Held at its length a block pulls sigma_max times its area times its activation: a straight
// line of forces is a straight line of activations, which a cubic spline holds.
TEST(FitActivation, FindsWhatMakesAForce) {
    const BlockFolder block;
    Loaded loaded = block.load(BlockText{.activation = "0.4", .time = "end: 1, step: 0.25"});
    std::string force;
    for (const Column& column : history_columns(loaded.scene, loaded.model))
        if (column.name.ends_with("_force")) force = column.name;
    const double most = kSigmaMax * kArea;
    const skeleton::Table target{
        .columns = {force},
        .times = {0, 0.25, 0.5, 0.75, 1},
        .rows = {{0.3 * most}, {0.4 * most}, {0.5 * most}, {0.6 * most}, {0.7 * most}}};
    SilentProgress silent;
    const ActivationFit made = fit_activation(loaded.scene, loaded.model, 0, target,
                                              {.intervals = 2, .goal = 1e-4}, silent);
    EXPECT_EQ(made.fit.status, activation::Status::converged) << made.fit.message;
    EXPECT_LT(made.quantities[0].misfit, 1e-4 * made.quantities[0].most);
    for (std::size_t i = 0; i < made.activation.times.size(); ++i)
        EXPECT_NEAR(made.activation.values[i], 0.3 + 0.4 * made.activation.times[i], 2e-3);
    EXPECT_EQ(made.history.rows.size(), 5u);
}

TEST(FitActivation, TargetsThatMeanNothingAreRefused) {
    const BlockFolder block;
    Loaded loaded = block.load(BlockText{});
    const auto refused = [&](const skeleton::Table& target) {
        SilentProgress silent;
        try {
            (void)fit_activation(loaded.scene, loaded.model, 0, target, {}, silent);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("no refusal");
    };
    EXPECT_THAT(refused({.columns = {"force"}, .times = {0}, .rows = {{1}}}),
                AllOf(HasSubstr("'force' is no quantity"), HasSubstr("muscle_volume")));
    EXPECT_THAT(refused({.columns = {"muscle_volume"}, .times = {2}, .rows = {{1}}}),
                HasSubstr("but the scene from 0 to 1 s"));
    EXPECT_THAT(refused({.columns = {"muscle_volume"}, .times = {0}, .rows = {{0}}}),
                HasSubstr("is 0 at all times"));
    EXPECT_THROW((ActivationFitOptions{.goal = 0}.validate()), InputError);
    EXPECT_THROW((ActivationFitOptions{.evaluations = 0}.validate()), InputError);
}

}  // namespace
}  // namespace myotet::contraction
