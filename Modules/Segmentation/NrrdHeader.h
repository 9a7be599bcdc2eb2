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

/// What a voxel of an NRRD file is to hold.
enum class NrrdHolds {
    labels,   ///< a label, or one a layer (an axis of the kind list or vector)
    masks,    ///< of each label one: an axis of any kind but a colour's
    vectors,  ///< three numbers: an axis of size 3 of a vector's kind, or of none
};

/// What the fields of an NRRD header mean.
struct NrrdMeaning {
    Index3 size{0, 0, 0};
    Eigen::Affine3d index_to_lps = Eigen::Affine3d::Identity();
    ScalarType type = ScalarType::uint8;
    std::int64_t layers = 1;   ///< values a voxel: labels, which may overlap, or components
    bool interleaved = false;  ///< their axis comes first, as 3D Slicer has it
    Mat3 frame_to_lps = Mat3::Identity();  ///< for the components of vectors
    std::vector<std::string> warnings;
};

/// Reads type, sizes, kinds, space, directions, origin, spacings and units by
/// the definition of the format (teem.sourceforge.net/nrrd/format.html). The
/// three axes that span space may have an axis of values before or behind them
/// and others of size 1; for vectors also the measurement frame.
/// Throws InputError for colours, other vectors, images and whatever does not
/// place voxels in space.
[[nodiscard]] NrrdMeaning interpret_nrrd(const TextHeader& header,
                                         const std::filesystem::path& file, NrrdHolds holds);

/// 3D Slicer's names and colours of segments, one map a layer, by
/// SegmentN_LabelValue, _Layer, _Name (or _ID) and _Color
/// (slicer.readthedocs.io, Segmentations, file format).
[[nodiscard]] std::vector<std::map<std::int32_t, LabelName>> segment_names(const TextHeader& header,
                                                                           std::int64_t layers);

}  // namespace myotet::segmentation
