// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/Geometry.h"

namespace myotet::contraction {

/// Where a bone is at a time: turned about a centre, then shifted.
struct KeyFrame {
    double time = 0;                  ///< s
    Vec3 translation = Vec3::Zero();  ///< of the centre, mm
    Vec3 axis = Vec3::UnitZ();        ///< unit; right-handed turn
    double angle_deg = 0;
    Vec3 centre = Vec3::Zero();  ///< where the bone's joint is at rest, mm
};

/// Key frames by ascending time; none: the bone stays where it is.
struct Motion {
    std::vector<KeyFrame> keys;
};

/// The pose at a key.
[[nodiscard]] Pose pose_of(const KeyFrame& key);

/// The pose at a time, s: exactly a key's at its time, before the first and
/// after the last as there. In between, turned evenly about one axis (slerp,
/// Shoemake 1985) while the later key's centre goes straight: a bone whose keys
/// have one centre and no translation turns about it as a joint does.
[[nodiscard]] Pose pose_at(const Motion& motion, double time);

/// Degrees by which a bone turns between two keys: about one axis, the
/// difference of their angles, which may exceed 180; else the smallest turn.
[[nodiscard]] double turn_between_deg(const KeyFrame& a, const KeyFrame& b);

/// Turns of this many degrees from key to key have no one way to go, deg.
inline constexpr double kMostTurnDeg = 179;

}  // namespace myotet::contraction
