// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/Geometry.h"
#include "Skeleton/Model.h"
#include "Skeleton/Skeleton.h"

namespace myotet::skeleton {

/// A point of a path and the body it is fixed to.
struct PathNode {
    Vec3 at = Vec3::Zero();  ///< in ground, mm
    int body = 0;
    /// It begins a piece of a curve around this wrap object that ends at the next node; -1: the
    /// next piece is straight.
    int around = -1;
    double curve = 0;  ///< length of that piece, mm
};

/// Where a muscle runs.
struct Path {
    double length = 0;            ///< mm
    std::vector<PathNode> nodes;  ///< from origin to insertion
};

/// What a path remembers from the pose before, so that it does not jump to the other side
/// of an object: give the same one for a motion's poses in turn, a new one to begin.
struct PathMemory {
    /// An entry for a wrap of the muscle: direction in the object's frame in which the path
    /// passed, zero while it did not touch.
    std::vector<Vec3> sides;
};

/// The shortest path of a muscle over its wrap objects: `bodies` their places in ground,
/// `values` those of the coordinates.
[[nodiscard]] Path find_path(const Model& model, const Muscle& muscle, std::span<const Pose> bodies,
                             std::span<const double> values, PathMemory& memory);

/// How the path's length changes with each coordinate, mm a rad or a mm: its moment arms
/// with the sign turned, -dL/dq. By virtual work: where a path runs over an object it
/// moves with it, so that only its straight pieces count,
///     dL/dq = sum e . (v_end - v_begin),  e their directions, v velocities of the bodies.
/// A moving point's own way counts too. `rates` as Skeleton::rates tells them.
[[nodiscard]] std::vector<double> length_rates(const Model& model, const Muscle& muscle,
                                               const Path& path, std::span<const Pose> bodies,
                                               std::span<const double> values,
                                               std::span<const std::vector<BodyRate>> rates);

}  // namespace myotet::skeleton
