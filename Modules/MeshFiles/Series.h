// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "MeshFiles/MeshFiles.h"

namespace myotet::meshfiles {

/// A quantity of a time series: so many numbers a point or an element.
struct SeriesArray {
    std::string name;
    int components = 1;  ///< 1, 3 or 9: a scalar, a vector, a tensor row by row
    bool at_points = false;
};

/// A part of a time series: its elements stay the same, its points move.
struct SeriesGrid {
    std::string name;
    std::size_t points = 0;
    std::vector<Tet> tets;             ///< either these,
    std::vector<Triangle> triangles;   ///< or these
    std::vector<std::int32_t> labels;  ///< one a tetrahedron, or none
    std::map<std::int32_t, std::string> label_names;
    std::vector<SeriesArray> arrays;  ///< besides the points' places
};

/// The name under which a SeriesSource is asked for the points' places, three numbers each, mm.
inline constexpr const char* kSeriesPoints = "points";

/// "0007", four digits at least: how frames are numbered in names.
[[nodiscard]] std::string frame_digits(std::size_t frame);

/// All numbers of an array of a grid at a frame, in the order of points or elements.
using SeriesSource =
    std::function<std::vector<double>(std::size_t frame, std::size_t grid, const std::string&)>;

/// Writes a time series of many frames as two files: `file`, .xdmf, describes, and the .h5
/// beside it holds the numbers: of each grid `GRID_elements` and `GRID_label`, and of each array
/// of each frame `frame_0000/GRID_NAME`, a row a point or element, 32-bit reals. `times` in s,
/// ascending. The source is asked frame by frame, so that one frame's numbers are in memory at a
/// time. The .h5 is whole before the .xdmf is written. The bytes depend on the arguments alone.
/// Throws InputError for names that are not letters, digits, _, - or ., that stand twice, or for
/// times that do not ascend; MeshError when the source gives another count than the grid has;
/// IoError. Source: XDMF 3, collections of grids.
void write_series(std::span<const SeriesGrid> grids, std::span<const double> times,
                  const SeriesSource& source, const std::filesystem::path& file);

}  // namespace myotet::meshfiles
