// SPDX-License-Identifier: Apache-2.0
#include "Phantoms/Phantoms.h"

#include <gtest/gtest.h>

#include <set>

#include "Core/Components.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"

namespace myotet::phantoms {
namespace {

struct Measure {
    std::int64_t voxels = 0;
    Vec3 centroid = Vec3::Zero();  // LPS, mm
    double volume = 0;             // mm^3
};

std::map<std::int32_t, Measure> measure(const LabelVolume& volume) {
    std::map<std::int32_t, Measure> found;
    for (int k = 0; k < volume.size[2]; ++k)
        for (int j = 0; j < volume.size[1]; ++j)
            for (int i = 0; i < volume.size[0]; ++i)
                if (const std::int32_t v = volume.values[volume.offset(i, j, k)]; v != 0) {
                    ++found[v].voxels;
                    found[v].centroid += volume.index_to_lps * Vec3(i, j, k);
                }
    for (auto& [label, m] : found) {
        m.centroid /= static_cast<double>(m.voxels);
        m.volume = static_cast<double>(m.voxels) * volume.voxel_volume();
    }
    return found;
}

Index3 last_of(const LabelVolume& volume) {
    return {volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1};
}

Mat3 oblique() {
    return (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * Eigen::AngleAxisd(-0.7, Vec3::UnitZ()))
        .toRotationMatrix();
}

/// Pairs of labels whose voxels share a face.
std::set<std::pair<int, int>> contacts(const LabelVolume& volume) {
    std::set<std::pair<int, int>> found;
    for (int k = 0; k + 1 < volume.size[2]; ++k)
        for (int j = 0; j + 1 < volume.size[1]; ++j)
            for (int i = 0; i + 1 < volume.size[0]; ++i) {
                const int a = volume.values[volume.offset(i, j, k)];
                for (const std::size_t at : {volume.offset(i + 1, j, k), volume.offset(i, j + 1, k),
                                             volume.offset(i, j, k + 1)})
                    if (const int b = volume.values[at]; a != b && a != 0 && b != 0)
                        found.insert({std::min(a, b), std::max(a, b)});
            }
    return found;
}

/// One a tissue, but for the spindle's two tendons, which share a label.
std::size_t components_of(std::string_view phantom, std::int32_t label) {
    return phantom == "fusiform" && label == 2 ? 2 : 1;
}

TEST(Phantoms, HaveTheirVolumeAndTheirComponents) {
    // Counting voxels errs by a random walk over the surface's voxels, some
    // tenths of a percent for these bodies and up to 5 % for the thin tendons.
    constexpr double kVolume = 0.01, kTendonVolume = 0.06;
    for (const std::string_view name : phantom_names()) {
        const Phantom phantom = make_phantom(name);
        const auto found = measure(phantom.volume);
        ASSERT_EQ(found.size(), phantom.true_volume.size()) << name;
        for (const auto& [label, m] : found) {
            const double truth = phantom.true_volume.at(label);
            EXPECT_NEAR(m.volume / truth, 1, truth < 10000 ? kTendonVolume : kVolume)
                << name << " " << label;
            const Components parts =
                label_components(phantom.volume, label, {0, 0, 0}, last_of(phantom.volume));
            EXPECT_EQ(parts.components.size(), components_of(name, label)) << name << " " << label;
            EXPECT_TRUE(phantom.volume.names.contains(label));
        }
    }
}

TEST(Phantoms, LeaveTheBorderEmpty) {
    for (const std::string_view name : phantom_names()) {
        const LabelVolume volume = make_phantom(name, 2 * default_spacing(name)).volume;
        const Index3 last = last_of(volume);
        for (int k = 0; k <= last[2]; ++k)
            for (int j = 0; j <= last[1]; ++j)
                for (int i = 0; i <= last[0]; ++i) {
                    const bool inside =
                        i > 0 && j > 0 && k > 0 && i < last[0] && j < last[1] && k < last[2];
                    ASSERT_TRUE(inside || volume.values[volume.offset(i, j, k)] == 0) << name;
                }
    }
}

TEST(Phantoms, BlocksAreExactWhereVoxelFacesFallOnTheirFaces) {
    const Phantom phantom = make_phantom("blocks");
    for (const auto& [label, m] : measure(phantom.volume))
        EXPECT_EQ(m.volume, phantom.true_volume.at(label));
    EXPECT_EQ(contacts(phantom.volume), (std::set<std::pair<int, int>>{{1, 2}}));
}

TEST(Phantoms, DistancesAgreeWithTheVoxels) {
    for (const std::string_view name :
         {"sphere", "torus", "blocks", "ellipsoid", "shell", "fusiform"}) {
        PhantomOptions options;
        options.translation = Vec3(31, -7, 12);
        options.direction = oblique();
        const Phantom phantom = make_phantom(name, options);
        const LabelVolume& volume = phantom.volume;
        for (const auto& [label, distance] : phantom.distance)
            for (int k = 0; k < volume.size[2]; k += 2)
                for (int j = 0; j < volume.size[1]; j += 3)
                    for (int i = 0; i < volume.size[0]; i += 3) {
                        const double d = distance(volume.index_to_lps * Vec3(i, j, k));
                        if (std::abs(d) < 1e-9) continue;
                        ASSERT_EQ(d < 0, volume.values[volume.offset(i, j, k)] == label) << name;
                    }
    }
}

TEST(Phantoms, ShellHasAHollow) {
    const LabelVolume volume = make_phantom("shell").volume;
    const Components background = label_components(volume, 0, {0, 0, 0}, last_of(volume));
    EXPECT_EQ(background.components.size(), 2u);  // around it and within
}

/// Directions that a scanner or a converter may give: oblique, mirrored, axes exchanged.
std::vector<Mat3> odd_directions() {
    Mat3 left_handed = oblique();
    left_handed.col(0) *= -1;
    Mat3 permuted = Mat3::Zero();
    permuted(2, 0) = -1, permuted(0, 1) = 1, permuted(1, 2) = 1;
    return {oblique(), left_handed, permuted};
}

TEST(Phantoms, StayInPlaceWhenScannedAlongOtherAxes) {
    // Blocks: thousands of voxels average out. The arm: long thin tissues whose
    // cross-sections are counted with the same error in slice after slice; a voxel.
    constexpr double kBlocks = 0.05, kArm = 1;
    for (const auto& [name, tolerance] : {std::pair{"blocks", kBlocks}, std::pair{"arm", kArm}}) {
        const auto straight = measure(make_phantom(name).volume);
        for (const Mat3& direction : odd_directions()) {
            PhantomOptions options;
            options.direction = direction;
            options.translation = Vec3(-40, 25, 800);
            const Phantom phantom = make_phantom(name, options);
            EXPECT_EQ(phantom.volume.index_to_lps.linear().determinant() > 0,
                      direction.determinant() > 0);
            for (const auto& [label, m] : measure(phantom.volume))
                EXPECT_LT((m.centroid - options.translation - straight.at(label).centroid).norm(),
                          tolerance)
                    << name << " " << label;
        }
    }
}

TEST(Phantoms, EllipsoidIsThickSliced) {
    EXPECT_EQ(make_phantom("ellipsoid").volume.spacing(), Vec3(1, 1, 5));
}

TEST(ArmTruth, VolumesAreThoseOfTheImplicitBodies) {
    // Half of the default spacing; the stated volumes come from 0.2 mm.
    constexpr double kVolume = 0.01;
    const Phantom phantom = make_phantom("arm", Vec3(0.5, 0.5, 0.5));
    for (const auto& [label, m] : measure(phantom.volume))
        EXPECT_NEAR(m.volume / phantom.true_volume.at(label), 1, kVolume) << label;
}

TEST(Arm, MusclesTouchBoneTendonsAndEachOther) {
    const LabelVolume volume = make_phantom("arm").volume;
    std::map<std::string, int> value;
    for (const auto& [label, name] : volume.names) value[name.name] = label;
    const auto touching = contacts(volume);
    const auto touch = [&](const char* a, const char* b) {
        return touching.contains(
            {std::min(value.at(a), value.at(b)), std::max(value.at(a), value.at(b))});
    };
    EXPECT_TRUE(touch("biceps", "humerus"));
    EXPECT_TRUE(touch("triceps", "humerus"));
    EXPECT_TRUE(touch("biceps", "triceps"));
    EXPECT_TRUE(touch("biceps", "biceps_tendon_proximal"));
    EXPECT_TRUE(touch("biceps", "biceps_tendon_distal"));
    EXPECT_TRUE(touch("triceps", "triceps_tendon_proximal"));
    EXPECT_TRUE(touch("triceps", "triceps_tendon_distal"));
    EXPECT_TRUE(touch("humerus", "biceps_tendon_proximal"));
    EXPECT_TRUE(touch("humerus", "triceps_tendon_proximal"));
    EXPECT_TRUE(touch("radius_ulna", "biceps_tendon_distal"));
    EXPECT_TRUE(touch("radius_ulna", "triceps_tendon_distal"));
    EXPECT_FALSE(touch("humerus", "radius_ulna"));  // joint space
    EXPECT_FALSE(touch("humerus", "biceps_tendon_distal"));
}

TEST(Phantoms, AreTheSameOnOneThreadAndMany) {
    const auto many = make_phantom("arm", Vec3(2, 2, 2)).volume.values;
    const ThreadLimit limit(1);
    EXPECT_EQ(make_phantom("arm", Vec3(2, 2, 2)).volume.values, many);
}

TEST(Phantoms, RefuseWhatMakesNoSense) {
    EXPECT_THROW((void)make_phantom("leg"), InputError);
    EXPECT_THROW((void)default_spacing("leg"), InputError);
    EXPECT_THROW((void)make_phantom("sphere", Vec3(1, 0, 1)), InputError);
    EXPECT_THROW((void)make_phantom("sphere", Vec3(1, std::nan(""), 1)), InputError);
    EXPECT_THROW((void)make_phantom("arm", Vec3(0.01, 0.01, 0.01)), ResourceError);
    PhantomOptions sheared;
    sheared.direction(0, 1) = 0.2;
    EXPECT_THROW((void)make_phantom("sphere", sheared), InputError);
}

}  // namespace
}  // namespace myotet::phantoms
