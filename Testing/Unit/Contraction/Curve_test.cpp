// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::contraction {
namespace {

using myotet::testing::TemporaryFolder;
using myotet::testing::write_bytes;
using ::testing::AllOf;
using ::testing::HasSubstr;

// Sums and products of numbers near one, to rounding.
constexpr double kRounding = 1e-14;

TEST(Curve, IsStraightBetweenPointsAndConstantBeyond) {
    const Curve curve{{0, 0.5, 2}, {0.2, 1, 0}};
    EXPECT_EQ(value_at(curve, -1), 0.2);
    EXPECT_EQ(value_at(curve, 0), 0.2);
    EXPECT_NEAR(value_at(curve, 0.25), 0.6, kRounding);
    EXPECT_EQ(value_at(curve, 0.5), 1);
    EXPECT_NEAR(value_at(curve, 1.25), 0.5, kRounding);
    EXPECT_EQ(value_at(curve, 2), 0);
    EXPECT_EQ(value_at(curve, 9), 0);
    EXPECT_EQ(value_at(constant_curve(0.3), 7), 0.3);
}

TEST(Curve, IsContinuousAtItsPoints) {
    const Curve curve{{0, 0.5, 2}, {0.2, 1, 0}};
    constexpr double kStep = 1e-9, kSteepest = 2;
    for (const double t : curve.times) {
        EXPECT_NEAR(value_at(curve, t - kStep), value_at(curve, t), kSteepest * kStep);
        EXPECT_NEAR(value_at(curve, t + kStep), value_at(curve, t), kSteepest * kStep);
    }
}

TEST(Curve, PointsThatAreNoActivationAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Curve curve;
    EXPECT_EQ(add_activation(curve, 0, 0.5), "");
    EXPECT_THAT(add_activation(curve, 0, 0.5), HasSubstr("must ascend"));
    EXPECT_THAT(add_activation(curve, nan, 0.5), HasSubstr("the time is nan"));
    EXPECT_THAT(add_activation(curve, 1, nan), HasSubstr("from 0 to 1"));
    EXPECT_THAT(add_activation(curve, 1, 1.001), HasSubstr("1.001"));
    EXPECT_THAT(add_activation(curve, 1, -0.001), HasSubstr("-0.001"));
    EXPECT_EQ(curve.times.size(), 1u);
    // What an optimiser leaves of its bounds.
    EXPECT_EQ(add_activation(curve, 1, 1 + 1e-9), "");
    EXPECT_EQ(curve.values.back(), 1);
}

TEST(Follow, IsExactForAConstantExcitation) {
    const muscle::ActivationDynamics dynamics;
    const Curve activation = follow(constant_curve(0.7), dynamics, 0.1005);
    ASSERT_EQ(activation.times.size(), 102u);
    EXPECT_EQ(activation.values[0], 0);
    EXPECT_EQ(activation.times[100], 0.1);
    EXPECT_EQ(activation.times[101], 0.1005) << "the end, off the grid";
    constexpr double kSteps = 1e-12;  // a hundred of them, each to rounding
    for (std::size_t i = 0; i < activation.times.size(); ++i)
        EXPECT_NEAR(activation.values[i], dynamics.after(0, 0.7, activation.times[i]), kSteps);
}

TEST(Follow, SolvesTheEquationOfAnExcitationThatChanges) {
    const muscle::ActivationDynamics dynamics{.rise = 0.01, .fall = 0.04};
    const Curve excitation{{0, 0.1, 0.15, 0.25}, {0, 1, 1, 0.2}};
    const Curve activation = follow(excitation, dynamics, 0.3);
    constexpr double kSecondOrder = 2e-4;  // of steps of 1 ms in times of 10 ms
    constexpr int kPieces = 100;           // of a millisecond, by the midpoint rule
    double a = 0, worst = 0;
    for (std::size_t i = 1; i < activation.times.size(); ++i) {
        const double from = activation.times[i - 1], h = (activation.times[i] - from) / kPieces;
        for (int k = 0; k < kPieces; ++k) {
            const double t = from + k * h;
            const double half = a + 0.5 * h * dynamics.rate(a, value_at(excitation, t));
            a += h * dynamics.rate(half, value_at(excitation, t + 0.5 * h));
        }
        worst = std::max(worst, std::abs(a - activation.values[i]));
    }
    EXPECT_LT(worst, kSecondOrder);
}

TEST(Follow, BeginsBeforeZeroWhereTheExcitationDoes) {
    const muscle::ActivationDynamics dynamics;
    const Curve activation = follow({{-0.5, 1}, {0.4, 0.4}}, dynamics, 1);
    EXPECT_EQ(activation.times.front(), -0.5);
    EXPECT_EQ(activation.times.back(), 1);
    constexpr double kSettled = 1e-6;
    EXPECT_NEAR(value_at(activation, 0), 0.4, kSettled);
    const Curve later = follow({{0.5, 1}, {0.4, 0.4}}, dynamics, 1e-4);
    EXPECT_EQ(later.times, (std::vector<double>{0, 1e-4})) << "and not after it";
}

Curve read(const std::string& name, const std::string& content, const std::string& column) {
    const TemporaryFolder folder;
    write_bytes(folder / name, content);
    return read_activation(folder / name, column);
}

std::string refusal(const std::string& name, const std::string& content,
                    const std::string& column = "a") {
    try {
        (void)read(name, content, column);
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(name));
        return error.what();
    }
    return "no refusal";
}

