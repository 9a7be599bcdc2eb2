// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <utility>

#include "Core/Geometry.h"

namespace myotet::surface {

/// Two unit vectors that with the unit vector `n` are a right-handed frame
/// (u, v, n).
[[nodiscard]] inline std::pair<Vec3, Vec3> tangents(const Vec3& n) {
    int axis = 0;
    n.cwiseAbs().minCoeff(&axis);
    const Vec3 u = n.cross(Vec3::Unit(axis)).normalized();
    return {u, n.cross(u)};
}

}  // namespace myotet::surface
