// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Forces.h"

namespace myotet::membrane {

/// Brings a motion from one set of triangles in use to another. Nodes that come
/// are put where the butterfly scheme puts them from the nodes about them as they
/// are now, with the mean velocity of their edge's ends; nodes that now hang stay
/// where they are. Forces follow from these.
void switch_to(const Levels& levels, const Active& before, Active& after, Motion& motion);

}  // namespace myotet::membrane
