// SPDX-License-Identifier: Apache-2.0
#include "Report/Draw.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Report/ColourMap.h"
#include "ReportShapes.h"

namespace myotet::report {
namespace {

// A colour comes back as a byte: half a step, and a step for the mean of nine samples.
constexpr int kByte = 2;
// Samples along a silhouette decide by their centres: much less than this for a disc of
// 200 pixels radius; the ball's facets lose 0.1 %.
constexpr double kSilhouette = 0.01;

// What black shapes cover of a white picture, pixels.
double covered(const Picture& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) sum += 255 - picture.rgb[i];
    return sum / 255;
}

void expect_colour(const std::array<int, 3>& seen, const Colour& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 255 * expected[c], kByte) << "channel " << c;
}

TEST(Draw, ABallsSilhouetteIsItsDiscFromAnySide) {
    constexpr double radius = 50, half = 60;
    const Shape black{.surface = ball({3, -4, 5}, radius, 90, 180), .colour = kBlack};
    // A box that is a square of the same size from each side along an axis.
    Box fit;
    fit.include(Vec3(3, -4, 5) - Vec3::Constant(half));
    fit.include(Vec3(3, -4, 5) + Vec3::Constant(half));
    for (const Vec3& direction : {Vec3(0, 1, 0), Vec3(-2, 0, 0), Vec3(0, -1, 0)}) {
        const Picture picture =
            draw({&black, 1}, {.direction = direction, .width = 500, .height = 600, .fit = fit});
        constexpr double scale = 500 * 0.94 / (2 * half);  // pixels a mm
        const double disc = std::numbers::pi * radius * radius * scale * scale;
        EXPECT_NEAR(covered(picture) / disc, 1, kSilhouette);
    }
}

TEST(Draw, TheNearerHidesTheFartherInWhateverOrder) {
    const Shape near{.surface = square(10, -5), .colour = {1, 0, 0}};
    const Shape far{.surface = square(20, 5), .colour = {0, 0, 1}};
    for (const auto& shapes : {std::vector<Shape>{near, far}, std::vector<Shape>{far, near}}) {
        const Picture front = draw(shapes, {.width = 100, .height = 100});
        expect_colour(pixel(front, 50, 50), near.colour);  // faces the light: fully bright
        expect_colour(pixel(front, 10, 50), far.colour);
        EXPECT_EQ(pixel(front, 1, 50), kWhitePixel);
        const Picture back =
            draw(shapes, {.direction = -Vec3::UnitY(), .width = 100, .height = 100});
        expect_colour(pixel(back, 50, 50), far.colour);
    }
}

TEST(Draw, UpIsUpAndRightIsRight) {
    // From the patient's front, the left is at the right and the head at the top.
    const Shape left{.surface = ball({50, 0, 0}, 10, 8, 16), .colour = kBlack};
    const Shape head{.surface = ball({0, 0, 50}, 10, 8, 16), .colour = {1, 0, 0}};
    const Shape shapes[] = {left, head};
    Box fit;
    fit.include(Vec3::Constant(-60));
    fit.include(Vec3::Constant(60));
    const Picture front = draw(shapes, {.width = 200, .height = 200, .fit = fit});
    EXPECT_EQ(pixel(front, 178, 100), (std::array<int, 3>{0, 0, 0}));
    EXPECT_EQ(pixel(front, 100, 22)[1], 0);
    EXPECT_EQ(pixel(front, 100, 178), kWhitePixel);
    EXPECT_EQ(pixel(front, 22, 100), kWhitePixel);
}

TEST(Draw, NoCracksBetweenTriangles) {
    // A square of many triangles seen aslant covers its inside wholly.
    TriMesh sheet;
    constexpr int n = 40;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            sheet.points.emplace_back(i + 0.3 * std::sin(7.0 * j), 0.1 * i + 0.2 * j,
                                      j + 0.3 * std::sin(5.0 * i));
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j;
            sheet.triangles.push_back({a, a + 1, a + n + 2});
            sheet.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    const Shape black{.surface = sheet, .colour = kBlack};
    const Picture picture =
        draw({&black, 1}, {.direction = {0.01, 1, 0.02}, .width = 301, .height = 307});
    for (int y = 25; y < 280; ++y)
        for (int x = 25; x < 275; ++x) ASSERT_EQ(pixel(picture, x, y)[0], 0) << x << " " << y;
}

