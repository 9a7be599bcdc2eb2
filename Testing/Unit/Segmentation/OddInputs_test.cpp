// SPDX-License-Identifier: Apache-2.0
// Every odd file of the shared data: read rightly, or refused with a sentence
// that names the defect. The verdicts stand here, one a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <numeric>

#include "Core/Errors.h"
#include "Segmentation/Census.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path kOdd = fs::path(MYOTET_SHARED_DIR) / "data" / "odd_inputs";

// NIfTI's quaternion has 32 bit.
constexpr double kFloatPlace = 1e-3;  // mm

enum class What {
    same,    ///< voxels and place of the folder's reference file
    voxels,  ///< its voxels, elsewhere; `place` tells where
    other,   ///< read: size, labels and place as told
    refused  ///< the message holds `text`
};

struct Verdict {
    What what = What::refused;
    const char* text = "";   ///< of the refusal, or of the warning; empty: there is none
    Index3 size{0, 0, 0};    ///< of `other`
    std::size_t labels = 0;  ///< of `other`
    Vec3 spacing{0, 0, 0};   ///< of `other` and `voxels`
    std::int32_t shift = 0;  ///< of `same`: added to each label but 0
    Vec3 first{0, 0, 0};     ///< LPS of the first voxel, of `other` and `voxels`
};

Verdict same(const char* warning = "", std::int32_t shift = 0) {
    return {.what = What::same, .text = warning, .shift = shift};
}
Verdict refused(const char* text) { return {.what = What::refused, .text = text}; }
Verdict moved(const Vec3& spacing, const Vec3& first, const char* warning = "") {
    return {.what = What::voxels, .text = warning, .spacing = spacing, .first = first};
}
Verdict other(const Index3& size, std::size_t labels, const Vec3& spacing, const Vec3& first,
              const char* warning = "") {
    return {What::other, warning, size, labels, spacing, 0, first};
}

const Index3 kBaseSize{40, 34, 65};
const Vec3 kBaseSpacing(3, 3, 4), kBaseFirst(-262, -120, 1000);
const Vec3 kOnes(1, 1, 1), kOrigin(0, 0, 0);

/// By path below the folder. The synthetic ones follow their MANIFEST.tsv, except
/// that transforms which disagree are refused until the user says which is right.
const std::map<std::string, Verdict>& verdicts();

void expect_place(const LabelVolume& volume, const Verdict& v) {
    EXPECT_LT((volume.spacing() - v.spacing).cwiseAbs().maxCoeff(), kFloatPlace)
        << volume.spacing().transpose();
    EXPECT_LT((volume.index_to_lps.translation() - v.first).cwiseAbs().maxCoeff(), kFloatPlace)
        << volume.index_to_lps.translation().transpose();
}

void expect_warning(const LabelFile& found, const std::string& text) {
    const std::string all =
        std::accumulate(found.warnings.begin(), found.warnings.end(), std::string());
    if (text.empty())
        EXPECT_EQ(all, "");
    else
        EXPECT_THAT(all, HasSubstr(text));
}

void expect_verdict(const fs::path& file, const Verdict& v, const LabelVolume& base) {
    SCOPED_TRACE(file);
    if (v.what == What::refused) {
        try {
            (void)read_labels(file);
            ADD_FAILURE() << "read, but: " << v.text;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(v.text));
        }
        return;
    }
    const LabelFile found = read_labels(file);
    const LabelVolume& volume = found.layers.front();
    EXPECT_EQ(found.layers.size(), 1u);
    expect_warning(found, v.text);
    if (v.what == What::same)
        EXPECT_LT((volume.index_to_lps.matrix() - base.index_to_lps.matrix()).cwiseAbs().maxCoeff(),
                  kFloatPlace);
    else
        expect_place(volume, v);
    if (v.what == What::other) {
        EXPECT_EQ(volume.size, v.size);
        EXPECT_EQ(count_labels(volume).size(), v.labels);
    } else {
        EXPECT_EQ(volume.size, base.size);
        std::vector<std::int32_t> expected = base.values;
        for (std::int32_t& value : expected) value += value != 0 ? v.shift : 0;
        EXPECT_EQ(volume.values, expected);
    }
}

