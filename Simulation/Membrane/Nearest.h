// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "Core/Geometry.h"

namespace myotet::membrane {

/// The point of a triangle that is nearest to another, and its barycentric coordinates.
struct Nearest {
    Vec3 point;
    std::array<double, 3> weights;
};
[[nodiscard]] Nearest nearest_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& to);

}  // namespace myotet::membrane
