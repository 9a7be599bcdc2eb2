// SPDX-License-Identifier: Apache-2.0
// Real label files and odd ones, where the shared data are at hand.
#include <gtest/gtest.h>

#include <filesystem>

#include "Core/Errors.h"
#include "Segmentation/Census.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(MYOTET_SHARED_DIR) / "data";
struct Expected {
    const char* file;
    std::size_t labels, names;
    bool left_handed;
};

TEST(SharedData, ScansHaveTheirLabelsAndNames) {
    for (const Expected& e :
         {Expected{"arm/bp3d_right_ua1.nii.gz", 32, 32, false},
          {"arm/bp3d_right_ua_aniso.nii.gz", 32, 32, false},
          {"labels/spl_knee/spl_knee_seg.nrrd", 49, 48, true},
          {"labels/spl_knee/spl_knee_seg_sub3_MODIFIED.nii.gz", 49, 48, true},
          {"labels/totalsegmentator/example_seg_fast_force_split.nii.gz", 61, 117, false},
          {"labels/slicerio/Segmentation.seg.nrrd", 7, 7, false}}) {
        if (!fs::exists(kData / e.file)) GTEST_SKIP() << kData / e.file << " is absent";
        const LabelFile found = read_labels(kData / e.file);
        EXPECT_EQ(count_labels(found.layers.front()).size(), e.labels) << e.file;
        EXPECT_EQ(found.layers.front().names.size(), e.names) << e.file;
        EXPECT_EQ(found.layers.front().index_to_lps.linear().determinant() < 0, e.left_handed)
            << e.file;
    }
}

TEST(SharedData, TheKneeIsInTheSamePlaceInBothItsFormats) {
    const fs::path knee = kData / "labels" / "spl_knee";
    if (!fs::exists(knee)) GTEST_SKIP() << knee << " is absent";
    const LabelVolume fine = read_labels(knee / "spl_knee_seg.nrrd").layers.front();
    const LabelVolume coarse =
        read_labels(knee / "spl_knee_seg_sub3_MODIFIED.nii.gz").layers.front();
    const auto counts = count_labels(fine), counts_coarse = count_labels(coarse);
    ASSERT_EQ(counts.size(), counts_coarse.size());
    // Every third voxel in the plane: a label of some size keeps its centroid
    // to a fraction of a coarse voxel (0.83 mm).
    constexpr double kApart = 0.3;
    for (std::size_t n = 0; n < counts.size(); ++n) {
        if (counts[n].voxels <= 10000) continue;
        EXPECT_LT((counts[n].centroid - counts_coarse[n].centroid).norm(), kApart)
            << fine.name_of(counts[n].value);
    }
}

TEST(SharedData, AtlasesOfMricronHaveNames) {
    const fs::path folder = "/usr/share/mricron/templates";
    if (!fs::exists(folder / "aal.nii.gz")) GTEST_SKIP() << "package mricron-data is absent";
    const LabelFile aal = read_labels(folder / "aal.nii.gz");
    EXPECT_EQ(count_labels(aal.layers.front()).size(), 116u);
    EXPECT_EQ(aal.layers.front().name_of(1), "Precentral_L");
    EXPECT_EQ(aal.layers.front().names.size(), 116u);
    // Its qform mirrors the axis from foot to head.
    const fs::path jhu = folder / "JHU-WhiteMatter-labels-2mm.nii.gz";
    EXPECT_THROW((void)read_labels(jhu), InputError);
    EXPECT_EQ(read_labels(jhu, {.orientation = Orientation::sform}).layers.front().name_of(2),
              "Pontine_crossing_tract_(a_part_of_MCP)");
}

}  // namespace
}  // namespace myotet::segmentation
