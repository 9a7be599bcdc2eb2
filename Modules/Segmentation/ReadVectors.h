// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Core/Geometry.h"

namespace myotet::segmentation {

/// A volume with a vector at each voxel, such as a direction of fibres.
struct VectorVolume {
    Index3 size{0, 0, 0};  ///< voxels along i, j, k
    /// Voxel index (i, j, k), a voxel's centre being at whole numbers, to LPS, mm.
    Eigen::Affine3d index_to_lps = Eigen::Affine3d::Identity();
    /// size[0] * size[1] * size[2], i fastest; LPS, as long as in the file. Zero, or with
    /// a component that is not a number: there is none.
    std::vector<Vec3> vectors;
    std::vector<std::string> warnings;  ///< what the user should know, a sentence each
};

/// Reads vectors from a file of three numbers a voxel, of any integer or real type.
/// - .nii, .nii.gz: three components along dimension 5, or three volumes along dimension 4;
///   slope and intercept are applied. Vectors are taken in the frame of the scanner, RAS, as
///   the standard says; a file in which they are along the voxels' axes or LPS, as some
///   tools write them, must be turned first.
/// - .nrrd, .nhdr: an axis of the kind vector or 3-vector, first or last. Vectors are taken
///   in `space`, through the measurement frame where there is one.
/// Throws IoError when the file cannot be read or is cut short, InputError when its content
/// breaks a rule (not three components, NaN spacing, no vector at all, one that is infinite
/// ...), ResourceError when it does not fit in memory.
/// Memory: 24 bytes a voxel and a little; cost: one pass over the file.
[[nodiscard]] VectorVolume read_vectors(const std::filesystem::path& file);

}  // namespace myotet::segmentation
