// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Contraction/Motion.h"

namespace myotet::play {

enum class Form { plane, box, sphere };

/// A rigid thing that goes where it is told, or nowhere.
struct Obstacle {
    std::string name;
    Form form = Form::plane;
    Vec3 point = Vec3::Zero();    ///< of a plane; a sphere's centre; mm, at rest
    Vec3 normal = Vec3::UnitZ();  ///< of a plane, out of what is solid, unit
    Box box;                      ///< at rest
    double radius = 0;            ///< of a sphere, mm
    contraction::Motion motion;   ///< from where it is at rest
};

/// Distance from an obstacle at rest, negative inside, and the direction away from it.
struct Apart {
    double distance = 0;  ///< mm
    Vec3 away = Vec3::UnitZ();
};
/// Exact; inside a box, by the nearest of its faces.
[[nodiscard]] Apart apart(const Obstacle& obstacle, const Vec3& p);

/// A rigid ball that flies by itself: one node, which does not turn.
struct Ball {
    std::string name;
    std::int32_t node = 0;
    double radius = 0;  ///< mm
};

/// The first part s in [0, 1] of a straight way from `from` to `from + by`, seen from a
/// sphere's centre, at which the distance to that is `radius`; 0 when it is less at once; -1
/// when it never is.
[[nodiscard]] double first_reach(const Vec3& from, const Vec3& by, double radius);

}  // namespace myotet::play
