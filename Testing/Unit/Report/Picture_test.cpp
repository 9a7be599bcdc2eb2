// SPDX-License-Identifier: Apache-2.0
#include "Report/Picture.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "Core/Errors.h"
#include "Report/Text.h"
#include "ReportShapes.h"
#include "Support/TemporaryFolder.h"

namespace myotet::report {
namespace {

Picture patchwork(int width, int height) {
    Picture made = blank(width, height);
    for (std::size_t i = 0; i < made.rgb.size(); ++i)
        made.rgb[i] = static_cast<std::uint8_t>(i * 37 + i / 11);
    return made;
}

TEST(Png, ComesBackAsItWasAndSaysItsSize) {
    const testing::TemporaryFolder folder;
    const Picture written = patchwork(301, 47);
    write_png(written, folder / "a.png");
    const Picture read = read_png(folder / "a.png");
    EXPECT_EQ(read.width, 301);
    EXPECT_EQ(read.height, 47);
    EXPECT_EQ(read.rgb, written.rgb);

    // Signature, then the chunk IHDR: sides, 8 bits, colour without transparency.
    const std::string bytes = testing::read_bytes(folder / "a.png");
    const std::string head("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x01\x2d\0\0\0\x2f\x08\x02", 26);
    EXPECT_EQ(bytes.substr(0, head.size()), head);
    write_png(written, folder / "b.png");
    EXPECT_EQ(testing::read_bytes(folder / "b.png"), bytes);
}

TEST(Png, WhatCannotBeReadOrWrittenIsSaid) {
    const testing::TemporaryFolder folder;
    EXPECT_THROW(write_png(patchwork(8, 8), folder / "no/such.png"), IoError);
    EXPECT_THROW((void)read_png(folder / "none.png"), IoError);
    write_png(patchwork(64, 64), folder / "a.png");
    const std::string bytes = testing::read_bytes(folder / "a.png");
    testing::write_bytes(folder / "cut.png", bytes.substr(0, bytes.size() / 2));
    EXPECT_THROW((void)read_png(folder / "cut.png"), IoError);
    testing::write_bytes(folder / "other.png", "solid stl");
    EXPECT_THROW((void)read_png(folder / "other.png"), IoError);
}

TEST(Tile, PutsPicturesInRowsOnWhite) {
    const Picture pictures[] = {blank(10, 4, {1, 0, 0}), blank(6, 8, {0, 1, 0}),
                                blank(2, 2, {0, 0, 1})};
    const Picture sheet = tile(pictures, 2);
    EXPECT_EQ(sheet.width, 20);
    EXPECT_EQ(sheet.height, 16);
    EXPECT_EQ(pixel(sheet, 9, 3), (std::array<int, 3>{255, 0, 0}));
    EXPECT_EQ(pixel(sheet, 9, 4), kWhitePixel);
    EXPECT_EQ(pixel(sheet, 10, 7), (std::array<int, 3>{0, 255, 0}));
    EXPECT_EQ(pixel(sheet, 16, 0), kWhitePixel);
    EXPECT_EQ(pixel(sheet, 1, 9), (std::array<int, 3>{0, 0, 255}));
    EXPECT_EQ(tile(pictures, 7).width, 30);
    EXPECT_THROW((void)tile({}, 2), InputError);
    EXPECT_THROW((void)tile(pictures, 0), InputError);
    EXPECT_THROW((void)blank(0, 4), InputError);
    EXPECT_THROW((void)blank(4, kLongestSide + 1), InputError);
}

// As text, a line a row.
std::string art(const Picture& picture) {
    std::string text;
    for (int y = 0; y < picture.height; ++y, text += "\n")
        for (int x = 0; x < picture.width; ++x)
            text += pixel(picture, x, y) == kWhitePixel ? '.' : '#';
    return text;
}

TEST(Text, IsDrawnSquareBySquare) {
    Picture picture = blank(text_width("E 1", 1), kLetterHeight);
    draw_text(picture, "E 1", {0, 0}, 1);
    EXPECT_EQ(art(picture),
              "#####.........#..\n"
              "#............##..\n"
              "#.............#..\n"
              "####..........#..\n"
              "#.............#..\n"
              "#.............#..\n"
              "#####........###.\n");
    Picture large = blank(text_width("E", 3), 3 * kLetterHeight);
    draw_text(large, "E", {0, 0}, 3);
    EXPECT_EQ(pixel(large, 14, 2), (std::array<int, 3>{0, 0, 0}));
    EXPECT_EQ(pixel(large, 3, 3), kWhitePixel);
}

TEST(Text, LettersDifferAndUnknownOnesAreBoxes) {
    const std::string known =
        "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz.,:;-+*/=()[]<>%_^'!? ";
    std::set<std::string> seen;
    for (const char letter : known + "~") {
        Picture picture = blank(kLetterWidth, kLetterHeight);
        draw_text(picture, {&letter, 1}, {0, 0}, 1);
        seen.insert(art(picture));
    }
    EXPECT_EQ(seen.size(), known.size() + 1);
    // Beyond the picture nothing is drawn, and nothing breaks.
    Picture small = blank(3, 3);
    draw_text(small, "long text", {-20, -3}, 2);
    EXPECT_EQ(text_width("", 4), 0);
}

}  // namespace
}  // namespace myotet::report
