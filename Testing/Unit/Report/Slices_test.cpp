// SPDX-License-Identifier: Apache-2.0
#include "Report/Slices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"
#include "ReportShapes.h"
#include "Support/Markup.h"

namespace myotet::report {
namespace {

using ::testing::HasSubstr;

constexpr double kRadius = 10;
const Vec3 kCentre(30, -20, 100);
// A facet of a ball of 60 rings lies this far inside it, mm: r (1 - cos(3 degrees)), twice.
constexpr double kFacet = 0.03;

TEST(Section, OfABallIsACircleOnEachAxis) {
    const TriMesh made = ball(kCentre, kRadius, 60, 60);
    for (int axis = 0; axis < 3; ++axis)
        for (const double share : {-0.9, -0.31, 0.0, 0.57}) {
            const double at = kCentre[axis] + share * kRadius;
            const auto curves = section(made, axis, at);
            ASSERT_FALSE(curves.empty());
            double length = 0;
            for (const auto& curve : curves)
                for (std::size_t i = 0; i < curve.size(); ++i) {
                    EXPECT_NEAR(curve[i][axis], at, 1e-9);
                    EXPECT_NEAR((curve[i] - kCentre).norm(), kRadius, kFacet);
                    if (i > 0) length += (curve[i] - curve[i - 1]).norm();
                }
            const double round = 2 * M_PI * kRadius * std::sqrt(1 - share * share);
            EXPECT_NEAR(length / round, 1, 0.01) << axis << " " << share;
        }
}

TEST(Section, OfAClosedSurfaceCloses) {
    TriMesh cube{.points = {},
                 .triangles = {{0, 2, 1},
                               {1, 2, 3},
                               {4, 5, 6},
                               {5, 7, 6},
                               {0, 1, 4},
                               {1, 5, 4},
                               {2, 6, 3},
                               {3, 6, 7},
                               {0, 4, 2},
                               {2, 4, 6},
                               {1, 3, 5},
                               {3, 7, 5}}};
    for (int n = 0; n < 8; ++n) cube.points.emplace_back(n & 1, n >> 1 & 1, n >> 2 & 1);
    for (const double at : {0.5, 1.0}) {  // through its middle, and along a face
        const auto curves = section(cube, 2, at);
        ASSERT_EQ(curves.size(), 1u);
        EXPECT_EQ(curves[0].front(), curves[0].back());
    }
    EXPECT_TRUE(section(cube, 2, 1.5).empty());
    cube.triangles.erase(cube.triangles.begin() + 4);  // open: the curve has two ends
    const auto open = section(cube, 2, 0.5);
    ASSERT_EQ(open.size(), 1u);
    EXPECT_NE(open[0].front(), open[0].back());
}

TEST(Slice, LooksAsRadiologistsDo) {
    SliceView view{.box = {Vec3(0, 0, 0), Vec3(10, 20, 30)}};
    const auto letters = [&](int axis) {
        view.axis = axis;
        const Sides s = view.sides();
        return std::string{s.left, s.right, s.top, s.bottom};
    };
    EXPECT_EQ(letters(2), "RLAP");
    EXPECT_EQ(letters(1), "RLSI");
    EXPECT_EQ(letters(0), "APSI");
    for (int axis = 0; axis < 3; ++axis) {
        view.axis = axis;
        Vec3 point(1, 2, 3);
        EXPECT_LT((view.to_patient(view.to_picture(point), point[axis]) - point).norm(), 1e-12);
    }
    EXPECT_EQ(sides_of(Vec3::UnitY(), Vec3::UnitZ()).right, 'L');
    EXPECT_EQ(sides_of(-Vec3::UnitX(), Vec3::UnitZ()).left, 'A');
    EXPECT_EQ(sides_of(-Vec3::UnitZ(), -Vec3::UnitY()).left, 'L');
}

// The outline of what was meshed runs around the voxels it was made from.
TEST(Slice, LabelsLieWithinTheOutline) {
    LabelVolume volume;
    volume.size = {30, 30, 30};
    volume.values.assign(27000, 0);
    volume.index_to_lps.linear() = Vec3(-1, 1, 1).asDiagonal();  // towards the patient's right
    volume.index_to_lps.translation() = kCentre + Vec3(14.5, -14.5, -14.5);
    for (int k = 0; k < 30; ++k)
        for (int j = 0; j < 30; ++j)
            for (int i = 0; i < 30; ++i)
                if ((volume.index_to_lps * Vec3(i, j, k) - kCentre).norm() < kRadius)
                    volume.values[volume.offset(i, j, k)] = 7;
    const SliceView view{.axis = 2,
                         .box = {kCentre - Vec3::Constant(15), kCentre + Vec3::Constant(15)}};
    const double at = kCentre.z() + 0.5;
    const Picture labels =
        label_picture(std::span(&volume, 1), view, at, 1, [](int, std::int32_t) { return kBlack; });
    ASSERT_EQ(labels.width, 30);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 30; ++x) {
            const Vec3 p = view.to_patient({x + 0.5, y + 0.5}, at);
            EXPECT_EQ(pixel(labels, x, y)[0] == 0, (p - kCentre).norm() < kRadius);
        }
    const Outlined mesh{ball(kCentre, kRadius, 20, 20), kBlack};
    const std::string svg = slice_svg(labels, std::span(&mesh, 1), view, at, "a \"slice\"");
    EXPECT_EQ(myotet::testing::markup_mistake(svg), "");
    EXPECT_THAT(svg, HasSubstr("viewBox=\"0 0 30.00 30.00\""));
    EXPECT_THAT(svg, HasSubstr("stroke=\"#000000\""));
    EXPECT_THROW((void)label_picture({}, view, at, 0, {}), InputError);
}

}  // namespace
}  // namespace myotet::report
