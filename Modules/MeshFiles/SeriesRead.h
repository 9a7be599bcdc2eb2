// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MeshFiles/Series.h"

namespace myotet::meshfiles {

/// What a time series that write_series wrote holds: its .xdmf says it, its .h5 has the numbers.
struct SeriesContent {
    std::vector<double> times;       ///< of the frames, s
    std::vector<std::string> grids;  ///< their names
};

/// Throws IoError, InputError when it is damaged or of another make.
[[nodiscard]] SeriesContent read_series_content(const std::filesystem::path& file);

/// Indices of a grid's elements, `corners` each: 3 of triangles, 4 of tetrahedra. Throws IoError
/// when there are none, InputError when they have another number of corners.
[[nodiscard]] std::vector<std::int32_t> read_series_elements(const std::filesystem::path& file,
                                                             const std::string& grid, int corners);

/// Which numbers of a series.
struct SeriesPlace {
    std::size_t frame = 0;
    std::string grid, array;  ///< kSeriesPoints: the points' places
    int components = 1;
};

/// All of them, in the order of points or elements. Throws IoError when there are none, InputError
/// when they have another number of components.
[[nodiscard]] std::vector<double> read_series_array(const std::filesystem::path& file,
                                                    const SeriesPlace& place);

}  // namespace myotet::meshfiles