TEST(Draw, ValuesHaveTheColoursOfTheMapAndNoNumberTheShapes) {
    Shape shape{.surface = square(10, 0), .values = {2, std::nan("")}, .colour = {1, 0, 0}};
    const View view{.width = 200, .height = 240, .least = 1, .most = 2, .values_name = "stretch"};
    const Picture picture = draw({&shape, 1}, view);
    // The diagonal runs from below left to above right: the first triangle is below it.
    expect_colour(pixel(picture, 130, 120), map_colour(1));
    expect_colour(pixel(picture, 70, 80), {1, 0, 0});
    // The bar lies in the middle of the bottom, from dark to bright.
    const int y = view.height - 18;
    expect_colour(pixel(picture, 50, y), map_colour(0.005));
    expect_colour(pixel(picture, 149, y), map_colour(0.995));
    EXPECT_EQ(pixel(picture, 48, y), kWhitePixel);
    shape.values.clear();
    EXPECT_EQ(pixel(draw({&shape, 1}, view), 5, y), kWhitePixel);
}

TEST(Draw, ATitleIsWrittenAndNothingElseOnAnEmptyPicture) {
    const Picture empty = draw({}, {.width = 240, .height = 240});
    EXPECT_EQ(empty.rgb, blank(240, 240).rgb);
    EXPECT_GT(covered(draw({}, {.width = 240, .height = 240, .title = "t = 0.5 s"})), 30);
}

TEST(Draw, TheSameBytesOnAnyNumberOfThreads) {
    std::vector<Shape> shapes;
    for (int i = 0; i < 20; ++i) {
        shapes.push_back({.surface = ball({3.0 * (i % 5), 2.0 * i, 4.0 * (i / 5)}, 5, 20, 40)});
        for (std::size_t t = 0; t < shapes.back().surface.triangles.size(); ++t)
            shapes.back().values.push_back(std::sin(0.1 * static_cast<double>(t + i)));
    }
    const View view{.direction = {1, 2, -0.5}, .least = -1, .most = 1, .title = "many"};
    const auto drawn = [&](int threads) {
        const ThreadLimit limit(threads);
        return draw(shapes, view).rgb;
    };
    const auto one = drawn(1);
    EXPECT_EQ(one, drawn(2));
    EXPECT_EQ(one, drawn(4));
}

TEST(Draw, WhatBreaksARuleIsRefused) {
    const Shape good{.surface = square(1, 0)};
    const auto refused = [&](const Shape& shape, const View& view) {
        EXPECT_THROW((void)draw({&shape, 1}, view), InputError);
    };
    refused(good, {.direction = Vec3::Zero()});
    refused(good, {.direction = Vec3::UnitZ()});
    refused(good, {.direction = {std::nan(""), 1, 0}});
    refused(good, {.width = 63});
    refused(good, {.height = kLongestSide + 1});
    refused(good, {.least = 1, .most = 1});
    refused(good, {.least = std::nan("")});
    Box endless;
    endless.include(Vec3::Zero());
    endless.include(Vec3::Constant(HUGE_VAL));
    refused(good, {.fit = endless});
    refused({.surface = square(1, 0), .values = {1}}, {});
    refused({.surface = {.points = {Vec3::Zero()}, .triangles = {{0, 0, 1}}}}, {});
    for (const double bad : {std::nan(""), HUGE_VAL, -1e10})
        refused({.surface = {.points = {{1, bad, 2}}, .triangles = {}}}, {});
}

TEST(Draw, OnePointAndTrianglesWithoutAreaDrawNothing) {
    const Shape point{.surface = {.points = {{1, 2, 3}}, .triangles = {{0, 0, 0}}}};
    EXPECT_EQ(draw({&point, 1}, {.width = 100, .height = 100}).rgb, blank(100, 100).rgb);
}

}  // namespace
}  // namespace myotet::report
