// SPDX-License-Identifier: Apache-2.0
#include "Quality/LabelDistance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Parallel.h"

namespace myotet::quality {
namespace {

constexpr double kRounding = 1e-9;

// A block of label 7 from voxel 3 to 6 along each axis, label 2 above it, turned in space; voxels
// of 1 x 2 x 3 mm.
struct Turned {
    Mat3 rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    Vec3 origin{5, -7, 11}, spacing{1, 2, 3};
    LabelVolume labels;

    Turned() {
        labels.size = {10, 10, 10};
        labels.values.assign(1000, 0);
        for (int k = 3; k <= 6; ++k)
            for (int j = 3; j <= 6; ++j)
                for (int i = 3; i <= 6; ++i) labels.values[labels.offset(i, j, k)] = 7;
        for (int j = 3; j <= 6; ++j)
            for (int i = 3; i <= 6; ++i) labels.values[labels.offset(i, j, 7)] = 2;
        labels.index_to_lps.linear() = rotation * spacing.asDiagonal();
        labels.index_to_lps.translation() = origin;
    }
    // Of a point in mm along the axes, from the corner of the block.
    [[nodiscard]] double at(double x, double y, double z) const {
        const Vec3 corner = 2.5 * spacing;
        const Vec3 p = rotation * (corner + Vec3(x, y, z)) + origin;
        return distance_to_label(labels, 7, {{p}}, 10).front();
    }
};

TEST(LabelDistance, IsThatFromTheBlocksFacesEdgesAndCorners) {
    const Turned block;  // 4 x 8 x 12 mm
    EXPECT_NEAR(block.at(0, 4, 6), 0, kRounding) << "on a face";
    EXPECT_NEAR(block.at(-0.75, 4, 6), 0.75, kRounding);
    EXPECT_NEAR(block.at(1.25, 4, 6), 1.25, kRounding) << "inside";
    EXPECT_NEAR(block.at(2, 4, 11.5), 0.5, kRounding) << "another label begins there";
    EXPECT_NEAR(block.at(-3, -4, 6), 5, kRounding) << "from an edge";
    EXPECT_NEAR(block.at(-1, -2, -2), 3, kRounding) << "from a corner";
}

TEST(LabelDistance, EndsAtTheLimit) {
    const Turned block;
    EXPECT_EQ(block.at(-100, 0, 0), 10);
    const Vec3 inside = block.labels.index_to_lps * Vec3(5, 5, 5);
    EXPECT_EQ(distance_to_label(block.labels, 99, {{inside}}, 2.5).front(), 2.5);
}

TEST(LabelDistance, TheEdgeOfTheVolumeEndsALabel) {
    LabelVolume labels;
    labels.size = {4, 4, 4};
    labels.values.assign(64, 1);
    EXPECT_NEAR(distance_to_label(labels, 1, {{Vec3(0, 1.5, 1.5)}}, 10).front(), 0.5, kRounding);
}

TEST(LabelDistance, OneThreadAndManyAgree) {
    const Turned block;
    std::vector<Vec3> points;
    for (int i = 0; i < 5000; ++i)
        points.emplace_back(std::sin(i) * 20, std::cos(2 * i) * 20, std::sin(3 * i) * 20);
    const auto many = distance_to_label(block.labels, 7, points, 6);
    const ThreadLimit one(1);
    EXPECT_EQ(distance_to_label(block.labels, 7, points, 6), many);
}

}  // namespace
}  // namespace myotet::quality
