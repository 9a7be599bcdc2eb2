// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/Band.h"

namespace myotet::levelset {

/// Volume enclosed by phi = 0, mm^3, cell by cell. Errs by O(spacing^2).
[[nodiscard]] double enclosed_volume(const Band& band);

/// Volume of what lies in `a` and not in `b`, mm^3: zero, exactly, where they
/// share their wall's samples.
[[nodiscard]] double volume_beyond(const Band& a, const Band& b);

/// Centroid and principal axes of a solid of constant density.
struct PrincipalAxes {
    Vec3 centroid = Vec3::Zero();  ///< mm
    /// Columns: unit vectors of the longest, the middle and the shortest axis,
    /// right-handed; their signs mean nothing.
    Mat3 axes = Mat3::Identity();
    Vec3 deviation = Vec3::Zero();  ///< standard deviation along each, mm
};
/// From the volume and its first and second moments, samples at the surface
/// counted in part. The solid must not be empty.
[[nodiscard]] PrincipalAxes principal_axes(const Band& band);

/// Where two solids touch.
struct Contact {
    double area = 0;             ///< mm^2
    Vec3 centre = Vec3::Zero();  ///< mean over the area, mm
};
/// Neighbouring samples along an axis, one in `a` alone and the other in `b`
/// alone, stand for a face times |n_axis|, n being the wall's normal: where it
/// is flat these sum to its area, since a wall of area A crosses A |n_axis| /
/// spacing^2 of the lattice's edges along that axis.
[[nodiscard]] Contact contact(const Band& a, const Band& b);

}  // namespace myotet::levelset
