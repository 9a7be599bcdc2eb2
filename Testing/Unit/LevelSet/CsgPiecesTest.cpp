// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "CsgShapes.h"
#include "LevelSet/CsgMeasure.h"
#include "LevelSet/CsgPieces.h"

namespace myotet::levelset {
namespace {

using test::ball_tolerance;
using test::ball_volume;

// Three balls apart, the middle one hollow.
Band three_balls() {
    const Band hollow = subtract(test::ball(Vec3(50, 20, 20), 14), test::ball(Vec3(51, 20, 20), 6));
    return settle(
        unite(unite(test::ball(Vec3(20, 20, 20), 7), hollow), test::ball(Vec3(80, 20, 20), 5)));
}

TEST(CsgPieces, inside_pieces_come_largest_first) {
    const Pieces pieces = find_pieces(three_balls(), Side::inside);
    ASSERT_EQ(pieces.volume.size(), 3u);
    const double wanted[] = {ball_volume(14) - ball_volume(6), ball_volume(7), ball_volume(5)};
    const double tolerance[] = {ball_tolerance(14) + ball_tolerance(6), ball_tolerance(7),
                                ball_tolerance(5)};
    for (int p = 0; p < 3; ++p) EXPECT_NEAR(pieces.volume[p], wanted[p], tolerance[p]);
}

TEST(CsgPieces, pieces_hold_the_whole_volume) {
    const Band band = three_balls();
    const Pieces pieces = find_pieces(band, Side::inside);
    EXPECT_NEAR(pieces.volume[0] + pieces.volume[1] + pieces.volume[2], enclosed_volume(band),
                1e-6);
}

TEST(CsgPieces, a_hollow_is_a_piece_of_the_outside) {
    const Pieces pieces = find_pieces(three_balls(), Side::outside);
    ASSERT_EQ(pieces.volume.size(), 2u);
    EXPECT_TRUE(std::isinf(pieces.volume[0]));
    EXPECT_NEAR(pieces.volume[1], ball_volume(6), ball_tolerance(6));
}

TEST(CsgPieces, flipped_pieces_vanish_and_the_others_stay) {
    const Band band = three_balls();
    const Band left = flip_pieces(band, find_pieces(band, Side::inside), {0, 1, 0});
    EXPECT_EQ(find_pieces(settle(left), Side::inside).volume.size(), 2u);
    EXPECT_GT(sample(left, Vec3(20, 20, 20)).value, 0);
    EXPECT_NEAR(volume_beyond(band, left), ball_volume(7), ball_tolerance(7));
    EXPECT_EQ(volume_beyond(left, band), 0);
}

TEST(CsgPieces, a_flipped_hollow_fills) {
    const Band band = three_balls();
    const Band full = flip_pieces(band, find_pieces(band, Side::outside), {0, 1});
    EXPECT_LT(sample(full, Vec3(51, 20, 20)).value, 0);
    EXPECT_NEAR(volume_beyond(full, band), ball_volume(6), ball_tolerance(6));
}

TEST(CsgPieces, a_thick_piece_hangs_together_through_its_unstored_middle) {
    // 60 samples thick: most blocks are not stored.
    const Band band = settle(test::block(Vec3(40, 40, 40), Vec3(30, 30, 30)));
    EXPECT_EQ(find_pieces(band, Side::inside).volume.size(), 1u);
    EXPECT_EQ(find_pieces(band, Side::outside).volume.size(), 1u);
}

TEST(CsgPieces, pieces_meet_what_shares_a_sample_with_them) {
    const Band band = three_balls();
    const Pieces pieces = find_pieces(band, Side::inside);
    const std::vector<char> meets = pieces_meeting(band, pieces, test::ball(Vec3(80, 20, 20), 3));
    EXPECT_EQ(meets, (std::vector<char>{0, 0, 1}));
}

}  // namespace
}  // namespace myotet::levelset
