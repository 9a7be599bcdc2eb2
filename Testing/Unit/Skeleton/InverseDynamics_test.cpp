// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "Skeleton/ReadOsim.h"
#include "Skeleton/Skeleton.h"
#include "Skeleton/Trajectory.h"

namespace myotet::skeleton {
namespace {

namespace fs = std::filesystem;

// Asked for: 0.5 % of a moment's range. Measured: 0.05 % in the first sample, where OpenSim
// begins 2e-7 s earlier, 0.002 % four samples from the ends.
constexpr double kOfRange = 1e-3, kOfRangeInside = 5e-5;
constexpr std::size_t kFromTheEnds = 4;

// A measured motion of an arm, and the moments that OpenSim's own tool found for it: columns,
// units and order of the same file; a model in the manner of version 1 and one of version 3.
TEST(InverseDynamics, MomentsAreThoseOfOpenSim) {
    const fs::path data = fs::path(MYOTET_SHARED_DIR) / "data/opensim/core/Applications";
    for (const char* tool : {"ID", "Analyze"}) {
        const fs::path folder = data / tool / "tests/resources";
        if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
        const Model model = read_osim(folder / "arm26.osim");
        const Table motion = read_table(folder / "arm26_InverseKinematics.mot");
        const Table expected = read_table(folder / "std_arm26_InverseDynamics.sto");
        EXPECT_TRUE(motion.in_degrees);
        const Trajectory trajectory = make_trajectory(motion, model, {.cutoff_hz = 6});
        Skeleton skeleton(model);
        for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
            const auto column = static_cast<std::size_t>(
                find_column(expected, model.coordinates[c].name + "_moment"));
            double lowest = INFINITY, highest = -INFINITY, worst = 0, worst_inside = 0;
            for (std::size_t i = 0; i < expected.times.size(); ++i) {
                const Instant now = at(trajectory, expected.times[i]);
                const double moment =
                    skeleton.inverse_dynamics(now.values, now.speeds, now.accelerations)[c];
                const double in_newton_metres = moment / 1000, theirs = expected.rows[i][column];
                lowest = std::min(lowest, theirs);
                highest = std::max(highest, theirs);
                const double error = std::abs(in_newton_metres - theirs);
                worst = std::max(worst, error);
                if (i >= kFromTheEnds && i + kFromTheEnds < expected.times.size())
                    worst_inside = std::max(worst_inside, error);
            }
            EXPECT_LT(worst, kOfRange * (highest - lowest)) << tool << c;
            EXPECT_LT(worst_inside, kOfRangeInside * (highest - lowest)) << tool << c;
        }
    }
}

}  // namespace
}  // namespace myotet::skeleton
