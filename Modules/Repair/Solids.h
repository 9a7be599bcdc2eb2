// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/Csg.h"
#include "Repair/Recipe.h"

namespace myotet::repair {

/// From a solid's coordinates to the lattice's: rotation * x + origin.
using Pose = Frame;

/// Coordinates along a tissue's principal axes, as Solid says, for a band in
/// the coordinates of `frame`. The pose leads to those.
[[nodiscard]] Pose principal_pose(const levelset::Band& tissue, const Frame& frame);

/// The pose of coordinates that are the patient's.
[[nodiscard]] Pose patient_pose(const Frame& frame);

/// A solid in lattice coordinates: its signed distance and a box around it. A
/// half-space has no box of its own and takes `domain`.
struct PlacedSolid {
    levelset::Distance distance;
    Box box;
};
[[nodiscard]] PlacedSolid place(const Solid& solid, const Pose& pose, const Box& domain);

}  // namespace myotet::repair
