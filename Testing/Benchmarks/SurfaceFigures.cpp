// SPDX-License-Identifier: Apache-2.0
// Triangle surfaces of all tissues of a scan, from file to files.
#include <gtest/gtest.h>

#include <filesystem>

#include "Machine.h"
#include "Support/TemporaryFolder.h"
#include "SurfaceJob.h"

using namespace myotet;
namespace fs = std::filesystem;

namespace {

const fs::path kData = fs::path(MYOTET_SHARED_DIR) / "data";

// Surfaces move by about half a voxel where necks are smoothed; a spur that is as
// thin goes as a whole.
constexpr double kMovedInVoxels = 1.5;

/// Every tissue is written and has no note but on necks.
void expect_all(const fs::path& input, std::size_t tissues, double voxel) {
    if (!fs::exists(input)) GTEST_SKIP() << input << " is not here";
    const myotet::testing::TemporaryFolder out;
    SilentProgress quiet;
    const double before = app::processor_seconds();  // of the whole process
    const app::SurfaceReport r =
        app::run_surface_job({.scan = {.input = input}, .output = out.path() / "s"}, quiet);
    ASSERT_EQ(r.tissues.size(), tissues);
    std::size_t triangles = 0;
    int places = 0, parts = 0;
    double smallest = 180, largest = 0, moved = 0;
    for (const app::SurfaceTissue& t : r.tissues) {
        SCOPED_TRACE(t.tissue.name);
        EXPECT_TRUE(t.broken_promises.empty()) << t.broken_promises.front();
        EXPECT_EQ(surface::shortfalls(t.quality), std::vector<std::string>{});
        EXPECT_EQ(t.files.size(), 1u);
        EXPECT_LT(t.softened_by, kMovedInVoxels * voxel);
        triangles += t.quality.triangles;
        places += t.softened_places;
        parts += t.components;
        smallest = std::min(smallest, t.quality.smallest_angle_deg);
        largest = std::max(largest, t.quality.largest_angle_deg);
        moved = std::max(moved, t.softened_by);
    }
    std::printf(
        "%s: %zu tissues, %d parts, %zu triangles, %.1f to %.1f degrees, smoothed at %d places "
        "by up to %.2f mm, %.1f s of processor time\n",
        input.filename().c_str(), r.tissues.size(), parts, triangles, smallest, largest, places,
        moved, r.run.processor_seconds - before);
}

}  // namespace

TEST(SurfaceFigures, Arm) { expect_all(kData / "arm/bp3d_right_ua1.nii.gz", 32, 1); }

// Of its gracilis tendon two specks touch; samples are 0.43 mm apart.
TEST(SurfaceFigures, Knee) { expect_all(kData / "labels/spl_knee/spl_knee_seg.nrrd", 49, 0.43); }

TEST(SurfaceFigures, Trunk) {
    expect_all(kData / "labels/totalsegmentator/example_seg_fast_force_split.nii.gz", 61, 3);
}
