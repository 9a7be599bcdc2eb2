// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// A ball in the level set's own coordinates.
struct Spot {
    Vec3 centre = Vec3::Zero();  ///< mm
    double radius = 0;           ///< mm
};

struct Softening {
    int steps = 2;
    bool keeps_volume = true;  ///< of what each ball encloses
};

/// Smooths phi within balls and nowhere else, by steps of
///
///     phi <- phi + w (mean of the six samples beside it - phi) / 2,
///
/// w being 1 in a ball's inner half and falling to 0, with its slope, at its
/// surface; then, to keep volume, phi is lowered or raised by a multiple of w until
/// the ball encloses what it did. Planes stay where they are. What is thinner than
/// about a spacing does not stay: necks part or fill, slits close or open, and what is
/// left is wide enough for its samples to show its shape. In cells that meet a ball the
/// samples alone hold from then on, not pieces (see Seams).
/// Balls are taken in their order. Cost: `steps` times the samples in them.
void soften(LevelSet& phi, std::span<const Spot> spots, const Softening& how = {});

}  // namespace myotet::levelset
