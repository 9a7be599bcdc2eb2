// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "BandShapes.h"
#include "Core/Parallel.h"
#include "LevelSet/Redistance.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

const Vec3 kCentre(16.2, 15.9, 16.4);

// A sphere's field with slopes between a half and two and a half.
test::Field steep_sphere(double radius) {
    return [=](const Vec3& p) {
        const double d = (p - kCentre).norm() - radius;
        return d * (1.5 + 0.5 * std::sin(0.4 * p.x()) + 0.08 * d);
    };
}

TEST(Redistance, projected_values_are_distances) {
    Band band = test::make_band(steep_sphere(9), 4, 1, 5);
    band.width = 3;
    for (float& v : band.values) v = std::clamp(v, -3.0f, 3.0f);
    redistance(band, Seeds::project, 2);
    // Trilinear interpolation of the steep field moves its zero by up to
    // spacing^2 / (8 * 3) or so.
    for (const Vec3& u : test::directions(300))
        for (const double d : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
            const Sample s = sample(band, kCentre + (9 + d) * u);
            EXPECT_NEAR(s.value, d, 0.12) << d;
            EXPECT_NEAR(s.gradient.norm(), 1, 0.15) << d;
        }
}

TEST(Redistance, kept_cells_keep_the_interface) {
    const Band before = test::make_band(test::sphere_field(kCentre, 9), 4, 1);
    Band after = before;
    redistance(after, Seeds::keep_cells, 2);
    for (const Vec3& u : test::directions(300)) {
        const double was = test::distance_to_zero(before, kCentre, u, 14);
        EXPECT_NEAR(test::distance_to_zero(after, kCentre, u, 14), was, 1e-5);
    }
}

TEST(Redistance, opposite_bands_stay_opposite) {
    const auto field = steep_sphere(9);
    for (const Seeds seeds : {Seeds::keep_ends, Seeds::keep_cells, Seeds::scale, Seeds::project}) {
        Band band = test::make_band(field, 4, 1);
        Band other = band;
        other.beyond = Band::kInside;
        for (float& v : other.values) v = -v;
        for (std::int32_t& b : other.block_of)
            if (b < 0) b = b == Band::kInside ? Band::kOutside : Band::kInside;
        redistance(band, seeds, 2);
        redistance(other, seeds, 2);
        for (std::size_t i = 0; i < band.values.size(); ++i)
            ASSERT_EQ(band.values[i], -other.values[i]);
    }
}

TEST(Redistance, same_bytes_for_any_number_of_threads) {
    const auto make = [](int threads) {
        const ThreadLimit limit(threads);
        Band band = test::make_band(steep_sphere(9), 4, 1);
        redistance(band, Seeds::scale, 1);
        return band.values;
    };
    EXPECT_EQ(make(1), make(2));
}

TEST(Redistance, refit_gives_room_for_a_wider_band) {
    const Band narrow = test::make_band(test::sphere_field(kCentre, 6), 4, 1, 1.5);
    Band wide = refit(narrow, 5);
    EXPECT_EQ(wide.width, 5);
    redistance(wide, Seeds::keep_ends, 2);
    for (const Vec3& u : test::directions(100))
        EXPECT_NEAR(sample(wide, kCentre + 10 * u).value, 4, 0.1);
}

}  // namespace
}  // namespace myotet::levelset
