// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Cage/Relax.h"

namespace myotet::cage {

/// Draws the boundary in: makes a cage's volume less at the cost of shapes, down to the goal
/// of the options (to the worst there is where that is less), below which none gets.
///
/// A penalty method turned round: nodes go down the slope of the badness of shapes and of the
/// cage's volume, which weighs more from era to era, while a floor holds what is worst. Little
/// weight first lets nodes inside make room for those that follow. `interrupted` ends it early.
/// Returns the number of rounds.
[[nodiscard]] int draw_in(Walls& walls, RelaxOptions options,
                          const std::function<bool()>& interrupted);

}  // namespace myotet::cage
