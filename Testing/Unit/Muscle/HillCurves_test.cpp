// SPDX-License-Identifier: Apache-2.0
#include "Muscle/HillCurves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "Core/Errors.h"

namespace myotet::muscle {
namespace {

constexpr double kRounding = 1e-12;
// Central differences; beside a kink, where a slope is one-sided, they mean nothing.
constexpr double kStep = 1e-7, kDifference = 1e-5, kBeside = 1e-5;

struct Named {
    std::string name;
    HillCurves curves;
};
std::vector<Named> all() {
    return {{"thelen", thelen2003_curves({})},
            {"early", thelen2003_curves({.passive_form = ThelenPassive::everywhere})},
            {"millard", millard2012_curves({})},
            {"generic", generic_curves()}};
}
void expect_slope(const HillCurves::Curve& curve, double x, const std::string& what) {
    const double difference = (curve(x + kStep).value - curve(x - kStep).value) / (2 * kStep);
    EXPECT_NEAR(difference, curve(x).slope, kDifference * (1 + std::abs(difference)))
        << what << " at " << x;
}

TEST(HillCurves, SlopesAreThoseOfTheValues) {
    for (const Named& named : all()) {
        for (double l = 0.305; l < 2; l += 0.0171) {
            if (std::abs(l - 1) < kBeside) continue;
            expect_slope(named.curves.active, l, named.name + " active");
            expect_slope(named.curves.passive, l, named.name + " passive");
        }
        for (double v = -1.51; v < 1.5; v += 0.0171)
            expect_slope(named.curves.velocity, v, named.name + " velocity");
        for (double l = 0.9901; l < 1.1; l += 0.00171)
            expect_slope(named.curves.tendon, l, named.name + " tendon");
    }
}

TEST(HillCurves, AreOneWhereTheyAreNormalised) {
    for (const auto& [name, curves] : all()) {
        EXPECT_NEAR(curves.active(1).value, 1, kRounding) << name;
        EXPECT_NEAR(curves.active(1).slope, 0, kRounding) << name;
        EXPECT_NEAR(curves.velocity(0).value, 1, kRounding) << name;
        EXPECT_NEAR(curves.velocity(-1).value, 0, kRounding) << name;
        if (name != "early") EXPECT_EQ(curves.passive(0.99).value, 0) << name;
        EXPECT_EQ(curves.tendon(1).value, 0) << name;
    }
    const HillCurves thelen = thelen2003_curves({}), millard = millard2012_curves({});
    EXPECT_NEAR(thelen.passive(1.6).value, 1, kRounding);
    EXPECT_NEAR(thelen.tendon(1.04).value, 1, kRounding);
    EXPECT_NEAR(millard.passive(1.7).value, 1, kRounding);
    EXPECT_NEAR(millard.tendon(1.049).value, 1, kRounding);
    EXPECT_NEAR(millard.velocity(1).value, 1.4, kRounding);
    EXPECT_EQ(millard.active(0.4).value, 0);
    EXPECT_EQ(millard.active(1.9).value, 0);
}

TEST(HillCurves, NeverPushAndRiseWhereTheyMust) {
    for (const auto& [name, curves] : all()) {
        double passive = 0, velocity = 0, tendon = 0;
        for (double x = -2; x < 3; x += 0.01) {
            EXPECT_GE(curves.active(x).value, 0) << name;
            EXPECT_GE(curves.passive(x).value, passive) << name;
            EXPECT_GE(curves.velocity(x).value, velocity) << name;
            EXPECT_GE(curves.tendon(x).value, tendon) << name;
            passive = curves.passive(x).value;
            velocity = curves.velocity(x).value;
            tendon = curves.tendon(x).value;
        }
    }
}

TEST(HillCurves, ThelensAreAsPublished) {
    // Shortening: v = (f - 1) / (1 + f / Af); lengthening: (f - 1) (m - 1) / ((2 + 2/Af) (m - f)).
    const ThelenShape shape{.Af = 0.3, .Flen = 1.8};
    const HillCurves curves = thelen2003_curves(shape);
    for (double v = -0.99; v < 0; v += 0.07) {
        const double f = curves.velocity(v).value;
        EXPECT_NEAR((f - 1) / (1 + f / shape.Af), v, kRounding);
    }
    for (double v = 0.02; v < 0.7; v += 0.07) {
        const double f = curves.velocity(v).value, k = 2 + 2 / shape.Af;
        EXPECT_NEAR((f - 1) * (shape.Flen - 1) / (k * (shape.Flen - f)), v, 1e-11);
    }
    // Straight on beyond 95 % of the most.
    const double far = curves.velocity(50).slope;
    EXPECT_NEAR(far, curves.velocity(60).slope, kRounding);
    // The toe ends at 0.609 of the strain, rounded to three digits, and the straight part has
    // a slope of 1.712 / strain [Thelen 2003].
    EXPECT_NEAR(curves.tendon(1 + 0.609 * 0.04).value, 0.33, 0.001);
    EXPECT_NEAR(curves.tendon(1.1).slope, 1.712 / 0.04, 0.02);
}

TEST(HillCurves, MillardsStayNearHills) {
    // Published beside measured ones, which Hill's curves fit within some per cent.
    const HillCurves millard = millard2012_curves({}), generic = generic_curves();
    for (double v = -1; v < 1; v += 0.05)
        EXPECT_NEAR(millard.velocity(v).value, generic.velocity(v).value, 0.12) << v;
    for (double l = 0.75; l < 1.25; l += 0.05)
        EXPECT_NEAR(millard.active(l).value, generic.active(l).value, 0.2) << l;
}

TEST(HillCurves, RefuseWhatHasNoMeaning) {
    EXPECT_THROW((void)thelen2003_curves({.KshapeActive = 0}), InputError);
    EXPECT_THROW((void)thelen2003_curves({.Flen = 1}), InputError);
    EXPECT_THROW((void)thelen2003_curves({.Af = std::nan("")}), InputError);
    EXPECT_THROW((void)millard2012_curves({.strain_at_one_norm_force = -0.1}), InputError);
    EXPECT_THROW((void)millard2012_curves({.tendon_stiffness_at_one_norm_force = 10}), InputError);
    EXPECT_THROW((void)millard2012_curves({.fiber_damping = -1}), InputError);
}

}  // namespace
}  // namespace myotet::muscle
