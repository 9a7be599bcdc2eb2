// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/GiveBack.h"

#include "BandShapes.h"
#include "SurfaceShapes.h"

#include <gtest/gtest.h>

namespace myotet::levelset {
namespace {

const Vec3 kCentre(16.2, 15.9, 16.4);

TEST(GiveBack, even_displacement_is_taken_back) {
    Band band = test::make_band(test::sphere_field(kCentre, 9), 4, 1);
    const std::vector<float> before = band.values;
    for (float& v : band.values) v = std::clamp(v + 0.3f, -band.width, band.width);
    give_back(band, before, 3);
    for (const Vec3& u : test::directions(100))
        EXPECT_NEAR(test::distance_to_zero(band, kCentre, u, 14), 9, 0.05);
}

TEST(GiveBack, ripples_below_the_radius_are_left_as_the_flow_made_them) {
    const auto rippled = [](const Vec3& p) { return p.z() - 16 + 0.4 * std::sin(2.1 * p.x()); };
    Band band = test::make_band([](const Vec3& p) { return p.z() - 16; }, 4, 1);
    const std::vector<float> before = test::make_band(rippled, 4, 1).values;
    ASSERT_EQ(before.size(), band.values.size());
    give_back(band, before, 4);
    // Flat before and after: nothing of the ripple, 0.4 high, comes back.
    for (double x = 10; x < 22; x += 0.7)
        EXPECT_NEAR(sample(band, {x, 16, 16}).value, 0, 0.1) << x;
}

}  // namespace
}  // namespace myotet::levelset
