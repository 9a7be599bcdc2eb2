// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
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
    std::int64_t layers = 1;   ///< label volumes, which may overlap
    bool interleaved = false;  ///< the axis of layers comes first, as 3D Slicer has it
    std::vector<std::string> warnings;
};

/// Reads type, sizes, kinds, space, directions, origin, spacings and units by
/// the definition of the format (teem.sourceforge.net/nrrd/format.html). The
/// three axes that span space may have an axis of layers (kind list or vector;
/// any but a colour with `one_hot`) before or behind them and others of size 1.
/// Throws InputError for colours, other vectors, images and whatever does not
/// place voxels in space.
[[nodiscard]] NrrdMeaning interpret_nrrd(const TextHeader& header,
                                         const std::filesystem::path& file, bool one_hot);

/// 3D Slicer's names and colours of segments, one map a layer, by
/// SegmentN_LabelValue, _Layer, _Name (or _ID) and _Color
/// (slicer.readthedocs.io, Segmentations, file format).
[[nodiscard]] std::vector<std::map<std::int32_t, LabelName>> segment_names(const TextHeader& header,
                                                                           std::int64_t layers);

}  // namespace myotet::segmentation
