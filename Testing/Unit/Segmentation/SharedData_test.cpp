// SPDX-License-Identifier: Apache-2.0
// Real label files and odd ones, where the shared data are at hand.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "Core/Errors.h"
#include "Segmentation/Census.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(MYOTET_SHARED_DIR) / "data";
const fs::path kOdd = kData / "odd_inputs" / "synthetic";

/// Odd files that say the same as base.nii.gz.
const std::set<std::string> kSame{"base.nii",
                                  "gz_trailing_garbage.nii.gz",
                                  "not_gz_but_named_gz.nii.gz",
                                  "gz_but_named_nii.nii",
                                  "qform_sform_LR_flip.nii.gz",
                                  "qform_sform_rot90_shift.nii.gz",
                                  "sform_zero_code1.nii.gz",
                                  "qfac_zero.nii.gz",
                                  "float_labels_offset_0.02.nii.gz",
                                  "float64_labels.nii.gz",
                                  "scl_slope_nan.nii.gz",
                                  "int8_labels.nii.gz",
                                  "big_endian_int16.nii.gz",
                                  "nifti2.nii.gz",
                                  "dim4_1.nii.gz",
                                  "units_unknown.nii.gz",
                                  "vox_offset_0.nii.gz",
                                  "base_raw.nrrd",
                                  "base_gzip.nrrd",
                                  "base_ascii.nrrd",
                                  "big_endian_short.nrrd",
                                  "detached_ok.nhdr",
                                  "base.mha",
                                  "base_zlib.mha",
                                  "zlib_wrong_size.mha",
                                  "detached.mhd",
                                  "big_endian_short.mha"};
/// Odd files that are read and say something else.
const std::set<std::string> kRead{"base.nii.gz",
                                  "pixdim_negative_noxform.nii.gz",
                                  "no_xform.nii.gz",
                                  "oblique_17deg.nii.gz",
                                  "uint16_labels_7000.nii.gz",
                                  "int32_labels_200001.nii.gz",
                                  "one_slice.nii.gz",
                                  "single_voxel.nii.gz",
                                  "all_one_label.nii.gz",
                                  "checkerboard.nii.gz",
                                  "hollow_shell_with_core.nii.gz",
                                  "no_spacing.nrrd"};

TEST(SharedData, OddFilesAreReadRightOrRefused) {
    if (!fs::exists(kOdd)) GTEST_SKIP() << kOdd << " is absent";
    const LabelVolume base = read_labels(kOdd / "base.nii.gz").layers.front();
    int files = 0;
    for (const auto& entry : fs::directory_iterator(kOdd)) {
        const std::string name = entry.path().filename().string();
        if (!is_label_file(entry.path())) continue;
        ++files;
        if (!kSame.contains(name) && !kRead.contains(name)) {
            EXPECT_THROW((void)read_labels(entry.path()), Error) << name;
            continue;
        }
        const LabelVolume found = read_labels(entry.path()).layers.front();
        if (kRead.contains(name)) continue;
        EXPECT_EQ(found.values, base.values) << name;
        constexpr double kFloat = 1e-3;  // mm; NIfTI's quaternion has 32 bit
        EXPECT_LT((found.index_to_lps.matrix() - base.index_to_lps.matrix()).cwiseAbs().maxCoeff(),
                  kFloat)
            << name;
    }
    EXPECT_GT(files, 60);
}

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
    EXPECT_EQ(read_labels(folder / "JHU-WhiteMatter-labels-2mm.nii.gz").layers.front().name_of(2),
              "Pontine_crossing_tract_(a_part_of_MCP)");
}

}  // namespace
}  // namespace myotet::segmentation
