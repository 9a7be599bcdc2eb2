// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/Series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <pugixml.hpp>

#include "Core/Errors.h"
#include "MeshFiles/Hdf5.h"
#include "MeshFiles/SeriesRead.h"
#include "Support/TemporaryFolder.h"

namespace myotet::meshfiles {
namespace {

using ::testing::HasSubstr;
using testing::read_bytes;

const std::vector<double> kTimes{0, 0.25, 1};

// Two tetrahedra and a triangle beside them.
std::vector<SeriesGrid> two_grids() {
    return {{.name = "bodies",
             .points = 5,
             .tets = {{0, 1, 2, 3}, {1, 2, 3, 4}},
             .triangles = {},
             .labels = {7, 9},
             .label_names = {{7, "a <muscle>"}, {9, "tendon"}},
             .arrays = {{"displacement", 3, true}, {"J", 1, false}, {"stress", 9, false}}},
            {.name = "bone",
             .points = 3,
             .tets = {},
             .triangles = {{0, 1, 2}},
             .labels = {},
             .label_names = {},
             .arrays = {}}};
}

// Numbers that tell where they belong.
std::vector<double> numbers(std::size_t frame, std::size_t grid, const std::string& array) {
    const std::size_t count = grid == 1 ? 9 : array == "J" ? 2 : array == "stress" ? 18 : 15;
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(100.0 * static_cast<double>(frame) + 10.0 * static_cast<double>(grid) +
                         static_cast<double>(array.size()) + static_cast<double>(i) / 32);
    return values;
}

// A dataset by HDF5's own library.
std::vector<double> read_by_library(const std::filesystem::path& file, const std::string& dataset) {
    const hid_t in = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t data = H5Dopen2(in, dataset.c_str(), H5P_DEFAULT), space = H5Dget_space(data);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Sclose(space);
    H5Dclose(data);
    H5Fclose(in);
    return values;
}

class Series : public ::testing::Test {
protected:
    void write(const std::string& name) const {
        write_series(two_grids(), kTimes, numbers, folder_ / name);
    }
    testing::TemporaryFolder folder_;
};

TEST_F(Series, DescribesWhatTheNumbersAre) {
    write("a.xdmf");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder_ / "a.xdmf").c_str()));
    const auto times = document.select_nodes("/Xdmf/Domain/Grid[@CollectionType='Temporal']/Grid");
    ASSERT_EQ(times.size(), kTimes.size());
    std::size_t frame = 0;
    for (const auto& time : times) {
        EXPECT_EQ(time.node().child("Time").attribute("Value").as_double(), kTimes[frame]);
        EXPECT_EQ(time.node().select_nodes("Grid[@GridType='Uniform']").size(), 2u);
        // What moves is the frame's own.
        int moving = 0;
        for (const auto& item : time.node().select_nodes(".//DataItem[@NumberType='Float']")) {
            EXPECT_THAT(item.node().text().get(),
                        ::testing::StartsWith("a.h5:/frame_000" + std::to_string(frame) + "/bo"));
            ++moving;
        }
        EXPECT_EQ(moving, 5);
        ++frame;
    }
    EXPECT_STREQ(document.select_node("//Information[@Name='7']").node().attribute("Value").value(),
                 "a <muscle>");
}

