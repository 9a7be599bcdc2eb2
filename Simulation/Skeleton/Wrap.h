// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"
#include "Skeleton/Geodesic.h"
#include "Skeleton/Model.h"
#include "Skeleton/WrapSurface.h"

namespace myotet::skeleton {

/// Where a taut path lies on an object, in its frame: it comes straight to `first`, follows
/// a geodesic to `last` and goes straight on.
struct WrapContact {
    GeodesicPoint first, last;
    double curve = 0;  ///< length of the geodesic, mm
};

/// What the pose before tells of a path and an object.
struct WrapMemory {
    bool touching = false;
    /// Unit direction in which the path passed the object's middle; zero: not known.
    Vec3 side = Vec3::Zero();
    WrapContact contact;                          ///< while touching
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< the ends of that path
};

enum class WrapTouch {
    clear,     ///< the straight piece is the path
    touching,  ///< it runs over the object
    inside,    ///< an end lies inside the object, which is left out
};

/// The path between two points over an object.
struct Wrap {
    WrapTouch touch = WrapTouch::clear;
    bool pierced = false;  ///< the straight piece would run through the object
    WrapContact contact;   ///< while touching
    Vec3 side = Vec3::Zero();
};

/// The path from one point to another over an object, all in its frame.
///
/// Where it has a choice of sides: a path that touched in the pose before stays on its side,
/// by less than a whole turn, until it lifts off. Else
/// - sphere and ellipsoid: it touches when the straight piece runs through the object, on the
///   shorter side; with a quadrant and an end outside of it, on the side whose middle lies in
///   the quadrant.
/// - cylinder: without a quadrant as these. With one, it never passes between the axis and
///   infinity on the other side, so that it is also held where the straight piece would pass
///   clear on the wrong side. It comes into contact within the length of the cylinder: not
///   while both of its contact points lie beyond the ends. When it touches it stays as on
///   an endless one.
/// - torus: it passes through the hole when its ends lie on both sides of the ring's plane,
///   else, and when it was clear of the ring in the pose before, by the shorter way.
/// A path without a quadrant that is dragged so far across a sphere or ellipsoid that it is
/// no longer the shortest among its neighbours slips off to the shortest.
///
/// Of OpenSim's rules these are kept: no wrapping when an end lies inside, which touch, on
/// which side, the length of a cylinder, through the hole of a torus. Not kept: planes
/// through an ellipsoid instead of geodesics, 1 degree of error at a cylinder's tangents, a
/// full loop around a cylinder for a path with both ends outside its quadrant whose straight
/// piece passes clear, and the path's forgetting its side.
///
/// Cost: sphere, cylinder 0.2 us; ellipsoid 5 us, torus 10 us when it touched in the pose
/// before, ten times that when it did not.
[[nodiscard]] Wrap find_wrap(const WrapObject& object, const WrapSurface& surface, const Vec3& from,
                             const Vec3& to, const WrapMemory& before);

/// Length of the path over the object, mm.
[[nodiscard]] double wrapped_length(const WrapContact& contact, const Vec3& from, const Vec3& to);

}  // namespace myotet::skeleton
