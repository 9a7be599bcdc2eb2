// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/DicomGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kRounding = 1e-9;

FramePlanes planes_at(std::initializer_list<double> heights) {
    FramePlanes planes{.columns = 4, .rows = 3, .column_spacing = 0.5, .row_spacing = 0.75};
    for (const double z : heights) planes.positions.emplace_back(1, 2, z);
    return planes;
}

void expect_refused(const FramePlanes& planes, const char* reason) {
    try {
        (void)find_grid(planes, "scan.dcm");
        ADD_FAILURE() << "read, but: " << reason;
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(reason));
    }
}

TEST(DicomGrid, SortsFramesAndKeepsPlacesOfEmptySlices) {
    const FrameGrid grid = find_grid(planes_at({16, 10, 12, 10}), "scan.dcm");
    EXPECT_EQ(grid.size, (Index3{4, 3, 4}));
    EXPECT_THAT(grid.slice_of, ElementsAre(3, 0, 1, 0));
    EXPECT_LT((grid.index_to_lps * Vec3(2, 1, 3) - Vec3(2, 2.75, 16)).norm(), kRounding);
    EXPECT_THAT(grid.warnings, IsEmpty());
}

TEST(DicomGrid, GoesAlongTheNormalOfObliquePlanes) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
    FramePlanes planes = planes_at({5, 3, 4});
    planes.along_row = turn * planes.along_row;
    planes.along_column = turn * planes.along_column;
    for (Vec3& position : planes.positions) position = turn * position;
    const FrameGrid grid = find_grid(planes, "scan.dcm");
    EXPECT_THAT(grid.slice_of, ElementsAre(2, 0, 1));
    EXPECT_LT((grid.index_to_lps * Vec3(2, 1, 2) - turn * Vec3(2, 2.75, 5)).norm(), kRounding);
    EXPECT_GT(grid.index_to_lps.linear().determinant(), 0);
}

TEST(DicomGrid, LeansWithATiltedStack) {
    FramePlanes planes = planes_at({0, 1, 2, 3});
    for (Vec3& position : planes.positions) position[1] += 0.3 * position[2];
    const FrameGrid grid = find_grid(planes, "scan.dcm");
    EXPECT_LT((grid.index_to_lps * Vec3(0, 0, 3) - Vec3(1, 2.9, 3)).norm(), kRounding);
}

TEST(DicomGrid, TakesTheSpacingThatTheFileSaysWhenFramesFitIt) {
    FramePlanes planes = planes_at({0, 4, 8});
    planes.slice_spacing = 2;
    const FrameGrid fitting = find_grid(planes, "scan.dcm");
    EXPECT_EQ(fitting.size[2], 5);
    EXPECT_THAT(fitting.warnings, ElementsAre(HasSubstr("no two of its slices lie 2 mm apart")));
    planes.slice_spacing = 3;  // a thickness, not a spacing
    EXPECT_EQ(find_grid(planes, "scan.dcm").size[2], 3);
}

TEST(DicomGrid, NeedsTheThicknessOfASoleSlice) {
    expect_refused(planes_at({7, 7}), "one slice");
    FramePlanes thick = planes_at({7, 7});
    thick.slice_thickness = 3;
    EXPECT_DOUBLE_EQ(find_grid(thick, "scan.dcm").index_to_lps.linear()(2, 2), 3);
    thick.slice_spacing = 2.5;
    EXPECT_DOUBLE_EQ(find_grid(thick, "scan.dcm").index_to_lps.linear()(2, 2), 2.5);
}

TEST(DicomGrid, ToleratesRoundedPositionsAndNoMore) {
    EXPECT_EQ(find_grid(planes_at({0, 1.0001, 1.9999, 3}), "scan.dcm").size[2], 4);
    expect_refused(planes_at({0, 1, 2.1, 3}), "frame 3 lies off the grid");
    FramePlanes sideways = planes_at({0, 1, 2});
    sideways.positions[1][0] += 0.1;
    expect_refused(sideways, "frame 2 lies off the grid");
}

TEST(DicomGrid, RefusesWhatPlacesNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    FramePlanes planes = planes_at({0, 1});
    planes.along_column = planes.along_row;
    expect_refused(planes, "right angles");
    planes.along_column = {0, nan, 0};
    expect_refused(planes, "right angles");
    planes = planes_at({0, 1});
    planes.row_spacing = 0;
    expect_refused(planes, "pixel spacing is 0 x 0.5");
    planes.row_spacing = nan;
    expect_refused(planes, "pixel spacing");
    expect_refused(planes_at({0, nan}), "not finite");
    expect_refused(planes_at({0, 1, 1e6}), "more slices than any scan");
}

}  // namespace
}  // namespace myotet::segmentation
