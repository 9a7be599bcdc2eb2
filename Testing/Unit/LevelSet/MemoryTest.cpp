// SPDX-License-Identifier: Apache-2.0
// What a level set of labels holds grows with its surface.
#include <gtest/gtest.h>

#include "LabelShapes.h"
#include "LevelSet/FromLabels.h"

namespace myotet::levelset {
namespace {

TEST(Memory, half_the_spacing_takes_four_times_the_bricks_and_not_eight) {
    const auto volume = test::sample_volume({64, 64, 64}, {1, 1, 1}, [](const Vec3& p) {
        return (p - Vec3(31.6, 32.1, 31.8)).norm() < 26 ? 1 : 0;
    });
    SilentProgress silent;
    const auto bytes = [&](double spacing) {
        LabelOptions options;
        options.spacing = spacing;
        const auto sets = from_labels(volume, std::vector<std::int32_t>{1}, options, silent);
        return static_cast<double>(sets.regions[0].phi.memory());
    };
    // Four for the bricks; the coarse samples, one for 64 fine ones, grow eightfold.
    const double growth = bytes(0.5) / bytes(1);
    EXPECT_GT(growth, 3);
    EXPECT_LT(growth, 5);
}

}  // namespace
}  // namespace myotet::levelset
