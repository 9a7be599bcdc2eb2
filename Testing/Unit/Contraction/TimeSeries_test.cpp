// SPDX-License-Identifier: Apache-2.0
#include "Contraction/TimeSeries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "Contraction/Curve.h"
#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::contraction {
namespace {

using myotet::testing::read_bytes;
using myotet::testing::TemporaryFolder;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Pvd, NamesFilesAndTimes) {
    const TemporaryFolder folder;
    const std::vector<TimedFile> frames{{0, "biceps_0000.vtu"}, {0.1, "frames/a&b_0001.vtu"}};
    write_pvd(frames, folder / "a.pvd");
    EXPECT_EQ(read_bytes(folder / "a.pvd"),
              "<?xml version=\"1.0\"?>\n"
              "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
              "  <Collection>\n"
              "    <DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"biceps_0000.vtu\"/>\n"
              "    <DataSet timestep=\"0.1\" group=\"\" part=\"0\" "
              "file=\"frames/a&amp;b_0001.vtu\"/>\n"
              "  </Collection>\n"
              "</VTKFile>\n");
}

TEST(Pvd, FilesOfOneTimeAreItsParts) {
    const TemporaryFolder folder;
    const std::vector<TimedFile> frames{{0, "a0"}, {0, "b0"}, {0, "c0"}, {0.5, "a1"}, {0.5, "b1"}};
    write_pvd(frames, folder / "a.pvd");
    const std::string text = read_bytes(folder / "a.pvd");
    for (const char* line : {"timestep=\"0\" group=\"\" part=\"0\" file=\"a0\"",
                             "timestep=\"0\" group=\"\" part=\"1\" file=\"b0\"",
                             "timestep=\"0\" group=\"\" part=\"2\" file=\"c0\"",
                             "timestep=\"0.5\" group=\"\" part=\"0\" file=\"a1\"",
                             "timestep=\"0.5\" group=\"\" part=\"1\" file=\"b1\""})
        EXPECT_THAT(text, HasSubstr(line));
}

TEST(Pvd, FramesMustFollowOneAnother) {
    const TemporaryFolder folder;
    const auto write = [&](const std::vector<TimedFile>& frames) {
        write_pvd(frames, folder / "a.pvd");
    };
    EXPECT_THROW(write({{0.1, "a"}, {0, "b"}}), InputError);
    EXPECT_THROW(write({{kNan, "a"}}), InputError);
    EXPECT_THROW(write({{0, ""}}), InputError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_THROW(write_pvd({}, folder / "no/such/a.pvd"), IoError);
}

TEST(History, ReadsBackBitForBit) {
    const TemporaryFolder folder;
    const History history{{{"time", "s"}, {"activation", ""}, {"tension", "N"}},
                          {{0, 1.0 / 3, 12}, {0.1, 0.7, 1e-300}, {0.2, 1, -4.5}}};
    write_history(history, folder / "history.csv");
    EXPECT_THAT(
        read_bytes(folder / "history.csv"),
        ::testing::StartsWith("time [s],activation,tension [N]\n0,0.3333333333333333,12\n"));
    const Curve back = read_activation(folder / "history.csv", "activation");
    for (std::size_t r = 0; r < history.rows.size(); ++r) {
        EXPECT_EQ(back.times[r], history.rows[r][0]);
        EXPECT_EQ(back.values[r], history.rows[r][1]);
    }
}

std::string refusal(const History& history) {
    const TemporaryFolder folder;
    try {
        write_history(history, folder / "h.csv");
    } catch (const InputError& error) {
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
        return error.what();
    }
    return "no refusal";
}

TEST(History, WhatATableCannotHoldIsRefused) {
    EXPECT_THAT(refusal({{{"time", "s"}, {"a,b", ""}}, {}}), HasSubstr("'a,b'"));
    EXPECT_THAT(refusal({{{"", ""}}, {}}), HasSubstr("no name"));
    EXPECT_THAT(refusal({{{"J", ""}, {"J", ""}}, {}}), HasSubstr("two columns are named 'J'"));
    EXPECT_THAT(refusal({{{"time", "s"}}, {{0}, {1, 2}}}), HasSubstr("row 1 has 2 numbers for 1"));
    EXPECT_THAT(refusal({{{"time", "s"}, {"J", ""}}, {{0, kNan}}}), HasSubstr("column 'J' is nan"));
}

}  // namespace
}  // namespace myotet::contraction
