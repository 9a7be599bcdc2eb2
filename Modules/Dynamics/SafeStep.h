// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"

namespace myotet::dynamics {

/// The first s in (0, 1] at which det(F + s `by`) is zero, det F being positive; 1 when there
/// is none. F may be a deformation gradient, or the edges of a tetrahedron. The determinant
/// is a cubic in s; between its two stationary points it is monotone, and there its root is
/// bracketed.
[[nodiscard]] double first_flat(const Mat3& F, const Mat3& by);

}  // namespace myotet::dynamics
