// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"
#include "Segmentation/Scalars.h"
#include "Segmentation/TextHeader.h"

namespace myotet::segmentation {

/// What the fields of an NRRD header mean for a label volume.
struct NrrdMeaning {
    Index3 size{0, 0, 0};
    Eigen::Affine3d index_to_lps = Eigen::Affine3d::Identity();
    ScalarType type = ScalarType::uint8;
    std::vector<std::string> warnings;
};

/// Reads type, sizes, kinds, space, directions, origin, spacings and units by
/// the definition of the format (teem.sourceforge.net/nrrd/format.html). The
/// three axes that span space may have axes of size 1 beside them.
/// Throws InputError for layers, vectors, images and whatever does not place
/// voxels in space.
[[nodiscard]] NrrdMeaning interpret_nrrd(const TextHeader& header,
                                         const std::filesystem::path& file);

}  // namespace myotet::segmentation
