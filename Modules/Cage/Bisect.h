// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cage/Walls.h"

namespace myotet::cage {

/// Bisects the boundary edges at a node, the longest first, each with all tetrahedra around it,
/// where the halves enclose what they did before. Returns how many were bisected; star, fan and
/// faces are then made anew.
[[nodiscard]] int bisect_around(Walls& walls, std::int32_t node);

}  // namespace myotet::cage
