// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/Geometry.h"
#include "Skeleton/Model.h"
#include "Skeleton/Skeleton.h"
#include "Skeleton/Wrap.h"

namespace myotet::skeleton {

/// A point of a path and the body it is fixed to.
struct PathNode {
    Vec3 at = Vec3::Zero();  ///< in ground, mm
    int body = 0;
    int point = -1;  ///< of the muscle; -1: where the path meets or leaves a wrap object
    /// It begins a piece of a curve around this wrap object that ends at the next node; -1: the
    /// next piece is straight.
    int around = -1;
    double curve = 0;           ///< length of that piece, mm
    Vec3 along = Vec3::Zero();  ///< unit direction there, in ground, where point is -1
};

/// Where a muscle runs.
struct Path {
    double length = 0;            ///< mm
    std::vector<PathNode> nodes;  ///< from origin to insertion
    /// Wrap objects that are left out because a neighbouring point of the path lies inside:
    /// the path may run through them.
    std::vector<int> inside;
    /// Wrap objects that the path runs through, or over which it is not taut, because no taut
    /// path was found: a ring that a string would have to touch at more than two places, or
    /// several objects whose contacts do not come to rest together.
    std::vector<int> missed;
};

/// What a path remembers from the pose before, so that it does not jump to the other side
/// of an object: give the same one for a motion's poses in turn, a new one to begin.
struct PathMemory {
    /// Where it touched, from origin to insertion.
    struct Contact {
        int wrap = 0;            ///< of the muscle
        int begin = 0, end = 0;  ///< points of the muscle between which it lies
        WrapMemory memory;
    };
    std::vector<Contact> contacts;
    /// On which side it passed clear of a wrap object that holds it on one.
    struct Pass {
        int wrap = 0;
        int begin = 0, end = 0;
        Vec3 side = Vec3::Zero();
    };
    std::vector<Pass> passes;
};

/// The shortest path of a muscle over its wrap objects: `bodies` their places in ground,
/// `values` those of the coordinates.
///
/// A wrap acts on one of the straight pieces in its range: the first that runs through its
/// object, else that which it lengthens least; find_wrap says how. Over several objects
/// each is wrapped between its neighbours' contact points until none of these moves by
/// more than 1e-12 of the path, so that the whole path is taut. Objects that are not active
/// do not act. A torus may be touched at two places.
/// A curve over one object is not checked against another that overlaps it.
/// Cost: 0.5 us over a cylinder or a sphere, 5 us over an ellipsoid, 10 us over a torus, 10 us
/// over two objects, when they touched in the pose before.
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

/// Points along the path for pictures, in ground: its nodes, and on curves points no more
/// than `step` mm apart.
[[nodiscard]] std::vector<Vec3> drawn(const Model& model, const Path& path,
                                      std::span<const Pose> bodies, double step);

}  // namespace myotet::skeleton
