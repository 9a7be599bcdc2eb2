// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Surface/Field.h"
#include "Surface/Guard.h"

namespace myotet::surface {

/// Whether a triangle faces against the gradient of phi at all three corners and
/// at its centre.
[[nodiscard]] bool turned_over(const Fans& fans, const Field& phi, const Triangle& t);

/// Looks for a way out where a triangle is turned over, as at necks smaller than
/// the level set's samples: flips, collapses and splits of the edges about it,
/// each followed by moves of the points that it touches, and of all these the
/// one that leaves the fewest turned over or nearly so, makes none cross and keeps
/// the smallest angle largest. Ends when none is left or none of these helps.
/// Cost: O(|F|) for a place, a few hundred times; nothing where none is turned over.
void turn_back(Fans& fans, const Guide& guide, CrossingGuard& guard);

}  // namespace myotet::surface
