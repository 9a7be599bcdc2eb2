// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "Core/Geometry.h"

namespace myotet::fibres {

/// A mean of lines: sum of w v v^T over unit vectors v, which their signs do not change.
struct DyadSum {
    Mat3 dyads = Mat3::Zero();
    Vec3 vectors = Vec3::Zero();  ///< sum of w v, for the sense only

    void add(const Vec3& v, double weight) {
        dyads += weight * v * v.transpose();
        vectors += weight * v;
    }
    /// Eigenvector of the largest eigenvalue, of length 1, to the side of the sum of the
    /// vectors; none where the two largest are equal.
    [[nodiscard]] std::optional<Vec3> principal() const;
};

}  // namespace myotet::fibres
