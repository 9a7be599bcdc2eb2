// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/LabelGrid.h"

#include "Core/Errors.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myotet::levelset {
namespace {

// Blocks beyond the volume on every side: band, coarse cells and smoothing.
constexpr int kMarginBlocks = 3;

Mat3 nearest_rotation(const Mat3& directions) {
    const Eigen::JacobiSVD<Mat3> svd(directions, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 rotation = svd.matrixU() * svd.matrixV().transpose();
    if (rotation.determinant() < 0) rotation.col(2) = -rotation.col(2);
    return rotation;
}

// Bytes at the peak for a wall area summed over all regions and sides.
double forecast(double area, double voxels, double spacing) {
    // Measured on a knee of 49 tissues: a band stores 2.2 blocks for each block
    // face of voxel wall; 512 * 5 bytes are held for each while regions wait, 729 * 4 once
    // they are finished, both at the worst; 5 bytes a voxel for the map.
    constexpr double kBlocksPerFace = 2.2, kBytesPerBlock = 512 * 5 + 729 * 4;
    const double side = LevelSet::kBrickCells * spacing;
    return kBlocksPerFace * kBytesPerBlock * (area / (side * side)) + 5 * voxels;
}

double choose_spacing(double area, double voxels, const Vec3& side, double max_memory) {
    constexpr double kModestBytes = 6e8;
    const double finest = side.minCoeff(), widest = std::cbrt(side.prod());
    const double budget = std::max(std::min(kModestBytes, max_memory) - 5 * voxels, 1e8);
    const double affordable = std::sqrt((forecast(area, 0, 1.0)) / budget);
    return std::clamp(affordable, finest, widest);
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
    const double h = options.spacing > 0
                         ? options.spacing
                         : choose_spacing(area, voxels, side, options.max_memory);
    grid.lattice.spacing = h;
    grid.smooth = options.smooth < 0 ? 0.5 * side.maxCoeff() : options.smooth;
    grid.forecast_bytes = forecast(area, voxels, h);
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
        origin[a] = centre[a] -
                    h * std::ceil((centre[a] - box.min[a] + kMarginBlocks * block) / h);
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
