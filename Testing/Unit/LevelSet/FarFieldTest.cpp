// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "BandShapes.h"
#include "LevelSet/FarField.h"

namespace myotet::levelset {
namespace {

TEST(FarField, coarse_samples_are_distances_on_both_sides) {
    const Vec3 centre(32.3, 31.8, 32.1);
    const double radius = 20;
    const Band band = test::make_band(test::sphere_field(centre, radius), 8, 1);
    const FarField far = far_field(band);
    ASSERT_EQ(far.size, (Index3{17, 17, 17}));
    for (int k = 0; k < 17; ++k)
        for (int j = 0; j < 17; ++j)
            for (int i = 0; i < 17; ++i) {
                const double exact = (4 * Vec3(i, j, k) - centre).norm() - radius;
                // A foot slides to within a tenth of a sample of the nearest point.
                EXPECT_NEAR(far.value[(k * 17 + j) * 17 + i], exact, 0.1);
            }
}

}  // namespace
}  // namespace myotet::levelset
