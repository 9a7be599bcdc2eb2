// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "Core/Errors.h"
#include "Samples.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {
namespace {

using samples::nifti_bytes;
using samples::with;
using ::testing::HasSubstr;

// Offsets of fields in the NIfTI-1 header.
constexpr std::size_t kDim = 40, kDatatype = 70, kPixdim = 76, kVoxOffset = 108, kSlope = 112,
                      kInter = 116, kUnits = 123, kQformCode = 252, kSformCode = 254,
                      kQuatern = 256, kSrow = 280, kMagic = 344;

class Nifti : public ::testing::Test {
protected:
    LabelFile read(const std::string& bytes, const ReadOptions& options = {}) {
        return read_labels(samples::write_bytes(folder.path() / "scan.nii", bytes), options);
    }
    void expect_refused(const std::string& bytes, const char* reason,
                        const ReadOptions& options = {}) {
        try {
            (void)read(bytes, options);
            ADD_FAILURE() << "read, but: " << reason;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("scan.nii"));
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    ::myotet::testing::TemporaryFolder folder;
};

TEST_F(Nifti, PutsVoxelsInLps) {
    const LabelFile found = read(nifti_bytes());
    EXPECT_TRUE(found.warnings.empty());
    EXPECT_EQ(found.layers.front().values, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
    // RAS (2 i + 10, 3 j + 20, 4 k + 30).
    EXPECT_EQ(found.layers.front().index_to_lps * Vec3(1, 1, 1), Vec3(-12, -23, 34));
    EXPECT_EQ(found.layers.front().spacing(), Vec3(2, 3, 4));
}

TEST_F(Nifti, KeepsAShearedTransform) {
    const LabelFile found = read(with(nifti_bytes(), kSrow + 4, 0.5F));
    EXPECT_EQ(found.layers.front().index_to_lps * Vec3(0, 1, 0), Vec3(-10.5, -23, 30));
}

TEST_F(Nifti, UsesTheQformWhenThereIsNoSform) {
    // A turn by 90 degrees about z: quaternion (cos 45, 0, 0, sin 45).
    std::string bytes =
        with(with(nifti_bytes(), kSformCode, std::int16_t{0}), kQformCode, std::int16_t{1});
    const float quatern[6] = {0, 0, std::sqrt(0.5F), 1, 2, 3};
    const float pixdim[4] = {-1, 2, 3, 4};  // the sign mirrors k
    for (int n = 0; n < 6; ++n) bytes = with(bytes, kQuatern + 4 * n, quatern[n]);
    for (int n = 0; n < 4; ++n) bytes = with(bytes, kPixdim + 4 * n, pixdim[n]);
    const Vec3 lps = read(bytes).layers.front().index_to_lps * Vec3(1, 1, 1);
    constexpr double kFloat = 1e-5;  // the quaternion has 32 bit
    EXPECT_LT((lps - Vec3(-(1 - 3), -(2 + 2), 3 - 4)).norm(), kFloat);
}

TEST_F(Nifti, WarnsWhenThePlaceIsAmbiguous) {
    const std::string none = with(nifti_bytes(), kSformCode, std::int16_t{0});
    const LabelFile found = read(none);
    EXPECT_EQ(found.layers.front().spacing(), Vec3(1, 1, 1));
    ASSERT_EQ(found.warnings.size(), 1u);
    EXPECT_THAT(found.warnings[0], HasSubstr("nothing of its place"));
}

/// A header whose qform says the same as its sform, without a turn.
std::string with_qform(std::string bytes, float qoffset_x = 10) {
    bytes = with(bytes, kQformCode, std::int16_t{1});
    const float offset[3] = {qoffset_x, 20, 30}, pixdim[4] = {1, 2, 3, 4};
    for (int n = 0; n < 3; ++n) bytes = with(bytes, kQuatern + 12 + 4 * n, offset[n]);
    for (int n = 0; n < 4; ++n) bytes = with(bytes, kPixdim + 4 * n, pixdim[n]);
    return bytes;
}

TEST_F(Nifti, RefusesFormsThatDisagreeByMoreThanHalfAVoxel) {
    // The smallest spacing is 2: half a voxel is 1 mm.
    for (const float x : {10.0F, 9.1F, 10.9F}) {
        const LabelFile found = read(with_qform(nifti_bytes(), x));
        EXPECT_TRUE(found.warnings.empty());
        EXPECT_EQ(found.layers.front().index_to_lps * Vec3(0, 0, 0), Vec3(-10, -20, 30));
    }
    const std::string apart = with_qform(nifti_bytes(), 11.1F);
    for (const char* said : {"(10, 20, 30) RAS by the sform", "(11.1, 20, 30) by the qform",
                             "--orientation sform or --orientation qform"})
        expect_refused(apart, said);
    EXPECT_EQ(read(apart, {.orientation = Orientation::sform}).layers.front().index_to_lps *
                  Vec3(0, 0, 0),
              Vec3(-10, -20, 30));
    constexpr double kFloat = 1e-5;  // the header has 32 bit
    EXPECT_NEAR((read(apart, {.orientation = Orientation::qform}).layers.front().index_to_lps *
                 Vec3(0, 0, 0))[0],
                -11.1, kFloat);
}

TEST_F(Nifti, ComparesFormsOverTheWholeVolume) {
    // Same first voxel, half a per cent longer steps: 1 mm apart at voxel 100, not at voxel 1.
    const std::string near = with(with_qform(nifti_bytes()), kPixdim + 4, 2.01F);
    EXPECT_NO_THROW((void)read(near));
    std::string far = with(with(near, kDim + 2, std::int16_t{150}), kDim + 4, std::int16_t{1});
    far = with(far, kDim + 6, std::int16_t{1}).substr(0, 352) + std::string(150, '\1');
    expect_refused(far, "voxel (149, 0, 0)");
}

TEST_F(Nifti, TakesTheFormThatMakesSense) {
    const Vec3 first(-10, -20, 30);
    // A quaternion of length 2 is no rotation, a spacing of 0 no spacing.
    const std::string turned = with(with_qform(nifti_bytes(), 500), kQuatern, 2.0F);
    const std::string flat = with(with_qform(nifti_bytes(), 500), kPixdim + 4, 0.0F);
    for (const std::string& bytes : {turned, flat}) {
        const LabelFile found = read(bytes);
        EXPECT_EQ(found.layers.front().index_to_lps * Vec3(0, 0, 0), first);
        EXPECT_THAT(found.warnings, ::testing::ElementsAre(HasSubstr("the sform was used")));
        expect_refused(with(bytes, kSformCode, std::int16_t{0}), "not finite");
    }
    const LabelFile found = read(with(with_qform(nifti_bytes()), kSrow, 0.0F));
    EXPECT_EQ(found.layers.front().index_to_lps * Vec3(0, 0, 0), first);
    EXPECT_THAT(found.warnings, ::testing::ElementsAre(HasSubstr("the qform was used")));
}

TEST_F(Nifti, RefusesAFormThatIsAskedForAndAbsent) {
    expect_refused(nifti_bytes(), "the qform is asked for, but the header has none",
                   {.orientation = Orientation::qform});
    expect_refused(with(nifti_bytes(), kSformCode, std::int16_t{0}), "the sform is asked for",
                   {.orientation = Orientation::sform});
    expect_refused(with(nifti_bytes(), kSrow, std::numeric_limits<float>::quiet_NaN()),
                   "not finite", {.orientation = Orientation::sform});
}

/// Three masks of 2 x 2 x 2 voxels; the second overlaps the first, the third none.
std::string one_hot_bytes() {
    std::string bytes = with(with(nifti_bytes(), kDim, std::int16_t{4}), kDim + 8, std::int16_t{3});
    bytes.resize(352);
    return bytes + std::string("\1\1\0\0\0\0\0\0", 8) + std::string("\0\5\5\0\0\0\0\0", 8) +
           std::string("\0\0\0\0\0\0\1\1", 8);
}

TEST_F(Nifti, ReadsMasksOfLabelsOnlyWhenAsked) {
    expect_refused(one_hot_bytes(), "3 volumes along dimension 4");
    expect_refused(one_hot_bytes(), "--one-hot");
    const LabelFile found = read(one_hot_bytes(), {.one_hot = true});
    ASSERT_EQ(found.layers.size(), 2u);
    EXPECT_EQ(found.layers[0].values, (std::vector<std::int32_t>{1, 1, 0, 0, 0, 0, 3, 3}));
    EXPECT_EQ(found.layers[1].values, (std::vector<std::int32_t>{0, 2, 2, 0, 0, 0, 0, 0}));
    EXPECT_EQ(found.layers[1].index_to_lps.matrix(), found.layers[0].index_to_lps.matrix());
}

TEST_F(Nifti, RefusesMasksThatAreNone) {
    std::string several = one_hot_bytes();
    several[353] = 2;
    expect_refused(several, "volume 1 holds the values 1 and 2", {.one_hot = true});
    std::string empty = one_hot_bytes();
    empty[366] = empty[367] = empty[374] = empty[375] = 0;
    EXPECT_THAT(read(empty, {.one_hot = true}).warnings,
                ::testing::ElementsAre(HasSubstr("no voxel is set in volume 3")));
    const std::string five =
        with(with(one_hot_bytes(), kDim, std::int16_t{5}), kDim + 10, std::int16_t{2});
    expect_refused(five, "2 volumes along dimension 5", {.one_hot = true});
    expect_refused(one_hot_bytes().substr(0, 370), "too short", {.one_hot = true});
}

TEST_F(Nifti, TakesTheUnitFromTheHeader) {
    std::string bytes = nifti_bytes();
    bytes[kUnits] = 1;
    EXPECT_EQ(read(bytes).layers.front().spacing(), Vec3(2000, 3000, 4000));
    bytes[kUnits] = 0;
    EXPECT_THAT(read(bytes).warnings,
                ::testing::ElementsAre(HasSubstr("millimetres were assumed")));
}

TEST_F(Nifti, RefusesHeadersThatLie) {
    const std::string good = nifti_bytes();
    expect_refused(with(good, 0, std::int32_t{1234}), "348 or 540");
    expect_refused(with(good, kMagic, 'x'), "mark");
    expect_refused(with(good, kMagic + 1, 'i'), "pair of files");
    expect_refused(with(good, kDim, std::int16_t{9}), "9 dimensions");
    expect_refused(with(good, kDim, std::int16_t{2}), "2 dimensions");
    expect_refused(with(good, kDim + 2, std::int16_t{-2}), "-2 voxels along axis 0");
    expect_refused(with(good, kDim + 4, std::int16_t{0}), "0 voxels along axis 1");
    expect_refused(with(good, kDim + 6, std::int16_t{32767}), "too short to hold");
    expect_refused(with(with(good, kDim, std::int16_t{4}), kDim + 8, std::int16_t{2}), "2 volumes");
    expect_refused(with(good, kVoxOffset, std::numeric_limits<float>::quiet_NaN()), "byte nan");
    expect_refused(with(good, kVoxOffset, 17.0F), "byte 17");
    expect_refused(with(good, kVoxOffset, 1e9F), "cut short");
}

TEST_F(Nifti, RefusesWhatHoldsNoLabels) {
    const std::string good = nifti_bytes();
    expect_refused(with(good, kDatatype, std::int16_t{77}), "datatype 77");
    expect_refused(with(good, kDatatype, std::int16_t{128}), "colours");
    expect_refused(with(good, kDatatype, std::int16_t{32}), "datatype 32");  // complex
    expect_refused(with(good, kSlope, 0.5F), "scales values by 0.5");
    expect_refused(with(with(good, kSlope, 1.0F), kInter, 2.0F), "adds 2");
    EXPECT_NO_THROW((void)read(with(with(good, kSlope, 0.0F), kInter, 2.0F)));
    EXPECT_NO_THROW((void)read(with(good, kSlope, std::numeric_limits<float>::quiet_NaN())));
    std::string negative = with(good, kDatatype, std::int16_t{256});
    negative[355] = -5;
    expect_refused(negative, "voxel (1, 1, 0) has the value -5");
}

TEST_F(Nifti, RefusesASpacingThatIsNone) {
    const std::string good = nifti_bytes();
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinite = std::numeric_limits<float>::infinity();
    expect_refused(with(good, kSrow, nan), "spacing of");
    expect_refused(with(good, kSrow + 12, infinite), "not finite");
    expect_refused(with(good, kSrow, 0.0F), "spacing of 0 x 3 x 4");
    expect_refused(with(with(good, kSrow, 0.0F), kSrow + 16, 2.0F), "singular");
    const std::string unplaced = with(good, kSformCode, std::int16_t{0});
    for (const float bad : {0.0F, nan, infinite}) {
        expect_refused(with(unplaced, kPixdim + 8, bad), "spacing of");
        expect_refused(with(with(unplaced, kQformCode, std::int16_t{1}), kPixdim + 8, bad),
                       "spacing of");
    }
}

TEST_F(Nifti, ReadsBothByteOrders) {
    std::string bytes = nifti_bytes();
    const auto swap = [&](std::size_t at, std::size_t size, std::size_t count) {
        for (std::size_t n = 0; n < count; ++n)
            std::reverse(bytes.begin() + at + n * size, bytes.begin() + at + (n + 1) * size);
    };
    swap(0, 4, 1);
    swap(kDim, 2, 8);
    swap(kDatatype, 2, 2);
    swap(kPixdim, 4, 8);
    swap(kVoxOffset, 4, 3);
    swap(kQformCode, 2, 2);
    swap(kQuatern, 4, 18);
    const LabelFile found = read(bytes);
    EXPECT_EQ(found.layers.front().spacing(), Vec3(2, 3, 4));
    EXPECT_EQ(found.layers.front().values.back(), 7);
}

TEST_F(Nifti, SkipsExtensionsThatAreNotNames) {
    // An extension of 32 bytes whose size field lies.
    for (const std::int32_t claimed : {32, 0, -1, 7, 1 << 30}) {
        std::string bytes = with(nifti_bytes(), kVoxOffset, 384.0F);
        bytes.insert(352, 32, '<');
        bytes = with(with(bytes, 348, char{1}), 352, claimed);
        EXPECT_EQ(read(bytes).layers.front().values.back(), 7);
        EXPECT_TRUE(read(bytes).layers.front().names.empty());
    }
}

TEST_F(Nifti, TellsOfBytesThatTheHeaderDoesNotKnow) {
    EXPECT_THAT(read(nifti_bytes() + "abc").warnings,
                ::testing::ElementsAre(HasSubstr("3 bytes more")));
    expect_refused(nifti_bytes() + std::string(17, '\1'), "17 bytes more");
}

}  // namespace
}  // namespace myotet::segmentation
