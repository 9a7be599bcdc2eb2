// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "BandShapes.h"
#include "LevelSet/Band.h"

namespace myotet::levelset {
namespace {

const Vec3 kCentre(16.2, 15.9, 16.4);

TEST(Band, gather_reaches_into_all_neighbours) {
    const Band band = test::make_band(test::sphere_field(kCentre, 9), 4, 1);
    std::vector<float> out(11 * 11 * 11);
    gather(band, {1, 1, 1}, 1, 2, out.data());
    for (int k = 0; k < 11; ++k)
        for (int j = 0; j < 11; ++j)
            for (int i = 0; i < 11; ++i) {
                const double exact = (Vec3(i + 7, j + 7, k + 7) - kCentre).norm() - 9;
                EXPECT_NEAR(out[(k * 11 + j) * 11 + i], std::clamp(exact, -3.0, 3.0), 1e-5);
            }
}

TEST(Band, unstored_blocks_know_their_side) {
    const Band band = test::make_band(test::sphere_field(Vec3(32, 32, 32), 24), 8, 1);
    EXPECT_EQ(band.find({3, 3, 3}), Band::kInside);
    EXPECT_EQ(band.find({0, 0, 0}), Band::kOutside);
    EXPECT_EQ(band.find({-1, 3, 3}), Band::kOutside);
    EXPECT_LT(sample(band, {32, 32, 32}).value, 0);
}

TEST(Band, samples_interpolate_across_blocks) {
    const Vec3 normal = Vec3(2, -1, 3).normalized();
    const auto plane = [&](const Vec3& p) { return (p - Vec3(16, 16, 16)).dot(normal); };
    const Band band = test::make_band(plane, 4, 1);
    for (const Vec3& p : {Vec3(15.5, 15.5, 16.2), Vec3(7.7, 10.6, 19.8), Vec3(16, 16, 16)}) {
        const Sample s = sample(band, p);
        EXPECT_NEAR(s.value, plane(p), 1e-5);
        EXPECT_LT((s.gradient - normal).norm(), 1e-5);
    }
}

}  // namespace
}  // namespace myotet::levelset
