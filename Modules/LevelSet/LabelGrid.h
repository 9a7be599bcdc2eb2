// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "LevelSet/FromLabels.h"
#include "LevelSet/Partition.h"
#include "LevelSet/VoxelBand.h"

namespace myotet::levelset {

/// Where and how finely a volume's regions are sampled.
struct LabelGrid {
    Frame frame;
    SharedLattice lattice;
    double smooth = 0;          ///< mm
    double forecast_bytes = 0;  ///< peak of the whole work
};

/// Lays an isotropic lattice along the scan's axes: the rotation nearest to
/// the voxels' directions, one axis turned round where they are left-handed,
/// the origin beyond the volume's lowest corner so that coordinates inside are
/// positive, and a sample on a voxel's centre.
/// Throws ResourceError when the forecast exceeds options.max_memory.
[[nodiscard]] LabelGrid lay_grid(const LabelVolume& volume, std::span<const SharedWall> walls,
                                 const LabelOptions& options);

/// Distance between the voxel planes across each index axis, mm.
[[nodiscard]] Vec3 plane_spacing(const LabelVolume& volume);

/// Area of a voxel's face across each index axis, mm^2.
[[nodiscard]] Vec3 face_area(const LabelVolume& volume);

}  // namespace myotet::levelset
