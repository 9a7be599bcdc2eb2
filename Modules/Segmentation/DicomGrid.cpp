// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/DicomGrid.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "Core/Errors.h"
#include "Segmentation/Formats.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

// Positions are written with some six decimals; no scanner's slices are this thin.
constexpr double kSamePlane = 1e-3;
// A twentieth of a voxel moves no label; rounding of positions is far below it.
constexpr double kOnGrid = 0.05;
constexpr double kUnitLength = 1e-3;
// Slices of any scan number in the thousands; a file that spans more lies.
constexpr double kMostSlices = 65535;

std::string text_of(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

void check_planes(const FramePlanes& p, const fs::path& file) {
    const bool unit = std::abs(p.along_row.norm() - 1) <= kUnitLength &&
                      std::abs(p.along_column.norm() - 1) <= kUnitLength &&
                      std::abs(p.along_row.dot(p.along_column)) <= kUnitLength;
    if (!unit)
        throw InputError(file.string() +
                         ": the image orientation is not two directions of length 1 at right "
                         "angles; correct the file or export it again");
    if (!(p.column_spacing > 0 && p.row_spacing > 0) || !std::isfinite(p.column_spacing) ||
        !std::isfinite(p.row_spacing))
        throw InputError(file.string() + ": the pixel spacing is " + text_of(p.row_spacing) +
                         " x " + text_of(p.column_spacing) +
                         " mm, but spacings are positive numbers; export the file again");
    for (const Vec3& position : p.positions)
        if (!position.allFinite())
            throw InputError(file.string() +
                             ": an image position is not finite; export the file again");
}

/// The step from slice to slice along the normal, from the heights of all frames.
double slice_step(const FramePlanes& p, std::vector<double> heights, const fs::path& file,
                  std::vector<std::string>& warnings) {
    std::sort(heights.begin(), heights.end());
    double nearest = 0;  // the smallest gap between two slices
    for (std::size_t n = 1; n < heights.size(); ++n) {
        const double gap = heights[n] - heights[n - 1];
        if (gap > kSamePlane && (nearest == 0 || gap < nearest)) nearest = gap;
    }
    const double said =
        p.slice_spacing > kSamePlane && std::isfinite(p.slice_spacing) ? p.slice_spacing : 0;
    if (nearest == 0) {
        const double step = said > 0 ? said : p.slice_thickness;
        if (step > kSamePlane && std::isfinite(step)) return step;
        throw InputError(file.string() +
                         ": holds one slice and does not say how thick it is; export the whole "
                         "segmentation");
    }
    const double times = said > 0 ? std::round(nearest / said) : 0;
    if (!(times >= 1 && std::abs(nearest / said - times) <= kOnGrid)) return nearest;
    if (times > 1)
        warnings.push_back(file.string() + ": no two of its slices lie " + text_of(said) +
                           " mm apart as it says; the slices between were taken as empty.");
    return nearest / times;
}

[[noreturn]] void refuse_frame(std::size_t frame, const fs::path& file) {
    throw InputError(file.string() + ": frame " + std::to_string(frame + 1) +
                     " lies off the grid of the others, so its slices are not evenly spaced; "
                     "resample the segmentation to even slices and export it again");
}

}  // namespace

FrameGrid find_grid(const FramePlanes& p, const fs::path& file) {
    check_planes(p, file);
    MYOTET_CHECK(!p.positions.empty(), "there are frames");
    const Vec3 normal = p.along_row.cross(p.along_column).normalized();
    std::vector<double> heights;
    for (const Vec3& position : p.positions) heights.push_back(normal.dot(position));
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    const Vec3 first = p.positions[low - heights.begin()],
               last = p.positions[high - heights.begin()];

    FrameGrid grid;
    const double step = slice_step(p, heights, file, grid.warnings);
    const double slices = std::round((*high - *low) / step) + 1;
    if (!(slices <= kMostSlices))
        throw InputError(file.string() + ": its frames span " + text_of(*high - *low) +
                         " mm in steps of " + text_of(step) +
                         " mm, more slices than any scan has; correct the file's positions");
    const Vec3 to_next = slices > 1 ? Vec3((last - first) / (slices - 1)) : Vec3(step * normal);
    const double allowed = kOnGrid * std::min({step, p.row_spacing, p.column_spacing});
    for (std::size_t n = 0; n < p.positions.size(); ++n) {
        const double slice = std::round((heights[n] - *low) / (*high - *low) * (slices - 1));
        grid.slice_of.push_back(slices > 1 ? static_cast<int>(slice) : 0);
        const Vec3 expected = first + grid.slice_of.back() * to_next;
        if (!((p.positions[n] - expected).norm() <= std::max(allowed, kSamePlane)))
            refuse_frame(n, file);
    }
    grid.size = checked_size({p.columns, p.rows, static_cast<std::int64_t>(slices)}, file);
    grid.index_to_lps.linear().col(0) = p.column_spacing * p.along_row;
    grid.index_to_lps.linear().col(1) = p.row_spacing * p.along_column;
    grid.index_to_lps.linear().col(2) = to_next;
    grid.index_to_lps.translation() = first;
    check_geometry(grid.index_to_lps, file);
    return grid;
}

}  // namespace myotet::segmentation
