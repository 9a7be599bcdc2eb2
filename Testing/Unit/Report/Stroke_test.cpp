// SPDX-License-Identifier: Apache-2.0
#include "Report/Stroke.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>

#include "Report/Lettering.h"
#include "ReportShapes.h"

namespace myotet::report {
namespace {

const Vec2 kGap = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
// Edges are softened by a straight ramp that lies evenly on both of their sides; a tip's ramp
// is bent, and channels are whole numbers.
constexpr double kRampError = 0.02;

// Covered pixels, parts counted as such.
double ink(const Picture& picture) {
    double sum = 0;
    for (const std::uint8_t channel : picture.rgb) sum += 255 - channel;
    return sum / (3 * 255);
}

Picture drawn(const std::vector<Vec2>& path, const Pen& pen) {
    Picture picture = blank(120, 80);
    draw_path(picture, path, pen);
    return picture;
}

TEST(Stroke, CoversItsWidthAndRoundTips) {
    for (const double width : {1.0, 2.2, 5.0})
        for (const Vec2& to : {Vec2(100.3, 20.7), Vec2(20.1, 70.4), Vec2(90.0, 66.6)}) {
            const Vec2 from(20.1, 20.7);
            const double area =
                width * (to - from).norm() + 0.25 * std::numbers::pi * width * width;
            const double error = kRampError * area;
            EXPECT_NEAR(ink(drawn({from, to}, {.width = width})), area, error) << width;
        }
}

TEST(Stroke, OfOnePixelIsSharpOnPixels) {
    const Picture picture = drawn({{10.5, 30.5}, {40.5, 30.5}}, {.width = 1});
    EXPECT_EQ(pixel(picture, 10, 30), (std::array<int, 3>{0, 0, 0}));
    EXPECT_EQ(pixel(picture, 40, 30), (std::array<int, 3>{0, 0, 0}));
    EXPECT_EQ(pixel(picture, 20, 29), kWhitePixel);
    EXPECT_EQ(pixel(picture, 20, 31), kWhitePixel);
    EXPECT_EQ(pixel(picture, 9, 30), kWhitePixel);
    EXPECT_EQ(pixel(picture, 41, 30), kWhitePixel);
}

TEST(Stroke, TwiceTheSameWayIsOnce) {
    const Vec2 a(12.3, 14.1), b(88.8, 61.7);
    const Pen pen{.width = 2.2, .colour = {0.8, 0.3, 0}};
    EXPECT_EQ(drawn({a, b}, pen).rgb, drawn({a, b, a, b}, pen).rgb);
}

TEST(Stroke, BreaksWhereAPointIsMissingAndDotsWhatIsAlone) {
    const Picture picture =
        drawn({{10, 20}, {30, 20}, kGap, {50, 20}, kGap, {70, 20}, {90, 20}}, {.width = 4});
    for (const int x : {10, 20, 29, 49, 50, 70, 89}) EXPECT_NE(pixel(picture, x, 20), kWhitePixel);
    for (const int x : {33, 40, 46, 53, 60, 66}) EXPECT_EQ(pixel(picture, x, 20), kWhitePixel);
    EXPECT_EQ(drawn({}, {}).rgb, blank(120, 80).rgb);
    EXPECT_EQ(drawn({kGap, kGap}, {}).rgb, blank(120, 80).rgb);
}

TEST(Stroke, DashesRunOnRoundCornersAndBeginAnewAfterGaps) {
    const Pen pen{.width = 2, .down = 6, .up = 10};
    // 100 pixels by a corner: seven dashes, the last of 4 pixels.
    const double tips = 0.25 * std::numbers::pi * 4;
    const double area = 2 * (6 * 6 + 4) + 7 * tips;
    EXPECT_NEAR(ink(drawn({{10, 10}, {70, 10}, {70, 50}}, pen)), area, 2 * kRampError * area);
    const Picture two = drawn({{10, 10}, {35, 10}, kGap, {60, 10}, {85, 10}}, pen);
    for (int x = 0; x < 40; ++x) EXPECT_EQ(pixel(two, x, 10), pixel(two, x + 50, 10)) << x;
    // A dotted line is of dots.
    const Pen dots{.width = 2, .up = 5};
    EXPECT_NEAR(ink(drawn({{10, 10}, {58, 10}}, dots)), 10 * tips, 2 * kRampError * 10 * tips);
}

TEST(Stroke, StaysInItsClipHoweverFarItsPointsAre) {
    const Pen pen{.width = 3, .clip = {20, 10, 50, 60}};
    const Picture picture = drawn({{-1e7, 30}, {1e7, 30}, kGap, {30, -1e7}, {30, 1e7}}, pen);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const bool inside = x >= 20 && x < 50 && y >= 10 && y < 60;
            const bool covered =
                inside && (std::abs(x + 0.5 - 30) < 2 || std::abs(y + 0.5 - 30) < 2);
            EXPECT_EQ(pixel(picture, x, y) != kWhitePixel, covered) << x << " " << y;
        }
    const Pen dashed{.width = 3, .down = 5, .up = 5};
    EXPECT_NEAR(ink(drawn({{-1e7, 30}, {1e7, 30}}, dashed)), 120 * (15 + 7.07) / 10, 15);
}

Picture lettered(std::string_view text, const Lettering& lettering) {
    Picture picture = blank(300, 40);
    draw_lettering(picture, text, {20, 25}, lettering);
    return picture;
}

TEST(Lettering, LettersDifferAndKeepTheirWidth) {
    const std::string known =
        "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz.,:;-+*/=()[]<>%_^'!? ";
    std::map<std::string, char> seen;
    for (const char letter : known + "~") {
        const Picture picture = lettered({&letter, 1}, {});
        const auto [same, is_new] =
            seen.emplace(std::string(picture.rgb.begin(), picture.rgb.end()), letter);
        EXPECT_TRUE(is_new) << letter << " as " << same->second;
    }

    const std::string text = "Force (N), gap: 10^-3";
    const double width = lettering_width(text, 1.5);
    const Picture picture = lettered(text, {});
    int first = picture.width, last = -1;
    for (int x = 0; x < picture.width; ++x)
        for (int y = 0; y < picture.height; ++y)
            if (pixel(picture, x, y) != kWhitePixel) {
                first = std::min(first, x);
                last = std::max(last, x);
            }
    EXPECT_NEAR(first, 20, 1);
    EXPECT_NEAR(last + 1, 20 + width, 1);
    EXPECT_EQ(lettering_width("", 2), 0);
}

TEST(Lettering, UpwardIsTheSameTurned) {
    Picture flat = blank(101, 101), turned = blank(101, 101);
    draw_lettering(flat, "Ray", {30, 60}, {});
    draw_lettering(turned, "Ray", {60, 71}, {.upward = true});
    int different = 0;
    for (int y = 0; y < 101; ++y)
        for (int x = 0; x < 101; ++x) different += pixel(flat, x, y) != pixel(turned, y, 100 - x);
    EXPECT_EQ(different, 0);
}

TEST(Lettering, IsShortenedToItsRoom) {
    EXPECT_EQ(shortened("flexor", 1.5, 500), "flexor");
    const std::string cut = shortened("flexor digitorum profundus", 1.5, 100);
    EXPECT_LE(lettering_width(cut, 1.5), 100);
    EXPECT_TRUE(cut.starts_with("flexor") && cut.ends_with("..")) << cut;
    EXPECT_EQ(shortened("flexor", 1.5, 0), "..");
}

}  // namespace
}  // namespace myotet::report
