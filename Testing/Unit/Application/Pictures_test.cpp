// SPDX-License-Identifier: Apache-2.0
#include "Pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::app {
namespace {

// Two tetrahedra apart: of a muscle whose fibres have a stretch, and of a body without.
contraction::Moment frame_of(double stretch) {
    contraction::Moment frame;
    frame.mesh.points = {{-40, 0, -10}, {-20, 0, -10}, {-30, 20, -10}, {-30, 5, 10},
                         {20, 0, -10},  {40, 0, -10},  {30, 20, -10},  {30, 5, 10}};
    frame.mesh.tets = {{0, 1, 2, 3}, {4, 5, 6, 7}};
    frame.arrays.cells = {{"fiber", 3, {0, 0, 1, 0, 0, 0}}, {"fiber_stretch", 1, {stretch, 1}}};
    frame.arrays.time = 0.25;
    return frame;
}

Box box() {
    Box fit;
    fit.include(Vec3(-50, -50, -50));
    fit.include(Vec3(50, 50, 50));
    return fit;
}

// Whether a pixel there is grey: all channels within a step of one another.
bool grey(const report::Picture& picture, int x, int y) {
    const std::uint8_t* p = picture.rgb.data() + picture.offset(x, y);
    return std::abs(p[0] - p[1]) <= 1 && std::abs(p[1] - p[2]) <= 1 && p[0] < 255;
}

TEST(Pictures, AFrameShowsStretchFromTheFrontAndTheSide) {
    const report::Picture shortened = frame_picture(frame_of(0.7), {}, box());
    EXPECT_EQ(shortened.width % 2, 0);
    const int half = shortened.width / 2, middle = shortened.height / 2 - 15;
    // From the front the patient's left, here the body without fibres, is at the right.
    EXPECT_TRUE(grey(shortened, half / 2 + half * 28 / 100, middle + 5));
    EXPECT_FALSE(grey(shortened, half / 2 - half * 28 / 100, middle + 5));
    EXPECT_NE(frame_picture(frame_of(1.3), {}, box()).rgb, shortened.rgb);
    EXPECT_EQ(frame_picture(frame_of(0.7), {}, box()).rgb, shortened.rgb);
    TriMesh bone = boundary_surface(frame_of(1).mesh);
    for (Vec3& p : bone.points) p.z() += 20;  // beside the bodies, not in them
    EXPECT_NE(frame_picture(frame_of(0.7), {&bone, 1}, box()).rgb, shortened.rgb);
}

TEST(Pictures, TheSheetHoldsTheFirstAndTheLastAndLeavesOutWhatIsMissing) {
    const testing::TemporaryFolder folder;
    EXPECT_TRUE(write_contact_sheet(folder.path(), 3).empty());
    constexpr std::size_t frames = 30, missing = 7;
    for (std::size_t i = 0; i < frames; ++i) {
        const double share = static_cast<double>(i) / frames;
        if (i != missing) write_picture(report::blank(20, 10, {share, 0, 0}), folder.path(), i);
    }
    const auto files = write_contact_sheet(folder.path(), frames);
    ASSERT_EQ(files.size(), frames);  // one is missing, the sheet is there
    EXPECT_EQ(files.front(), "pictures/frame_0000.png");
    EXPECT_EQ(files.back(), kSheetFile);
    const report::Picture sheet = report::read_png(folder.path() / files.back());
    EXPECT_EQ(sheet.width, 60);
    EXPECT_EQ(sheet.height, 40);
    EXPECT_EQ(sheet.rgb[sheet.offset(5, 5)], 0);
    EXPECT_EQ(sheet.rgb[sheet.offset(55, 35)], std::lround(255.0 * 29 / 30));
}

}  // namespace
}  // namespace myotet::app
