// SPDX-License-Identifier: Apache-2.0
// Whole jobs on real scans and surfaces, from file to files.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "Core/TetMesh.h"
#include "Machine.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshJob.h"
#include "Segmentation/Census.h"
#include "Segmentation/ReadLabels.h"
#include "Support/TemporaryFolder.h"

using namespace myotet;
namespace fs = std::filesystem;

namespace {

const fs::path kData = fs::path(MYOTET_SHARED_DIR) / "data";

// Tissues under this many voxels may miss their volume by more.
constexpr std::int64_t kSmallTissue = 2000;
constexpr double kVolumeError = 0.02, kSmallVolumeError = 0.05;

struct Shape {
    double aspect_ratio, min_dihedral_deg, max_dihedral_deg;
};
constexpr Shape kClassic{4.5, 18, 145};
constexpr double kMeanDistance = 0.02, kMaxDistance = 0.15;  // of the median surface edge

// A report has what the whole process took; here it is what the job took.
app::RunReport run(const app::JobOptions& options) {
    SilentProgress quiet;
    const double before = app::processor_seconds();
    app::RunReport r = app::run_job(options, quiet);
    r.run.processor_seconds -= before;
    std::size_t tets = 0;
    for (const auto& t : r.tissues) tets += t.tets;
    std::printf("%s: %zu tissues, %zu tetrahedra, %.1f s of processor time, %.0f MB\n",
                options.scan.input.filename().c_str(), r.tissues.size(), tets,
                r.run.processor_seconds, r.run.peak_memory / 1e6);
    return r;
}

void expect_promises(const app::TissueReport& t) {
    EXPECT_TRUE(t.broken_promises.empty()) << t.name << ": " << t.broken_promises.front();
    EXPECT_EQ(t.shapes.inverted_tets, 0) << t.name;
    EXPECT_TRUE(t.topology.boundary_manifold) << t.name;
    EXPECT_EQ(t.topology.tets_with_four_boundary_nodes, 0) << t.name;
    EXPECT_EQ(t.topology.interior_edges_joining_boundary_nodes, 0) << t.name;
}

void expect_classic(const char* file, double processor_seconds) {
    const fs::path input = kData / "surfaces_classic" / file;
    if (!fs::exists(input)) GTEST_SKIP() << input << " is not here";
    const myotet::testing::TemporaryFolder out;
    const app::RunReport r =
        run({.scan = {.input = input}, .output = out.path() / "mesh", .sizes = {.tets = 100000}});
    ASSERT_EQ(r.tissues.size(), 1u);
    const app::TissueReport& t = r.tissues[0];
    expect_promises(t);
    EXPECT_EQ(t.components_in, t.components_out);
    const double edge = t.surface_edges.median;
    std::printf(
        "  aspect ratio %.2f, dihedral angles %.1f to %.1f, distance mean %.2f %% max "
        "%.1f %%\n",
        t.shapes.max_aspect_ratio, t.shapes.min_dihedral_deg, t.shapes.max_dihedral_deg,
        100 * t.distance.mean / edge, 100 * t.distance.max / edge);
    EXPECT_NEAR(static_cast<double>(t.tets), 1e5, 1e4);
    EXPECT_LE(t.shapes.max_aspect_ratio, kClassic.aspect_ratio);
    EXPECT_GE(t.shapes.min_dihedral_deg, kClassic.min_dihedral_deg);
    EXPECT_LE(t.shapes.max_dihedral_deg, kClassic.max_dihedral_deg);
    EXPECT_LE(t.distance.mean, kMeanDistance * edge);
    EXPECT_LE(t.distance.max, kMaxDistance * edge);
    EXPECT_LE(r.run.processor_seconds, processor_seconds);
}

// Each mesh's centroid within a voxel of its label's.
void expect_in_place(const fs::path& input, const app::RunReport& r, const fs::path& folder) {
    const LabelVolume volume = segmentation::read_labels(input).layers.front();
    std::map<std::int32_t, Vec3> centroids;
    for (const auto& c : segmentation::count_labels(volume)) centroids[c.value] = c.centroid;
    const double voxel = volume.spacing().maxCoeff();
    for (const app::TissueReport& t : r.tissues) {
        if (t.files.empty()) continue;
        const TetMesh mesh = meshfiles::read_vtu(folder / t.files.front());
        EXPECT_LT((centroid(mesh) - centroids.at(t.label)).norm(), voxel) << t.name;
    }
}

void expect_scan(const char* file, std::size_t tissues, const app::SizeOptions& sizes,
                 double processor_seconds, double bytes) {
    const fs::path input = kData / file;
    if (!fs::exists(input)) GTEST_SKIP() << input << " is not here";
    const myotet::testing::TemporaryFolder out;
    const fs::path folder = out.path() / "mesh";
    const app::RunReport r = run({.scan = {.input = input}, .output = folder, .sizes = sizes});
    EXPECT_EQ(r.tissues.size(), tissues);
    double worst = 0, worst_small = 0;
    for (const app::TissueReport& t : r.tissues) {
        expect_promises(t);
        const bool small = t.voxels < kSmallTissue;
        const double error = std::abs(t.volume_mesh / t.volume_labels - 1);
        (small ? worst_small : worst) = std::max(small ? worst_small : worst, error);
        EXPECT_LT(error, small ? kSmallVolumeError : kVolumeError) << t.name;
        EXPECT_FALSE(t.name.empty());
    }
    std::printf("  largest volume error %.2f %%, of small tissues %.2f %%\n", 100 * worst,
                100 * worst_small);
    EXPECT_LE(r.run.processor_seconds, processor_seconds);
    EXPECT_LE(r.run.peak_memory, bytes);
    expect_in_place(input, r, folder);
}

}  // namespace

TEST(JobFigures, Dragon) { expect_classic("quartet/dragon.obj", 10); }
// No time is promised for these; the bound is a fence.
TEST(JobFigures, Skull) { expect_classic("odedstein/skull/skull.obj", 30); }
TEST(JobFigures, Armadillo) { expect_classic("odedstein/armadillo/armadillo.obj", 30); }

TEST(JobFigures, ArmAtThreeMillimetres) {
    expect_scan("arm/bp3d_right_ua1.nii.gz", 32, {.edge_length = 3}, 120, 2e9);
}
TEST(JobFigures, KneeAtSixHundredThousand) {
    expect_scan("labels/spl_knee/spl_knee_seg.nrrd", 49, {.tets = 600000}, 150, 1.5e9);
}
TEST(JobFigures, Trunk) {
    // No time was promised here; the arm's bounds serve as a fence.
    expect_scan("labels/totalsegmentator/example_seg_fast_force_split.nii.gz", 61, {}, 120, 2e9);
}
