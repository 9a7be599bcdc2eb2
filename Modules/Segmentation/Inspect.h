// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

/// A 6-connected piece of a label.
struct Piece {
    std::int64_t voxels = 0;
    double inscribed_radius = 0;  ///< largest, mm
    Vec3 centre = Vec3::Zero();   ///< of its index box, LPS, mm
};

/// Voids: 6-connected sets of voxels of other values that a label encloses, so
/// that no way across voxel faces leads out of them but through the label.
struct Cavities {
    std::int64_t count = 0, voxels = 0;
    std::int64_t unlabelled_count = 0;  ///< those that hold background alone
    std::int64_t unlabelled_voxels = 0;
};

/// Where a label touches another one, or the background (value 0).
struct Contact {
    std::int32_t value = 0;
    std::int64_t faces = 0;  ///< voxel faces shared
    double area = 0;         ///< mm^2
};

/// All that a label volume says about one label.
struct LabelInspection {
    std::int32_t value = 0;
    std::int64_t voxels = 0;
    double volume = 0;          ///< mm^3
    std::vector<Piece> pieces;  ///< largest first; equal ones by their first voxel
    Cavities cavities;
    double median_radius = 0;           ///< of the balls inscribed along its middle, mm
    double smallest_radius = 0;         ///< the same, mm
    std::int64_t one_voxel_thick = 0;   ///< voxels with another value on both sides along an axis
    std::vector<Contact> contacts;      ///< by value
    std::array<std::int64_t, 6> cut{};  ///< voxels in the volume's first and last layer of i, j, k
};

/// A label volume as it is, before any work.
struct Inspection {
    std::vector<LabelInspection> labels;  ///< by value; 0 is no label
    /// 6-connected pockets of background that do not reach the volume's border.
    std::int64_t pockets = 0, pocket_voxels = 0;
};

/// Counts, measures and asks every label what it touches. A contact's area is
/// 2/3 of its voxel faces' area: a plane of unit normal n and area A shows
/// faces of A (|n1| + |n2| + |n3|), 3/2 A in the mean over all directions
/// (Cauchy's projection formula); a wall along the voxels comes out a third too
/// small, one along their diagonal 15 % too large. Radii: InspectThickness.h.
/// The same numbers for any thread count. Throws ResourceError.
/// Cost: a few passes over the voxels, 4 bytes a voxel besides the volume.
[[nodiscard]] Inspection inspect(const LabelVolume& volume);

/// Voxels that two labels of different layers both claim.
struct Overlap {
    std::size_t layer_a = 0, layer_b = 0;  ///< a < b
    std::int32_t value_a = 0, value_b = 0;
    std::int64_t voxels = 0;
};

/// By layers, then by values. Cost: one pass.
[[nodiscard]] std::vector<Overlap> find_overlaps(std::span<const LabelVolume> layers);

}  // namespace myotet::segmentation