const std::map<std::string, Verdict>& verdicts() {
    static const std::map<std::string, Verdict> table{
        {"monai/anatomical.nii", refused("labels are not negative")},
        {"monai/anatomical_label.nii.gz", other({33, 41, 25}, 1, 2 * kOnes, {-32, 40, -16})},
        {"monai/reoriented_anat_moved.nii", refused("labels are whole numbers")},
        {"monai/reoriented_anat_moved_label.nii.gz",
         other({21, 26, 22}, 1, 4 * kOnes, {35.2979, 47.9776, -27.5994})},
        {"niivue_tests/nifti_space/ILP.nii.gz", refused("scales values by 0.362956")},
        {"niivue_tests/nifti_space/LAS.nii.gz", refused("scales values by 0.362956")},
        {"niivue_tests/nifti_space/LPS.nii.gz", refused("scales values by 0.362956")},
        {"niivue_tests/nifti_space/PIR.nii.gz", refused("scales values by 0.362956")},
        {"niivue_tests/nifti_space/RAS.nii.gz", refused("scales values by 0.362956")},
        {"niivue_tests/nifti_space/SAR.nii.gz", refused("scales values by 0.362956")},
        {"pynrrd/BallBinary30x30x30.nhdr", same()},
        {"pynrrd/BallBinary30x30x30.nii.gz", same()},
        {"pynrrd/BallBinary30x30x30.nrrd", same()},
        {"pynrrd/BallBinary30x30x30_byteskip_minus_one.nhdr", same()},
        {"pynrrd/BallBinary30x30x30_byteskip_minus_one_nifti.nhdr", same()},
        {"pynrrd/BallBinary30x30x30_gz.nrrd", same()},
        {"pynrrd/BallBinary30x30x30_gz_byteskip_minus_one.nrrd", same()},
        {"pynrrd/BallBinary30x30x30_gz_lineskip.nrrd", same()},
        {"pynrrd/BallBinary30x30x30_byteskip_minus_five.nhdr", refused("byte skip is -5")},
        {"pynrrd/BallBinary30x30x30_bz2.nrrd", refused("encoding 'bzip2'")},
        {"pynrrd/BallBinary30x30x30_nifti.nhdr", refused("not negative")},
        {"pynrrd/test1d_ascii.nrrd", refused("1 dimensions in space")},
        {"pynrrd/test2d_ascii.nrrd", refused("2 dimensions in space")},
        {"pynrrd/test_customFields.nrrd", refused("1 dimensions in space")},
        {"pynrrd/test_simple4d_raw.nrrd", refused("0.76903426, but labels are whole numbers")},
        {"synthetic/base.nii.gz", same()},
        {"synthetic/base.nii", same()},
        {"synthetic/not_gz_but_named_gz.nii.gz", same()},
        {"synthetic/gz_but_named_nii.nii", same()},
        {"synthetic/qfac_zero.nii.gz", same()},
        {"synthetic/float64_labels.nii.gz", same()},
        {"synthetic/scl_slope_nan.nii.gz", same()},
        {"synthetic/int8_labels.nii.gz", same()},
        {"synthetic/nifti2.nii.gz", same()},
        {"synthetic/dim4_1.nii.gz", same()},
        {"synthetic/vox_offset_0.nii.gz", same()},
        {"synthetic/base_raw.nrrd", same()},
        {"synthetic/base_gzip.nrrd", same()},
        {"synthetic/base_ascii.nrrd", same()},
        {"synthetic/big_endian_short.nrrd", same()},
        {"synthetic/detached_ok.nhdr", same()},
        {"synthetic/base.mha", same()},
        {"synthetic/base_zlib.mha", same()},
        {"synthetic/zlib_wrong_size.mha", same()},
        {"synthetic/detached.mhd", same()},
        {"synthetic/big_endian_short.mha", same()},
        {"synthetic/gz_trailing_garbage.nii.gz", same("behind its compressed data")},
        {"synthetic/sform_zero_code1.nii.gz", same("the qform was used")},
        {"synthetic/float_labels_offset_0.02.nii.gz", same("up to 0.0235 away from whole numbers")},
        {"synthetic/units_unknown.nii.gz", same("millimetres were assumed")},
        {"synthetic/big_endian_int16.nii.gz", same("millimetres were assumed")},
        {"synthetic/uint16_labels_7000.nii.gz", same("", 7000)},
        {"synthetic/int32_labels_200001.nii.gz", same("", 200000)},
        {"synthetic/pixdim_negative_noxform.nii.gz",
         moved(kBaseSpacing, kOrigin, "negative; its sign was dropped")},
        {"synthetic/no_xform.nii.gz", moved(kBaseSpacing, kOrigin, "says nothing of its place")},
        {"synthetic/no_spacing.nrrd", moved(kOnes, kOrigin, "1 mm was assumed")},
        {"synthetic/oblique_17deg.nii.gz", moved(kBaseSpacing, kBaseFirst)},
        {"synthetic/all_one_label.nii.gz", other(kBaseSize, 1, kBaseSpacing, kBaseFirst)},
        {"synthetic/one_slice.nii.gz", other({40, 34, 1}, 6, kBaseSpacing, kBaseFirst)},
        {"synthetic/single_voxel.nii.gz", other({1, 1, 1}, 1, kBaseSpacing, kBaseFirst)},
        {"synthetic/checkerboard.nii.gz", other({16, 16, 16}, 2, kOnes, kOrigin)},
        {"synthetic/hollow_shell_with_core.nii.gz", other({24, 24, 24}, 2, kOnes, kOrigin)},
        {"synthetic/trunc_gz_60pct.nii.gz", refused("cut short")},
        {"synthetic/gz_badcrc.nii.gz", refused("incorrect data check")},
        {"synthetic/empty.nii.gz", refused("ends inside its header")},
        {"synthetic/empty_file.nii", refused("the file is empty")},
        {"synthetic/text_file.nii", refused("this is not a NIfTI file")},
        {"synthetic/pixdim_y_zero_qform_only.nii.gz", refused("spacing of 3 x 0 x 4")},
        {"synthetic/pixdim_nan_noxform.nii.gz", refused("nan x 3 x 4")},
        {"synthetic/pixdim_inf_noxform.nii.gz", refused("spacing of inf x 3 x 4")},
        {"synthetic/qform_sform_LR_flip.nii.gz",
         refused("sform and at (28, 120, 1000) by the qform")},
        {"synthetic/qform_sform_rot90_shift.nii.gz",
         refused("--orientation sform or --orientation qform")},
        {"synthetic/float_labels_interpolated.nii.gz", refused("labels are whole numbers")},
        {"synthetic/scl_slope_0.5.nii.gz", refused("scales values by 0.5")},
        {"synthetic/scl_slope_0.003921569.nii.gz", refused("scales values by 0.003922")},
        {"synthetic/dim4_2.nii.gz", refused("2 volumes along dimension 4")},
        {"synthetic/rgb24.nii.gz", refused("stores colours")},
        {"synthetic/dim2_slice.nii.gz", refused("2 dimensions, but tetrahedra need three")},
        {"synthetic/all_zero.nii.gz", refused("holds no labels")},
        {"synthetic/dim_negative.nii.gz", refused("-40 voxels")},
        {"synthetic/dim0_zero.nii.gz", refused("0 dimensions")},
        {"synthetic/dim0_nine.nii.gz", refused("9 dimensions")},
        {"synthetic/datatype_77.nii.gz", refused("datatype 77")},
        {"synthetic/vox_offset_nan.nii.gz", refused("byte nan")},
        {"synthetic/sizeof_hdr_bad.nii.gz", refused("size reads 1234")},
        {"synthetic/magic_bad.nii.gz", refused("NIfTI's mark")},
        {"synthetic/trunc_gzip.nrrd", refused("cut short")},
        {"synthetic/base_bzip2.nrrd", refused("encoding 'bzip2'")},
        {"synthetic/spacedir_nan.nrrd", refused("spacing of nan")},
        {"synthetic/spacings_nan.nrrd", refused("spacings reads 'nan nan nan'")},
        {"synthetic/sizes_too_big.nrrd",
         refused("400 x 400 x 400 voxels, which the file is too short")},
        {"synthetic/detached_missing.nhdr", refused("missing.raw, which does not exist")},
        {"synthetic/spacing_zero.mha", refused("spacing of 0.000000 mm along axis 1")},
        {"synthetic/transform_singular.mha", refused("singular")},
        {"synthetic/missing_raw.mhd", refused("nope.raw, which does not exist")}};
    return table;
}

