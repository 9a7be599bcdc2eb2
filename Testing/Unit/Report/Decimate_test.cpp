// SPDX-License-Identifier: Apache-2.0
#include "Report/Decimate.h"

#include <gtest/gtest.h>

#include "ReportShapes.h"

namespace myotet::report {
namespace {

TEST(Decimated, ABallStaysABallOfAboutAsManyTrianglesAsAsked) {
    const TriMesh fine = ball({10, -20, 30}, 50, 300, 400);
    const TriMesh coarse = decimated(fine, 20000);
    // Cells of a grid are gone through at all angles.
    EXPECT_LT(coarse.triangles.size(), 30000u);
    EXPECT_GT(coarse.triangles.size(), 10000u);
    EXPECT_NEAR(volume(coarse) / volume(fine), 1, 0.01);
    for (const Vec3& p : coarse.points) EXPECT_NEAR((p - Vec3(10, -20, 30)).norm(), 50, 0.5);
}

TEST(Decimated, WhatHasFewEnoughStaysAsItIs) {
    const TriMesh fine = ball({}, 5, 10, 10);
    EXPECT_EQ(decimated(fine, 1000).triangles, fine.triangles);
}

TEST(Decimated, TheSameBytesAgain) {
    const TriMesh fine = ball({}, 5, 100, 100);
    EXPECT_EQ(decimated(fine, 1000).points, decimated(fine, 1000).points);
}

}  // namespace
}  // namespace myotet::report
