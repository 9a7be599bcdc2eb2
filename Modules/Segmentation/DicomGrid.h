// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Core/Geometry.h"

namespace myotet::segmentation {

/// Where the frames of a DICOM object lie: planes of one orientation (DICOM
/// PS3.3, C.7.6.2.1.1 and C.7.6.16.2). Lengths in mm, frame LPS as DICOM's own.
struct FramePlanes {
    int columns = 0, rows = 0;
    Vec3 along_row = Vec3::UnitX();              ///< direction in which the column index grows
    Vec3 along_column = Vec3::UnitY();           ///< direction in which the row index grows
    double column_spacing = 0, row_spacing = 0;  ///< between neighbouring columns, rows
    double slice_spacing = 0;                    ///< as the file says it; 0: it does not
    double slice_thickness = 0;                  ///< for a sole slice that has no spacing; 0: none
    std::vector<Vec3> positions;                 ///< centre of each frame's first pixel
};

/// The grid on which all frames lie.
struct FrameGrid {
    Index3 size{0, 0, 0};
    Eigen::Affine3d index_to_lps = Eigen::Affine3d::Identity();
    std::vector<int> slice_of;  ///< of each frame
    std::vector<std::string> warnings;
};

/// Finds the grid: slices in the order of the planes' normal, as far apart as
/// the file says, else as the nearest two. Slices without a frame lie between
/// others and are a part of the grid. A stack that leans (a tilted gantry)
/// gives a sheared grid. Throws InputError when frames do not lie on one grid
/// to a twentieth of a voxel.
[[nodiscard]] FrameGrid find_grid(const FramePlanes& planes, const std::filesystem::path& file);

}  // namespace myotet::segmentation
