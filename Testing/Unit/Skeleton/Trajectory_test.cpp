// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Core/Errors.h"

namespace myotet::skeleton {
namespace {

using std::numbers::pi;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kRounding = 1e-9;

Model two_coordinates() {
    Model model;
    model.coordinates = {{.name = "flex", .lowest = -1, .highest = 1},
                         {.name = "slide", .rotational = false, .at_rest = 3}};
    return model;
}

/// Rows of flex (rad) and slide (m) at times that a function tells from their number.
template <class Time>
Table rows(int n, Time time, bool degrees = false) {
    Table table;
    table.columns = {"/jointset/j/flex/value", "slide"};
    table.in_degrees = degrees;
    for (int i = 0; i < n; ++i) {
        const double t = time(i);
        table.times.push_back(t);
        table.rows.push_back({(degrees ? 180 / pi : 1) * 0.5 * std::sin(4 * t), 0.01 * t * t});
    }
    return table;
}
const auto even = [](int i) { return 0.01 * i; };
const auto uneven = [](int i) { return 0.01 * i + 0.003 * std::sin(i); };

TEST(Trajectory, AnglesAndLengthsWithTheirDerivatives) {
    for (const bool degrees : {false, true}) {
        const Trajectory trajectory =
            make_trajectory(rows(101, even, degrees), two_coordinates(), {});
        const Instant now = at(trajectory, 0.504);
        // Of a spline of degree 5 whose ends are far away: its fourth order in acceleration.
        EXPECT_NEAR(now.values[0], 0.5 * std::sin(4 * 0.504), 1e-10);
        EXPECT_NEAR(now.speeds[0], 2 * std::cos(4 * 0.504), 1e-8);
        EXPECT_NEAR(now.accelerations[0], -8 * std::sin(4 * 0.504), 1e-5);
        EXPECT_NEAR(now.values[1], 10 * 0.504 * 0.504, kRounding);
        EXPECT_NEAR(now.accelerations[1], 20, 1e-6);
        EXPECT_THAT(trajectory.notes, IsEmpty());
        EXPECT_THAT(trajectory.excursions, IsEmpty());
    }
}

TEST(Trajectory, FilterTakesNoiseAwayAndKeepsTheMotion) {
    for (const bool is_even : {true, false}) {
        Table table = is_even ? rows(201, even) : rows(201, uneven);
        for (std::size_t i = 0; i < table.times.size(); ++i)
            table.rows[i][0] += 0.002 * std::sin(2 * pi * 30 * table.times[i]);
        const Trajectory trajectory = make_trajectory(table, two_coordinates(), {.cutoff_hz = 6});
        for (double t = 0.5; t < 1.5; t += 0.013) {
            const Instant now = at(trajectory, t);
            // 4 rad/s are 0.64 Hz, which pass 6 Hz with a gain of 1 - 1.4e-6; 30 Hz with 1e-5
            // at a sampling near 100 Hz.
            EXPECT_NEAR(now.values[0], 0.5 * std::sin(4 * t), 1e-5);
            EXPECT_NEAR(now.accelerations[0], -8 * std::sin(4 * t), 1e-2);
        }
    }
}

TEST(Trajectory, UntoldCoordinatesKeepTheirDefaultOrFollowTheirFunction) {
    Table table = rows(11, even);
    table.columns = {"flex", "mystery"};
    Model model = two_coordinates();
    Trajectory trajectory = make_trajectory(table, model, {});
    EXPECT_EQ(at(trajectory, 0.05).values[1], 3);
    EXPECT_EQ(at(trajectory, 0.05).speeds[1], 0);
    EXPECT_THAT(trajectory.notes, ElementsAre(HasSubstr("keep their default: slide"),
                                              HasSubstr("no coordinates of the model: mystery")));
    Function ramp;
    ramp.kind = FunctionKind::linear;
    ramp.coefficients = {7, 1};
    model.coordinates[1].prescribed = ramp;
    trajectory = make_trajectory(table, model, {});
    EXPECT_NEAR(at(trajectory, 0.05).values[1], 1.35, kRounding);
    EXPECT_NEAR(at(trajectory, 0.05).speeds[1], 7, kRounding);
    EXPECT_EQ(trajectory.notes.size(), 1u);
}

TEST(Trajectory, RangesAndLocksAreToldNotKept) {
    Model model = two_coordinates();
    model.coordinates[0].highest = 0.4;
    model.coordinates[1].locked = true;
    const Trajectory trajectory = make_trajectory(rows(101, even), model, {});
    ASSERT_EQ(trajectory.excursions.size(), 1u);
    EXPECT_EQ(trajectory.excursions[0].coordinate, 0);
    EXPECT_NEAR(trajectory.excursions[0].time, pi / 8, 0.01);
    EXPECT_NEAR(trajectory.excursions[0].beyond, 0.1, 1e-3);
    EXPECT_THAT(trajectory.notes, ElementsAre(HasSubstr("the model locks: slide")));
}

TEST(Trajectory, KeyFramesBeginAndEndAtRest) {
    Table frames;
    frames.columns = {"flex"};
    frames.times = {0, 0.5, 1.5};
    frames.rows = {{0}, {0.8}, {0.2}};
    const Trajectory trajectory = make_trajectory(frames, two_coordinates(), key_framed());
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(at(trajectory, frames.times[i]).values[0], frames.rows[i][0], kRounding);
    for (const double t : {-1.0, 0.0, 1.5, 2.0})
        EXPECT_NEAR(at(trajectory, t).speeds[0], 0, kRounding);
    EXPECT_EQ(at(trajectory, -1).values[0], 0);
    EXPECT_EQ(at(trajectory, 2).accelerations[0], 0);
    EXPECT_NEAR(at(trajectory, 2).values[0], 0.2, kRounding);
    frames.times = {0.5};
    frames.rows = {{0.8}};
    const Trajectory held = make_trajectory(frames, two_coordinates(), key_framed());
    EXPECT_EQ(at(held, 7).values[0], 0.8);
    EXPECT_EQ(at(held, 7).speeds[0], 0);
}

std::string refusal(const Table& table, const TrajectoryOptions& options) {
    try {
        (void)make_trajectory(table, two_coordinates(), options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no refusal";
}

TEST(Trajectory, WhatCannotBeIsRefused) {
    EXPECT_THAT(refusal(rows(20, even), {.cutoff_hz = 50}), HasSubstr("half the sampling"));
    EXPECT_THAT(refusal(rows(20, even), {.cutoff_hz = -1}), HasSubstr("cutoff_hz is -1"));
    EXPECT_THAT(refusal(rows(20, even), {.cutoff_hz = std::nan("")}), HasSubstr("cutoff_hz"));
    EXPECT_THAT(refusal(rows(20, even), {.degree = 4}), HasSubstr("degree is 4"));
    EXPECT_THAT(refusal(rows(20, even), {.cutoff_hz = 6, .ends = SplineEnds::at_rest}),
                HasSubstr("at rest"));
    EXPECT_THAT(refusal(rows(3, even), {.cutoff_hz = 6}), HasSubstr("cannot be filtered"));
    EXPECT_THAT(refusal(rows(2, even), {}), HasSubstr("at least 3"));
    const auto bursts = [](int i) { return i + (i == 5 ? -1 + 1e-9 : 0); };
    EXPECT_THAT(refusal(rows(20, bursts), {.cutoff_hz = 0.1}), HasSubstr("equal times"));
    Table strange = rows(5, even);
    strange.columns = {"a", "b"};
    EXPECT_THAT(refusal(strange, {}), HasSubstr("name its columns flex, slide"));
    strange.columns = {"flex", "/x/flex/value"};
    EXPECT_THAT(refusal(strange, {}), HasSubstr("may be the column"));
}

}  // namespace
}  // namespace myotet::skeleton
