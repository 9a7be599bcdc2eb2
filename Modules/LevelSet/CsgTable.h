// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/Band.h"

namespace myotet::levelset {

/// Where b's first block lies in a's blocks. Throws LogicError when they are
/// not on one lattice.
[[nodiscard]] Index3 block_offset(const Band& a, const Band& b);

/// The same samples with a table just large enough for the blocks that differ
/// from what lies beyond, and `margin` blocks around them.
[[nodiscard]] Band framed(const Band& band, int margin);

/// Only the blocks that reach into `box`; what lies beyond counts as outside.
[[nodiscard]] Band cropped(const Band& band, const Box& box);

}  // namespace myotet::levelset
