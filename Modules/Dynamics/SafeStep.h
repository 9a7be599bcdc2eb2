// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Elasticity/LinearTet.h"

namespace myotet::dynamics {

/// The first s in (0, 1] at which a positive tetrahedron whose corners move from x to
/// x + s `by` is flat; 1 when there is none. The volume is a cubic in s; between its
/// two stationary points it is monotone, and there its root is bracketed.
[[nodiscard]] double first_flat(const elasticity::Corners& x, const elasticity::Corners& by);

}  // namespace myotet::dynamics
