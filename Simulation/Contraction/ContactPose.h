// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"

namespace myotet::contraction {

/// Where a bone is: a point that was at X at rest is at rotation * X + translation.
struct BonePose {
    Mat3 rotation = Mat3::Identity();  ///< orthonormal, right-handed
    Vec3 translation = Vec3::Zero();   ///< mm

    [[nodiscard]] Vec3 to_rest(const Vec3& x) const {
        return rotation.transpose() * (x - translation);
    }
};

}  // namespace myotet::contraction
