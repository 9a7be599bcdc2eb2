// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/LabelVolume.h"
#include "Segmentation/Scalars.h"

#include <filesystem>
#include <map>
#include <string>

namespace myotet::segmentation {

enum class ItkFormat { nrrd, metaimage };

/// What an NRRD header means: ITK knows the format's spaces, kinds and synonyms.
struct ItkHeader {
    Index3 size{0, 0, 0};
    Eigen::Affine3d index_to_lps = Eigen::Affine3d::Identity();
    ScalarType type = ScalarType::uint8;
};

/// Reads a header, not the voxels. Throws InputError when ITK cannot make
/// sense of it, or when it is not one volume of scalars in three dimensions.
[[nodiscard]] ItkHeader read_itk_header(const std::filesystem::path& file);

/// Writes voxels with the smallest integer type that holds them, compressed,
/// and `metadata` as key and value. Throws IoError.
void write_itk(const LabelVolume& volume, const std::filesystem::path& file, ItkFormat format,
               const std::map<std::string, std::string>& metadata);

}  // namespace myotet::segmentation