TEST_F(Series, HoldsEachFramesNumbersInTheirOrder) {
    write("a.xdmf");
    const std::filesystem::path heavy = folder_ / "a.h5";
    EXPECT_EQ(read_integers(heavy, "bodies_elements", 4),
              (std::vector<std::int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(read_integers(heavy, "bodies_label", 1), (std::vector<std::int64_t>{7, 9}));
    EXPECT_EQ(read_integers(heavy, "bone_elements", 3), (std::vector<std::int64_t>{0, 1, 2}));
    for (const auto& [dataset, grid, array] :
         std::vector<std::tuple<std::string, std::size_t, std::string>>{
             {"bodies_points", 0, "points"},
             {"bodies_displacement", 0, "displacement"},
             {"bodies_J", 0, "J"},
             {"bodies_stress", 0, "stress"},
             {"bone_points", 1, "points"}}) {
        for (std::size_t f = 0; f < kTimes.size(); ++f) {
            const std::string name = "frame_000" + std::to_string(f) + "/" + dataset;
            const auto values = numbers(f, grid, array);
            const int columns = array == "J" ? 1 : array == "stress" ? 9 : 3;
            EXPECT_EQ(read_reals(heavy, name, columns), values) << name;
            EXPECT_EQ(read_by_library(heavy, name), values) << name;
        }
    }
}

TEST_F(Series, TheSameBytesTwice) {
    write("a.xdmf");
    const std::string heavy = read_bytes(folder_ / "a.h5"), light = read_bytes(folder_ / "a.xdmf");
    write("a.xdmf");
    EXPECT_TRUE(heavy == read_bytes(folder_ / "a.h5"));
    EXPECT_EQ(light, read_bytes(folder_ / "a.xdmf"));
}

TEST_F(Series, WhatCannotBeWrittenIsRefusedWithoutAFile) {
    const auto refuses = [&](const std::vector<SeriesGrid>& grids, const std::vector<double>& times,
                             const std::string& why) {
        try {
            write_series(grids, times, numbers, folder_ / "bad.xdmf");
            FAIL() << why;
        } catch (const std::exception& error) {
            EXPECT_THAT(error.what(), HasSubstr(why));
        }
        EXPECT_FALSE(std::filesystem::exists(folder_ / "bad.xdmf"));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "bad.h5"));
    };
    refuses(two_grids(), {0, 1, 1}, "frame 2 is at 1 s, but times must ascend");
    refuses(two_grids(), {0, std::nan("")}, "times must ascend");
    auto grids = two_grids();
    grids[1].name = "a/b";
    refuses(grids, kTimes, "'a/b_elements' cannot name a dataset");
    grids[1].name = "bodies";
    refuses(grids, kTimes, "'bodies_elements' cannot name a dataset, it stands twice");
    grids = two_grids();
    grids[1].points = 4;
    refuses(grids, kTimes, "frame_0000/bone_points has 9 numbers but must have 12");
}

TEST_F(Series, IsReadBack) {
    write("a.xdmf");
    const auto file = folder_ / "a.xdmf";
    const SeriesContent content = read_series_content(file);
    EXPECT_EQ(content.times, kTimes);
    EXPECT_EQ(content.grids, (std::vector<std::string>{"bodies", "bone"}));
    EXPECT_EQ(read_series_elements(file, "bodies", 4),
              (std::vector<std::int32_t>{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(read_series_elements(file, "bone", 3), (std::vector<std::int32_t>{0, 1, 2}));
    for (std::size_t frame = 0; frame < kTimes.size(); ++frame) {
        EXPECT_EQ(read_series_array(file, {frame, "bodies", "stress", 9}),
                  numbers(frame, 0, "stress"));
        EXPECT_EQ(read_series_array(file, {frame, "bone", kSeriesPoints, 3}),
                  numbers(frame, 1, kSeriesPoints));
    }
    EXPECT_THROW((void)read_series_array(file, {3, "bodies", "J", 1}), IoError);
    EXPECT_THROW((void)read_series_array(file, {0, "bodies", "J", 3}), InputError);
    EXPECT_THROW((void)read_series_elements(file, "bodies", 3), InputError);
}

TEST_F(Series, OfOneGridIsReadBack) {
    const std::vector<SeriesGrid> one{two_grids()[0]};
    write_series(one, kTimes, numbers, folder_ / "one.xdmf");
    EXPECT_EQ(read_series_content(folder_ / "one.xdmf").grids, std::vector<std::string>{"bodies"});
}

TEST_F(Series, ThatIsDamagedIsRefused) {
    testing::write_bytes(folder_ / "a.xdmf", "<Xdmf><Domain>");
    EXPECT_THROW((void)read_series_content(folder_ / "a.xdmf"), InputError);
    testing::write_bytes(folder_ / "b.xdmf", "<Xdmf><Domain/></Xdmf>");
    EXPECT_THROW((void)read_series_content(folder_ / "b.xdmf"), InputError);
    EXPECT_THROW((void)read_series_content(folder_ / "gone.xdmf"), IoError);
}

}  // namespace
}  // namespace myotet::meshfiles