TEST(ReadActivation, CsvWithCommasSemicolonsAndTabs) {
    for (const std::string content :
         {"time,a,b\n0,0.5,1\n1,0.25,0\n", "time;a;b\r\n0; 0.5;1\r\n\r\n1;+2.5e-1;0\r\n",
          "\xEF\xBB\xBFtime\t\"a\"\tb\n0\t0.5\t1\n1\t0.25\t0"}) {
        const Curve curve = read("x.csv", content, "a");
        EXPECT_EQ(curve.times, (std::vector<double>{0, 1})) << content;
        EXPECT_EQ(curve.values, (std::vector<double>{0.5, 0.25})) << content;
        EXPECT_EQ(read("x.csv", content, "3").values, (std::vector<double>{1, 0})) << content;
    }
}

TEST(ReadActivation, OtherColumnsAreNotLookedAt) {
    EXPECT_EQ(read("x.csv", "time,a,b\n0,0.5,nan\n1,0.25,7\n", "a").values.size(), 2u);
    EXPECT_EQ(read("x.csv", "time\ta\tb\n0\t0.5\t\n1\t0.25\ttext\n", "a").values.size(), 2u);
}

constexpr const char* kSto =
    "states\nversion=1\nnRows=2\nnColumns=4\ninDegrees=no\n\nendheader\n"
    "time\t/forceset/biclong/activation\t/forceset/biclong/fiber_length\tBRA.activation\n"
    "0\t0.1\t0.2\t0.3\n0.5\t0.4\t0.2\t0.6\n";

TEST(ReadActivation, OpenSimColumnsGoByTheirLastPart) {
    EXPECT_EQ(read("x.sto", kSto, "biclong").values, (std::vector<double>{0.1, 0.4}));
    EXPECT_EQ(read("x.sto", kSto, "BRA").values, (std::vector<double>{0.3, 0.6}));
    EXPECT_EQ(read("x.sto", kSto, "/forceset/biclong/activation").times,
              (std::vector<double>{0, 0.5}));
    EXPECT_EQ(read("x.mot", "m\ndatacolumns 2\ndatarows 1\nendheader\n  time  a\n  0   1  \n", "a")
                  .values,
              (std::vector<double>{1}));
}

TEST(ReadActivation, ResultsOfOpenSimAreRead) {
    const std::filesystem::path file = std::filesystem::path(MYOTET_SHARED_DIR) /
                                       "data/opensim/core/Applications/Analyze/tests/resources/"
                                       "std_arm26_StaticOptimization_activation.sto";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
    const Curve curve = read_activation(file, "BIClong");
    EXPECT_EQ(curve.times.size(), 121u);
    EXPECT_EQ(curve.values.front(), 0.00628947126423663820);
    try {
        (void)read_activation(file, "BIClng");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr(":7: "), HasSubstr("did you mean 'BIClong'?"),
                                        HasSubstr("TRIlong, TRIlat")));
    }
}

TEST(ReadActivation, BrokenTablesAreRefusedWithTheLine) {
    EXPECT_THAT(refusal("x.csv", "time,a\n0,0.5\n1,nan\n"),
                AllOf(HasSubstr("x.csv:3: "), HasSubstr("'nan'")));
    EXPECT_THAT(refusal("x.csv", "time,a\n0,inf\n"), HasSubstr("x.csv:2: "));
    EXPECT_THAT(refusal("x.csv", "time;a\n0;0,5\n"), HasSubstr("decimals with a point"));
    EXPECT_THAT(refusal("x.csv", "time,a\n0,\n"), HasSubstr("x.csv:2: column 'a' holds ''"));
    EXPECT_THAT(refusal("x.csv", "time,a\n0,0\n1,0.5,3\n"),
                AllOf(HasSubstr("x.csv:3: "), HasSubstr("3 numbers"), HasSubstr("2 columns")));
    EXPECT_THAT(refusal("x.csv", "time\ta\n\t0.5\n"), HasSubstr("column 'time' holds ''"));
    EXPECT_THAT(refusal("x.csv", "time,a\n1,0\n1,0.5\n"),
                AllOf(HasSubstr("x.csv:3: "), HasSubstr("must ascend")));
    EXPECT_THAT(refusal("x.csv", "time,a\n0,50\n"),
                AllOf(HasSubstr("x.csv:2: "), HasSubstr("from 0 to 1")));
    EXPECT_THAT(refusal("x.csv", "0,0.5\n1,0.5\n"), HasSubstr("line of names first"));
    EXPECT_THAT(refusal("x.csv", "time [ms],a\n0,0.5\n"), HasSubstr("divide them by 1000"));
    EXPECT_THAT(refusal("x.csv", "time,a,a\n0,0,0\n"), HasSubstr("by its number, 2 or 3"));
    EXPECT_THAT(refusal("x.csv", "time,a\n0,0\n", "1"), HasSubstr("no column '1'"));
    EXPECT_THAT(refusal("x.csv", "time,a\n0,0\n", "b"), HasSubstr("no column 'b'"));
    EXPECT_THAT(refusal("x.csv", "time,a\n"), HasSubstr("no row follows"));
    EXPECT_THAT(refusal("x.csv", ""), HasSubstr("no line of column names"));
    EXPECT_THAT(refusal("x.txt", "time,a\n0,0\n"), HasSubstr("'.txt' is no table"));
    EXPECT_THAT(refusal("x.sto", "time a\n0 0\n"), HasSubstr("endheader"));
    EXPECT_THAT(refusal("x.sto", "endheader\nt a\n0 0\n"), HasSubstr("must be 'time'"));
    EXPECT_THAT(refusal("x.sto", "nRows=3\nendheader\ntime a\n0 0\n"), HasSubstr("cut short"));
    EXPECT_THAT(refusal("x.sto", "nColumns=3\nendheader\ntime a\n0 0\n"),
                HasSubstr("3 columns, but 2 are named"));
    EXPECT_THROW((void)read_activation("/nonexistent/x.csv", "a"), IoError);
}

}  // namespace
}  // namespace myotet::contraction
