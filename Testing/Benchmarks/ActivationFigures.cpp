// SPDX-License-Identifier: Apache-2.0
// From a motion to activations: inverse dynamics, paths and muscle force distribution.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "Activation/Sharing.h"
#include "MeshFigures.h"
#include "Skeleton/ReadOsim.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;

// Processor seconds of a motion of a second at so many times; the best of three.
double seconds(const skeleton::Model& model, const skeleton::Trajectory& trajectory, int count,
               activation::Tendons tendons) {
    std::vector<double> times;
    for (int i = 0; i < count; ++i) times.push_back(static_cast<double>(i) / count);
    double best = 1e9;
    for (int again = 0; again < 3; ++again) {
        SilentProgress silent;
        const double start = bench::processor_seconds();
        const auto motion = activation::follow_muscles(model, trajectory, times, false, silent);
        const auto shared = activation::share(model, motion, {.tendons = tendons}, silent);
        best = std::min(best, bench::processor_seconds() - start);
        EXPECT_EQ(shared.status, activation::Status::converged) << shared.message;
    }
    return best;
}

TEST(ActivationFigures, ASecondOfAnArmOfSixMuscles) {
    const fs::path folder =
        fs::path(MYOTET_SHARED_DIR) / "data/opensim/core/Applications/Analyze/tests/resources";
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not here";
    const skeleton::Model model = skeleton::read_osim(folder / "arm26.osim");
    const auto trajectory = skeleton::make_trajectory(
        skeleton::read_table(folder / "arm26_InverseKinematics.mot"), model, {.cutoff_hz = 6});
    using activation::Tendons;
    const double rigid = seconds(model, trajectory, 100, Tendons::rigid),
                 elastic = seconds(model, trajectory, 100, Tendons::elastic),
                 longer = seconds(model, trajectory, 800, Tendons::elastic);
    std::printf("100 times: rigid tendons %.4f s, elastic %.4f s; 800 times %.4f s, %.2f times 8\n",
                rigid, elastic, longer, longer / elastic / 8);
    EXPECT_LT(elastic, 0.5);               // asked
    EXPECT_LT(longer, 8 * 1.5 * elastic);  // linear, and what other work disturbs
}

}  // namespace
}  // namespace myotet
