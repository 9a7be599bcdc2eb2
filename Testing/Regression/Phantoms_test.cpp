// SPDX-License-Identifier: Apache-2.0
// Whole jobs on phantoms of known truth: from voxels to meshes.
#include "Phantoms/Phantoms.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "MeshFiles/MeshFiles.h"
#include "MeshJob.h"
#include "Quality/Quality.h"
#include "Segmentation/ReadLabels.h"
#include "Support/TemporaryFolder.h"

using namespace myotet;

namespace {

// Volume is given back to that of the voxels, and the mesh fitted to it.
constexpr double kVolumeOfVoxels = 0.005;
// How far the mesh of a smooth body may lie from its true surface, in voxels:
// binary voxels know it to a quarter in the mean; the worst is at the steps that
// nearly flat parts leave.
constexpr double kMeanOfVoxel = 0.25, kMaxOfVoxel = 1.0;
// Boxes have edges that voxels keep and smoothing rounds by its allowance.
constexpr double kBoxMaxOfVoxel = 1.5;

struct Made {
    phantoms::Phantom phantom;
    app::RunReport report;
    std::map<std::int32_t, TetMesh> meshes;
};

Made make(std::string_view name, const phantoms::PhantomOptions& options, double edge_length) {
    const myotet::testing::TemporaryFolder folder;
    Made made;
    made.phantom = phantoms::make_phantom(name, options);
    const auto file = folder.path() / "scan.nii.gz";
    segmentation::write_labels(made.phantom.volume, file);
    SilentProgress quiet;
    made.report = app::run_job({.scan = {.input = file},
                                .output = folder.path() / "out",
                                .sizes = {.edge_length = edge_length}},
                               quiet);
    for (const app::TissueReport& t : made.report.tissues) {
        EXPECT_TRUE(t.broken_promises.empty()) << name << " " << t.label;
        EXPECT_EQ(t.components_in, t.components_out) << name << " " << t.label;
        EXPECT_NEAR(t.volume_mesh / t.volume_labels, 1, kVolumeOfVoxels) << name << " " << t.label;
        if (!t.files.empty())
            made.meshes[t.label] = meshfiles::read_vtu(folder.path() / "out" / t.files.front());
    }
    EXPECT_EQ(made.meshes.size(), made.phantom.true_volume.size()) << name;
    return made;
}

void expect_near_truth(const Made& made, double max_of_voxel) {
    const double voxel = made.phantom.volume.spacing().maxCoeff();
    for (const auto& [label, distance] : made.phantom.distance) {
        const quality::SurfaceDistance d =
            quality::surface_distance(made.meshes.at(label), distance);
        EXPECT_LT(d.mean, kMeanOfVoxel * voxel) << label;
        EXPECT_LT(d.max, max_of_voxel * voxel) << label;
    }
}

std::int64_t euler(const TetMesh& mesh) {
    return quality::measure_topology(mesh.tets, mesh.points.size()).euler_characteristic;
}

Vec3 centroid_of_voxels(const LabelVolume& v, std::int32_t label) {
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (int k = 0; k < v.size[2]; ++k)
        for (int j = 0; j < v.size[1]; ++j)
            for (int i = 0; i < v.size[0]; ++i)
                if (v.values[v.offset(i, j, k)] == label) {
                    sum += v.index_to_lps * Vec3(i, j, k);
                    ++count;
                }
    return sum / count;
}

}  // namespace

TEST(Phantom, Sphere) {
    const Made made = make("sphere", {}, 3);
    expect_near_truth(made, kMaxOfVoxel);
    EXPECT_EQ(euler(made.meshes.begin()->second), 2);
}

TEST(Phantom, TorusKeepsItsHole) {
    const Made made = make("torus", {}, 3);
    expect_near_truth(made, kMaxOfVoxel);
    EXPECT_EQ(euler(made.meshes.begin()->second), 0);
}

TEST(Phantom, TouchingBlocksShareTheirWall) {
    const Made made = make("blocks", {}, 3);
    expect_near_truth(made, kBoxMaxOfVoxel);
    ASSERT_EQ(made.meshes.size(), 2u);
}

TEST(Phantom, ThickSlicedEllipsoid) {
    const Made made = make("ellipsoid", {}, 3);
    expect_near_truth(made, kMaxOfVoxel);
}

TEST(Phantom, HollowShellKeepsItsCavity) {
    const Made made = make("shell", {}, 3);
    expect_near_truth(made, kMaxOfVoxel);
    // Two closed surfaces bound a hollow body.
    EXPECT_EQ(euler(made.meshes.begin()->second), 4);
}

TEST(Phantom, ArmHasAllItsTissuesInPlace) {
    const Made made = make("arm", {.spacing = Vec3::Constant(1.5)}, 4);
    const double voxel = made.phantom.volume.spacing().maxCoeff();
    for (const auto& [label, mesh] : made.meshes)
        EXPECT_LT((centroid(mesh) - centroid_of_voxels(made.phantom.volume, label)).norm(), voxel)
            << made.phantom.volume.name_of(label);
    for (const app::TissueReport& t : made.report.tissues)
        EXPECT_EQ(t.name, made.phantom.volume.name_of(t.label));
}

TEST(Phantom, ObliqueAndLeftHandedScansLieWhereTheyShould) {
    const Mat3 oblique = (Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized())).toRotationMatrix();
    Mat3 left = oblique;
    left.col(0) *= -1;
    for (const Mat3& direction : {oblique, left}) {
        const Made made = make(
            "torus",
            {.spacing = Vec3(1, 1, 2), .direction = direction, .translation = Vec3(-40, 25, 310)},
            3);
        const auto& [label, mesh] = *made.meshes.begin();
        EXPECT_LT((centroid(mesh) - centroid_of_voxels(made.phantom.volume, label)).norm(), 1);
        expect_near_truth(made, kMaxOfVoxel);
        EXPECT_GT(volume(mesh), 0);
    }
}
