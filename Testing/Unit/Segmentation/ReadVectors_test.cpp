// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ReadVectors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "Samples.h"

namespace myotet::segmentation {
namespace {

using samples::with;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                kInfinity = std::numeric_limits<float>::infinity();
// Offsets of fields in the NIfTI-1 header.
constexpr std::size_t kDim = 40, kIntent = 68, kDatatype = 70, kVoxOffset = 108, kSlope = 112,
                      kInter = 116, kQformCode = 252, kQuatern = 256, kSrow = 280, kData = 352;
constexpr std::int16_t kShort = 4, kFloat = 16, kDouble = 64;

/// A NIfTI file of 2 x 2 x 1 voxels: their first components, then the second, then the third.
template <class T>
std::string nifti(const std::array<T, 12>& values, std::int16_t datatype, int along = 5) {
    std::string bytes = samples::nifti_bytes().substr(0, kData);
    std::array<std::int16_t, 8> dim{static_cast<std::int16_t>(along), 2, 2, 1, 1, 1, 1, 1};
    dim[along] = 3;
    for (int n = 0; n < 8; ++n) bytes = with(bytes, kDim + 2 * n, dim[n]);
    if (along == 5) bytes = with(bytes, kIntent, std::int16_t{1007});
    bytes = with(bytes, kDatatype, datatype);
    return bytes.append(reinterpret_cast<const char*>(values.data()), sizeof values);
}
const std::array<float, 12> kValues{1, 2, 3, 4, 10, 20, 30, 40, 100, 200, 300, 400};
const std::vector<Vec3> kInLps{{-1, -10, 100}, {-2, -20, 200}, {-3, -30, 300}, {-4, -40, 400}};

const std::string kPlace =
    "space: left-posterior-superior\nspace directions: none (0,2,0) (3,0,0) (0,0,4)\n"
    "space origin: (10,20,30)\n";

/// An NRRD file of 2 x 2 x 1 voxels as text.
std::string nrrd(const std::string& more, const std::string& sizes = "3 2 2 1",
                 const std::string& data = "1 10 100  2 20 200  3 30 300  4 40 400") {
    return "NRRD0004\ntype: float\ndimension: 4\nsizes: " + sizes + "\nencoding: ascii\n" + more +
           "\n" + data + "\n";
}

class Vectors : public ::testing::Test {
protected:
    VectorVolume read(const std::string& bytes, const char* name = "fibres.nii") {
        return read_vectors(samples::write_bytes(folder.path() / name, bytes));
    }
    VectorVolume read_text(const std::string& bytes) { return read(bytes, "fibres.nrrd"); }
    std::string refusal(const std::string& bytes, const char* name = "fibres.nii") {
        try {
            (void)read(bytes, name);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(name));
            return error.what();
        }
        return "no refusal";
    }
    ::myotet::testing::TemporaryFolder folder;
};

TEST_F(Vectors, OfNiftiAreTurnedFromRasToLps) {
    for (const int along : {4, 5}) {
        const VectorVolume found = read(nifti(kValues, kFloat, along));
        EXPECT_EQ(found.size, (Index3{2, 2, 1}));
        EXPECT_EQ(found.vectors, kInLps);
        EXPECT_EQ(found.index_to_lps * Vec3(1, 1, 1), Vec3(-12, -23, 34));
        EXPECT_TRUE(found.warnings.empty());
    }
}

TEST_F(Vectors, AreOfAnyTypeAndScaled) {
    std::array<double, 12> doubles{};
    std::array<std::int16_t, 12> shorts{};
    for (int n = 0; n < 12; ++n) doubles[n] = shorts[n] = static_cast<std::int16_t>(kValues[n]);
    EXPECT_EQ(read(nifti(doubles, kDouble)).vectors, kInLps);
    const std::string whole = nifti(shorts, kShort);
    EXPECT_EQ(read(whole).vectors, kInLps);
    const std::string scaled = with(with(whole, kSlope, 0.5F), kInter, 1.0F);
    EXPECT_EQ(read(scaled).vectors[3], Vec3(-3, -21, 201));
    EXPECT_EQ(read(with(scaled, kSlope, 0.0F)).vectors, kInLps) << "0 means none";
}

TEST_F(Vectors, AreOfTheWorldNotOfAnObliqueGrid) {
    // Axes of length 2, 3, 4 turned by a rational rotation, columns of srow.
    const float srow[12] = {4.F / 3, 2,  4.F / 3, 10, -4.F / 3, 1,
                            8.F / 3, 20, 2.F / 3, -2, 8.F / 3,  30};
    std::string bytes = nifti(kValues, kFloat);
    for (int n = 0; n < 12; ++n) bytes = with(bytes, kSrow + 4 * n, srow[n]);
    const VectorVolume found = read(bytes);
    EXPECT_EQ(found.vectors, kInLps);
    constexpr double kSingle = 1e-6;  // of the header's numbers
    EXPECT_LT((found.index_to_lps * Vec3(3, 1, 3) - Vec3(-20, -25, 38)).norm(), 20 * kSingle);
}

TEST_F(Vectors, ThatAreZeroOrNoNumberStay) {
    std::array<float, 12> values = kValues;
    values[0] = values[4] = values[8] = 0;
    values[5] = kNan;
    const VectorVolume found = read(nifti(values, kFloat));
    EXPECT_EQ(found.vectors[0], Vec3::Zero());
    EXPECT_EQ(found.vectors[1][0], -2);
    EXPECT_TRUE(std::isnan(found.vectors[1][1]));
    EXPECT_EQ(found.vectors[2], kInLps[2]);
}

TEST_F(Vectors, CompressedAndInTheOtherByteOrder) {
    std::string bytes = nifti(kValues, kFloat);
    const std::filesystem::path file = folder.path() / "fibres.nii.gz";
    gzFile out = gzopen(file.c_str(), "wb");
    gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(out);
    EXPECT_EQ(read_vectors(file).vectors, kInLps);
    const auto swap = [&](std::size_t at, std::size_t size, std::size_t count) {
        for (std::size_t n = 0; n < count; ++n)
            std::reverse(bytes.begin() + at + n * size, bytes.begin() + at + (n + 1) * size);
    };
    swap(0, 4, 1);
    swap(kDim, 2, 8);
    swap(kIntent, 2, 3);
    swap(76, 4, 8);
    swap(kVoxOffset, 4, 3);
    swap(kQformCode, 2, 2);
    swap(kQuatern, 4, 18);
    swap(kData, 4, 12);
    EXPECT_EQ(read(bytes).vectors, kInLps);
}

TEST_F(Vectors, OfNiftiAreRefusedByTheirDefect) {
    const std::string good = nifti(kValues, kFloat);
    EXPECT_THAT(refusal(samples::nifti_bytes()), HasSubstr("one value a voxel"));
    EXPECT_THAT(refusal(with(good, kDim + 10, std::int16_t{2})), HasSubstr("2 values along dim"));
    EXPECT_THAT(refusal(with(good, kDim + 8, std::int16_t{3})), HasSubstr("none along others"));
    EXPECT_THAT(refusal(with(good, kIntent, std::int16_t{1005})), HasSubstr("the intent 1005"));
    EXPECT_THAT(refusal(with(good, kDatatype, std::int16_t{128})), HasSubstr("datatype 128"));
    EXPECT_THAT(refusal(with(good, kDim + 2, std::int16_t{9999})), HasSubstr("too short"));
    EXPECT_THAT(refusal(with(good, kSrow, 0.0F)), HasSubstr("spacing of 0 x 3 x 4"));
    EXPECT_THAT(refusal(good + std::string(20, 'x')), HasSubstr("20 bytes more"));
    std::array<float, 12> values = kValues;
    values[6] = kInfinity;
    EXPECT_THAT(refusal(nifti(values, kFloat)), HasSubstr("voxel (0, 1, 0) of layer 1"));
    EXPECT_THAT(refusal(nifti(std::array<float, 12>{}, kFloat)), HasSubstr("holds no vector"));
    const std::string apart = refusal(with(good, kQformCode, std::int16_t{1}));
    EXPECT_THAT(apart, HasSubstr("keep the one that is right"));
    EXPECT_THAT(apart, Not(HasSubstr("--orientation"))) << "which there is not";
}

TEST_F(Vectors, OfNrrdAreInItsSpace) {
    const std::string kinds = "kinds: 3-vector domain domain domain\n";
    const VectorVolume found = read_text(nrrd(kPlace + kinds));
    EXPECT_EQ(found.size, (Index3{2, 2, 1}));
    EXPECT_EQ(found.vectors,
              (std::vector<Vec3>{{1, 10, 100}, {2, 20, 200}, {3, 30, 300}, {4, 40, 400}}));
    EXPECT_EQ(found.index_to_lps * Vec3(1, 1, 1), Vec3(13, 22, 34));
    EXPECT_EQ(read_text(nrrd(kPlace)).vectors, found.vectors) << "of no kind";

    std::string ras = kPlace;
    ras.replace(ras.find("left-posterior-superior"), 23, "right-anterior-superior");
    const VectorVolume turned = read_text(nrrd(ras + "kinds: vector domain domain domain\n"));
    EXPECT_EQ(turned.vectors, kInLps);
    EXPECT_EQ(turned.index_to_lps * Vec3(1, 1, 1), Vec3(-13, -22, 34));
}

TEST_F(Vectors, OfNrrdFollowTheMeasurementFrame) {
    const VectorVolume found =
        read_text(nrrd(kPlace + "kinds: vector domain domain domain\n"
                                "measurement frame: (0,1,0) (-1,0,0) (0,0,1)\n"));
    EXPECT_EQ(found.vectors[0], Vec3(-10, 1, 100));
    EXPECT_THAT(refusal(nrrd(kPlace + "measurement frame: (0,1,0) none (0,0,1)\n"), "a.nrrd"),
                HasSubstr("measurement frame"));
    EXPECT_THAT(refusal(nrrd(kPlace + "measurement frame: (0,1,0) (0,1,0) (0,0,1)\n"), "a.nrrd"),
                HasSubstr("span space"));
}

TEST_F(Vectors, OfNrrdMayComeLast) {
    const VectorVolume found =
        read_text(nrrd("space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\n"
                       "kinds: domain domain domain vector\n",
                       "2 2 1 3", "1 2 3 4 10 20 30 40 nan 200 300 400"));
    EXPECT_EQ(found.vectors[3], Vec3(4, 40, 400));
    EXPECT_TRUE(std::isnan(found.vectors[0][2]));
}

TEST_F(Vectors, OfNrrdAreRefusedByTheirDefect) {
    const auto of = [&](const std::string& bytes) { return refusal(bytes, "fibres.nrrd"); };
    for (const char* kind : {"list", "RGB-color", "quaternion", "3D-symmetric-matrix"})
        EXPECT_THAT(of(nrrd(kPlace + "kinds: " + kind + " domain domain domain\n")),
                    ::testing::AnyOf(HasSubstr("of the kind"), HasSubstr("colours")));
    EXPECT_THAT(of(nrrd(kPlace, "2 2 2 1")), HasSubstr("2 values a voxel"));
    EXPECT_THAT(of(nrrd(kPlace, "1 2 2 1")), HasSubstr("one value a voxel"));
    EXPECT_THAT(of(nrrd(kPlace, "3 2 2 1", "1 2 3 4")), HasSubstr("cut short"));
    EXPECT_THAT(of(nrrd(kPlace, "3 2 2 1", "1 2 x 4")), HasSubstr("too short"));
    EXPECT_THAT(of(nrrd(kPlace, "3 2 2 1", "1 2 x 4 5 6 7 8 9")), HasSubstr("'x' stands where"));
}

TEST_F(Vectors, AreOfAFileThatHoldsThem) {
    EXPECT_THAT(refusal("x", "fibres.mha"), HasSubstr(".nrrd or .nhdr"));
    EXPECT_THAT(refusal("", "fibres.nii"), HasSubstr("empty"));
    EXPECT_THROW((void)read_vectors(folder.path() / "absent.nii"), IoError);
    EXPECT_THROW((void)read_vectors(folder.path()), IoError);
}

/// Either vectors that keep their promises, or one of the errors; nothing else leaves.
void read_damaged(const std::filesystem::path& file) {
    try {
        const VectorVolume found = read_vectors(file);
        const auto [nx, ny, nz] = found.size;
        EXPECT_EQ(found.vectors.size(), static_cast<std::size_t>(nx) * ny * nz);
        EXPECT_TRUE(found.index_to_lps.matrix().allFinite());
    } catch (const Error&) {
    }
}

TEST_F(Vectors, OfDamagedFilesNeverCrash) {
    const std::string whole[] = {
        nifti(kValues, kFloat),
        nrrd(kPlace + "kinds: vector domain domain domain\nmeasurement frame: (0,1,0) (1,0,0) "
                      "(0,0,1)\n")};
    const char* names[] = {"fibres.nii", "fibres.nrrd"};
    for (int k = 0; k < 2; ++k) {
        const auto file = folder.path() / names[k];
        for (std::size_t n = 0; n < whole[k].size(); ++n) {
            read_damaged(samples::write_bytes(file, whole[k].substr(0, n)));
            for (const char c : {'\xff', static_cast<char>(whole[k][n] ^ 1)})
                read_damaged(samples::write_bytes(file, with(whole[k], n, c)));
        }
    }
    for (std::size_t n = 1; n < whole[0].size(); ++n)
        EXPECT_NE(refusal(whole[0].substr(0, n)), "no refusal");
}

}  // namespace
}  // namespace myotet::segmentation
