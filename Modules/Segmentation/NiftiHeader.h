// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "Segmentation/ByteStream.h"
#include "Segmentation/ReadLabels.h"
#include "Segmentation/Scalars.h"

namespace myotet::segmentation {

/// What both versions of a NIfTI header say, in one form.
struct NiftiHeader {
    int version = 1;
    bool swapped = false;  ///< in the other byte order than this machine's
    std::array<std::int64_t, 8> dim{};
    std::array<double, 8> pixdim{};
    int datatype = 0, intent_code = 0;
    double vox_offset = 0, scl_slope = 0, scl_inter = 0;
    int qform_code = 0, sform_code = 0, xyzt_units = 0;
    std::array<double, 6> quatern{};  ///< b, c, d, offset x, y, z
    Eigen::Matrix<double, 3, 4> srow = Eigen::Matrix<double, 3, 4>::Zero();
};

/// Reads the header from the stream's start. Throws IoError, InputError.
[[nodiscard]] NiftiHeader read_nifti_header(ByteStream& stream);

/// Voxels along i, j, k. Throws InputError unless the image has three dimensions or more.
[[nodiscard]] Index3 nifti_size(const NiftiHeader& header, const std::filesystem::path& file);

/// The type of a value; nothing where it is none of numbers, such as a colour.
[[nodiscard]] std::optional<ScalarType> nifti_type(int datatype);
[[nodiscard]] bool is_nifti_colour(int datatype);

/// Which transform is right, and what a user can do where two disagree.
struct NiftiPlace {
    Orientation orientation = Orientation::agreed;
    const char* remedy = "";
};

/// Voxel index to LPS, mm, checked: the sform, else the qform, else the spacing alone.
/// Throws InputError where both are there and disagree, and where there is none that
/// spans space.
[[nodiscard]] Eigen::Affine3d nifti_index_to_lps(const NiftiHeader& header, const NiftiPlace& place,
                                                 const std::filesystem::path& file,
                                                 std::vector<std::string>& warnings);

/// What values are multiplied by, and what is added then; nothing where the header says
/// none.
struct NiftiScaling {
    double slope = 1, intercept = 0;
};
[[nodiscard]] std::optional<NiftiScaling> nifti_scaling(const NiftiHeader& header);

/// Bytes between the header and the first voxel. Throws InputError.
[[nodiscard]] std::uint64_t nifti_gap(const NiftiHeader& header, const std::filesystem::path& file);

}  // namespace myotet::segmentation