bool is_header_or_volume(const fs::path& file) {
    return fs::is_regular_file(file) && is_label_file(file);
}

TEST(OddInputs, AreReadRightlyOrRefusedByTheirDefect) {
    if (!fs::exists(kOdd)) GTEST_SKIP() << kOdd << " is absent";
    const LabelVolume base = read_labels(kOdd / "synthetic/base.nii.gz").layers.front();
    const LabelVolume ball = read_labels(kOdd / "pynrrd/BallBinary30x30x30.nrrd").layers.front();
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kOdd)) {
        if (!is_header_or_volume(entry.path())) continue;
        ++files;
        const std::string name = entry.path().lexically_relative(kOdd).string();
        const auto verdict = verdicts().find(name);
        if (verdict == verdicts().end()) {
            ADD_FAILURE() << name << " has no verdict";
            continue;
        }
        expect_verdict(entry.path(), verdict->second, name.starts_with("pynrrd") ? ball : base);
    }
    EXPECT_EQ(files, verdicts().size());  // a verdict without a file is a mistake too
}

TEST(OddInputs, FormsThatDisagreeAreSettledByTheUser) {
    const fs::path flip = kOdd / "synthetic/qform_sform_LR_flip.nii.gz";
    if (!fs::exists(flip)) GTEST_SKIP() << flip << " is absent";
    const LabelVolume base = read_labels(kOdd / "synthetic/base.nii.gz").layers.front();
    for (const char* name : {"qform_sform_LR_flip.nii.gz", "qform_sform_rot90_shift.nii.gz"}) {
        const fs::path file = kOdd / "synthetic" / name;
        const LabelVolume s = read_labels(file, {.orientation = Orientation::sform}).layers.front();
        const LabelVolume q = read_labels(file, {.orientation = Orientation::qform}).layers.front();
        EXPECT_EQ(s.values, base.values);
        EXPECT_EQ(q.values, base.values);
        EXPECT_LT((s.index_to_lps.matrix() - base.index_to_lps.matrix()).cwiseAbs().maxCoeff(),
                  kFloatPlace);
        EXPECT_GT((q.index_to_lps.matrix() - base.index_to_lps.matrix()).cwiseAbs().maxCoeff(), 1);
    }
}

}  // namespace
}  // namespace myotet::segmentation
