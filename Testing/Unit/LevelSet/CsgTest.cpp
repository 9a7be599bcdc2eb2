// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Core/Parallel.h"
#include "CsgShapes.h"
#include "LevelSet/Csg.h"
#include "LevelSet/CsgMeasure.h"
#include "LevelSet/Measure.h"

namespace myotet::levelset {
namespace {

constexpr double kPi = std::numbers::pi;
// A sharp edge is rounded inside its cells: what that cuts off across it, mm^2.
constexpr double kEdge = 0.5;

using test::ball;
using test::ball_tolerance;
using test::ball_volume;
using test::block;

// Of two balls of one radius whose centres are d apart.
double lens_volume(double r, double d) {
    return kPi * (4 * r + d) * (2 * r - d) * (2 * r - d) / 12;
}

const Vec3 kLeft(20, 20, 20), kRight(29, 20, 20);
constexpr double kRadius = 10;

// Length of the circle in which they cross.
const double kSeam = 2 * kPi * std::sqrt(kRadius * kRadius - 4.5 * 4.5);

TEST(Csg, two_balls_obey_the_law_of_the_lens) {
    const Band a = ball(kLeft, kRadius), b = ball(kRight, kRadius);
    const double lens = lens_volume(kRadius, 9), one = ball_volume(kRadius);
    const double tolerance = ball_tolerance(kRadius) + kEdge * kSeam;
    EXPECT_NEAR(enclosed_volume(intersect(a, b)), lens, tolerance);
    EXPECT_NEAR(enclosed_volume(unite(a, b)), 2 * one - lens, tolerance);
    EXPECT_NEAR(enclosed_volume(subtract(a, b)), one - lens, tolerance);
}

TEST(Csg, volumes_add_up) {
    const Band a = ball(kLeft, kRadius), b = ball(kRight, kRadius);
    EXPECT_NEAR(enclosed_volume(unite(a, b)) + enclosed_volume(intersect(a, b)),
                enclosed_volume(a) + enclosed_volume(b), kEdge * kSeam);
    EXPECT_NEAR(enclosed_volume(subtract(a, b)) + enclosed_volume(intersect(a, b)),
                enclosed_volume(a), kEdge * kSeam);
}

TEST(Csg, far_apart_solids_keep_their_samples) {
    const Band a = ball(kLeft, 6), b = ball(Vec3(60, 20, 20), 6);
    EXPECT_NEAR(enclosed_volume(unite(a, b)), enclosed_volume(a) + enclosed_volume(b), 1e-6);
    EXPECT_TRUE(is_empty(intersect(a, b)));
    EXPECT_EQ(volume_beyond(a, subtract(a, b)), 0);
}

TEST(Csg, offset_of_a_ball_is_a_ball) {
    for (const double by : {-6.0, -1.3, 0.7, 5.0}) {
        // What the first ball lacks of its radius the second lacks too.
        const double lacks = ball_tolerance(kRadius) * std::pow(1 + by / kRadius, 2);
        EXPECT_NEAR(enclosed_volume(offset(ball(kLeft, kRadius), by)), ball_volume(kRadius + by),
                    lacks + ball_tolerance(kRadius + by))
            << by;
    }
}

TEST(Csg, offset_leaves_distances) {
    const Band grown = offset(ball(kLeft, kRadius), 4);
    // Interpolation and redistancing err by a few hundredths of a sample.
    for (const double d : {-2.0, -1.0, 0.0, 1.0, 2.0})
        EXPECT_NEAR(sample(grown, kLeft + Vec3(8, 8, 4) / 12 * (14 + d)).value, d, 0.05);
}

TEST(Csg, shrinking_a_ball_by_its_radius_leaves_nothing) {
    EXPECT_TRUE(is_empty(offset(ball(kLeft, 5), -5.5)));
}

TEST(Csg, opening_takes_a_spike_and_leaves_the_rest_alone) {
    const Band body = block(kLeft, Vec3(9, 9, 9));
    const Band spiked = unite(body, block(Vec3(20, 20, 33), Vec3(1, 1, 6)));
    const Band clean = opened(spiked, 2.5);
    EXPECT_GT(sample(clean, Vec3(20, 20, 36)).value, 0);
    EXPECT_EQ(volume_beyond(clean, spiked), 0);
    // Faces away from spike and edges: bit for bit.
    for (const Vec3& p : {Vec3(29, 20, 20), Vec3(20, 11, 20), Vec3(22, 24, 11)})
        EXPECT_EQ(sample(clean, p).value, sample(spiked, p).value);
    // Twelve edges of 18 mm are rounded to the distance, or, sharp edges being
    // rounded by half a sample when shrunk, to that much more.
    const auto rounded = [](double r) { return 12 * 18 * (1 - kPi / 4) * r * r; };
    const double lost = enclosed_volume(body) - enclosed_volume(clean);
    EXPECT_GT(lost, 0.9 * rounded(2.5));
    EXPECT_LT(lost, rounded(2.5 + 0.6));
}

TEST(Csg, closing_fills_a_slit) {
    const Band slit = subtract(block(kLeft, Vec3(9, 9, 9)), block(kLeft, Vec3(20, 9.5, 1)));
    ASSERT_GT(sample(slit, kLeft).value, 0);
    const Band whole = closed(slit, 2);
    EXPECT_LT(sample(whole, kLeft).value, 0);
    EXPECT_EQ(volume_beyond(slit, whole), 0);
    // Wider than twice the distance, it stays.
    EXPECT_GT(sample(closed(slit, 0.7), kLeft).value, 0);
}

TEST(Csg, a_blend_stays_within_its_radius) {
    constexpr double kBlend = 3;
    const Band a = ball(kLeft, kRadius), b = ball(kRight, 7);
    const Band plain = unite(a, b), blended = unite(a, b, kBlend);
    EXPECT_EQ(volume_beyond(plain, blended), 0);
    EXPECT_GT(volume_beyond(blended, plain), 20);
    const Box box = inside_box(blended);
    for (double x = box.min.x(); x < box.max.x(); x += 0.9)
        for (double y = box.min.y(); y < box.max.y(); y += 0.9)
            for (double z = box.min.z(); z < box.max.z(); z += 0.9) {
                const Vec3 p(x, y, z);
                const double to_a = (p - kLeft).norm() - kRadius;
                const double to_b = (p - kRight).norm() - 7;
                // A tenth of a sample: linear interpolation between the samples.
                if (sample(blended, p).value < -0.1 && sample(plain, p).value > 0.1) {
                    EXPECT_LT(to_a, kBlend + 0.1);
                    EXPECT_LT(to_b, kBlend + 0.1);
                }
            }
}

TEST(Csg, a_blend_at_right_angles_is_a_fillet) {
    // A pin of radius R on a slab: what lies between the corner and a quarter
    // circle, (1 - pi / 4) r^2 with its centroid (10 - 3 pi) / (12 - 3 pi) r off
    // the wall, turned around the pin (Pappus).
    constexpr double kBlend = 4, kPin = 8;
    const Band slab = block(kLeft, Vec3(24, 24, 6));
    Box box;
    box.include(Vec3(12, 12, 18));
    box.include(Vec3(28, 28, 46));
    const RoundCone pin{Vec3(20, 20, 18), Vec3(20, 20, 46), kPin, kPin};
    const Band rod =
        sample_solid([&](const Vec3& p) { return cone_distance(p, pin); }, box, test::kLattice);
    const double gained =
        enclosed_volume(unite(slab, rod, kBlend)) - enclosed_volume(unite(slab, rod));
    const double off = (10 - 3 * kPi) / (12 - 3 * kPi) * kBlend;
    const double wanted = 2 * kPi * (kPin + off) * (1 - kPi / 4) * kBlend * kBlend;
    EXPECT_NEAR(gained, wanted, kEdge * 2 * kPi * kPin);
}

TEST(Csg, what_yields_shares_the_wall) {
    const Band before = ball(kLeft, 8), other = ball(Vec3(36, 20, 20), 7);
    const Band grown = offset(before, 4);
    ASSERT_GT(enclosed_volume(intersect(grown, other)), 5);
    const Band fitted = yielding(grown, before, {&other});
    EXPECT_EQ(enclosed_volume(intersect(fitted, other)), 0);
    EXPECT_GT(contact(fitted, other).area, 20);
    // What overlapped before is not the step's business.
    const Band overlapping = ball(Vec3(30, 20, 20), 7);
    EXPECT_EQ(volume_beyond(before, yielding(grown, before, {&overlapping})), 0);
}

TEST(Csg, a_level_set_returns_from_its_band) {
    const Band band = settle(ball(kLeft, kRadius));
    const LevelSet phi = assemble(band);
    const Band again = to_band(phi);
    EXPECT_EQ(volume_beyond(band, again), 0);
    EXPECT_EQ(volume_beyond(again, band), 0);
    EXPECT_NEAR(enclosed_volume(again), enclosed_volume(phi), 1e-6);
}

TEST(Csg, same_bytes_for_any_number_of_threads) {
    const auto make = [](int threads) {
        const ThreadLimit limit(threads);
        return opened(unite(ball(kLeft, kRadius), ball(kRight, 7), 2), 1.5).values;
    };
    EXPECT_EQ(make(1), make(2));
}

}  // namespace
}  // namespace myotet::levelset
