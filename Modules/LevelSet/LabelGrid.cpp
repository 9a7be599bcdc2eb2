// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/LabelGrid.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "Core/Errors.h"
#include "LevelSet/SliceShape.h"

namespace myotet::levelset {
namespace {

// The staircase of a smooth surface strays half a voxel from it; no more needs
// undoing, and with less the voxels' middles would be pushed off the surface
// that they may lie on.
constexpr double kSmoothOfVoxel = 0.5;
// Blocks beyond the volume on every side: band, coarse cells and smoothing.
constexpr int kMarginBlocks = 3;

Mat3 nearest_rotation(const Mat3& directions) {
    const Eigen::JacobiSVD<Mat3> svd(directions, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 rotation = svd.matrixU() * svd.matrixV().transpose();
    if (rotation.determinant() < 0) rotation.col(2) = -rotation.col(2);
    return rotation;
}

// What the work takes, from the walls' area summed over both sides. Per face of
// a block that walls fill, measured on a knee of 49 tissues (37 000 faces), an
// arm of 32 (15 000) and a body of 61 (6 000): 1.2 blocks for bands, as much
// for the result; 11 kB at the peak, the largest region's scratch included.
struct Forecast {
    double bytes = 0;
    double seconds = 0;  ///< of one processor, an ordinary one
};
Forecast forecast(double area, double voxels, double smooth, double spacing) {
    constexpr double kBytesPerFace = 11e3, kBytesPerVoxel = 5;
    constexpr double kSecondsPerFace = 5.4e-4, kSecondsPerStep = 1.5e-5;
    const double faces = area / std::pow(LevelSet::kBrickCells * spacing, 2);
    // Flow time grows with the square of `smooth`, steps have spacing^2 / 5.
    const double steps = 4 * 5 * 1.4 * smooth * smooth / (spacing * spacing);
    return {kBytesPerFace * faces + kBytesPerVoxel * voxels,
            faces * (kSecondsPerFace + kSecondsPerStep * steps)};
}

double choose_spacing(double area, double voxels, double smooth, const Vec3& side) {
    constexpr double kModestBytes = 8e8, kModestSeconds = 30;
    const double widest = std::cbrt(side.prod());
    double spacing = side.minCoeff();
    while (spacing < widest) {
        const Forecast f = forecast(area, voxels, smooth, spacing);
        if (f.bytes <= kModestBytes && f.seconds <= kModestSeconds) return spacing;
        spacing *= 1.02;
    }
    return widest;
}

}  // namespace

Vec3 plane_spacing(const LabelVolume& volume) {
    const Mat3 inverse = volume.index_to_lps.linear().inverse();
    return inverse.rowwise().norm().cwiseInverse();
}

Vec3 face_area(const LabelVolume& volume) {
    return (volume.voxel_volume() / plane_spacing(volume).array()).matrix();
}

LabelGrid lay_grid(const LabelVolume& volume, std::span<const SharedWall> walls,
                   const LabelOptions& options) {
    LabelGrid grid;
    grid.lattice.plane_spacing = plane_spacing(volume);
    const Vec3& side = grid.lattice.plane_spacing;
    double area = 0;
    for (const SharedWall& w : walls) area += 2 * w.area;
    const double voxels = static_cast<double>(volume.values.size());
    // Between thick slices shape is interpolated: what is left are the pixels' steps.
    const int thick = thick_axis(side);
    const double step = thick < 0 ? side.maxCoeff() : larger_pixel_side(side, thick);
    grid.smooth = options.smooth < 0 ? kSmoothOfVoxel * step : options.smooth;
    if (grid.smooth > 0) grid.lattice.thick_axis = thick;
    const double h =
        options.spacing > 0 ? options.spacing : choose_spacing(area, voxels, grid.smooth, side);
    grid.lattice.spacing = h;
    grid.forecast_bytes = forecast(area, voxels, grid.smooth, h).bytes;
    if (!(grid.forecast_bytes <= options.max_memory)) {
        std::ostringstream out;
        out.precision(3);
        out << "level sets with samples " << h << " mm apart would need about "
            << grid.forecast_bytes / 1e9 << " GB where " << options.max_memory / 1e9
            << " GB are allowed; ask for fewer labels or a wider spacing";
        throw ResourceError(out.str());
    }

    Mat3 directions = volume.index_to_lps.linear();
    for (int a = 0; a < 3; ++a) directions.col(a).normalize();
    grid.frame.rotation = nearest_rotation(directions);
    const Mat3 turn = grid.frame.rotation.transpose();
    Box box;
    for (int corner = 0; corner < 8; ++corner)
        box.include(turn * (volume.index_to_lps * Vec3(corner & 1 ? volume.size[0] - 0.5 : -0.5,
                                                       corner & 2 ? volume.size[1] - 0.5 : -0.5,
                                                       corner & 4 ? volume.size[2] - 0.5 : -0.5)));
    const double block = LevelSet::kBrickCells * h;
    const Vec3 centre = turn * (volume.index_to_lps * Vec3::Zero());
    Vec3 origin;
    for (int a = 0; a < 3; ++a) {
        origin[a] = centre[a] - h * std::ceil((centre[a] - box.min[a] + kMarginBlocks * block) / h);
        grid.lattice.blocks[a] =
            static_cast<int>(std::ceil((box.max[a] - origin[a]) / block)) + kMarginBlocks;
    }
    grid.frame.origin = grid.frame.rotation * origin;
    Eigen::Affine3d local_to_lps = Eigen::Affine3d::Identity();
    local_to_lps.linear() = grid.frame.rotation;
    local_to_lps.translation() = grid.frame.origin;
    grid.lattice.local_to_index = volume.index_to_lps.inverse() * local_to_lps;
    return grid;
}

}  // namespace myotet::levelset
