// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/Band.h"

#include <span>

namespace myotet::levelset {

/// Undoes what a flow did on the large: the interface's displacement since
/// `before` (values of the same blocks) is averaged over about `radius` mm
/// along the interface and taken back. What stays is the removal of detail
/// below that size; a sphere, a cylinder or a plane larger than it is left as
/// it was, and volume is kept where it was lost rather than anywhere.
/// Cost: O(stored samples).
void give_back(Band& band, std::span<const float> before, double radius);

}  // namespace myotet::levelset
