// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "BandShapes.h"
#include "LevelSet/GiveBack.h"
#include "LevelSet/Measure.h"
#include "SurfaceShapes.h"

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
    for (double x = 10; x < 22; x += 0.7) EXPECT_NEAR(sample(band, {x, 16, 16}).value, 0, 0.1) << x;
}

TEST(GiveBack, missing_volume_is_gained_where_it_is_missing) {
    const Band before = test::make_band(test::sphere_field(kCentre, 9), 4, 1);
    // A tenth of a sample all over one half, in cells of four samples a side.
    CellVolumes missing(before.position.size(), std::array<float, 8>{});
    double sum = 0;
    for (std::size_t b = 0; b < before.position.size(); ++b)
        for (int at = 0; at < Band::kSize; ++at) {
            const Index3 p = before.position[b];
            const Vec3 x(8 * p[0] + at % 8, 8 * p[1] + at / 8 % 8, 8 * p[2] + at / 64);
            if (std::abs((x - kCentre).norm() - 9) > 0.5 || x.x() > kCentre.x()) continue;
            missing[b][(at / 256 * 2 + at / 32 % 2) * 2 + at / 4 % 2] += 0.1f;
            sum += 0.1;
        }
    Band after = before;
    restore_volume(after, missing, 2);
    const double gained = enclosed_volume(assemble(after)) - enclosed_volume(assemble(before));
    EXPECT_NEAR(gained, sum, 0.15 * sum);
    EXPECT_NEAR(sample(after, kCentre - 9 * Vec3::UnitX()).value, -0.1, 0.03);
    EXPECT_NEAR(sample(after, kCentre + 9 * Vec3::UnitX()).value, 0, 0.02);
}

}  // namespace
}  // namespace myotet::levelset
