// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Play/Touch.h"
#include "Play/World.h"

namespace myotet::play {

/// A time step as contact sees it: where nodes are, and where they would be at its end if
/// nothing touched.
struct Course {
    const dynamics::NodeVectors& x;
    const dynamics::NodeVectors& ahead;
    double time = 0, step = 0;  ///< s
};

/// What may touch within a step. `deepest` is how deep, at its beginning, a sample of one
/// thing's surface is in another, mm; 0: none is.
struct Touches {
    std::vector<Touch> all;
    double deepest = 0;
};

/// Samples of bodies, and balls, against obstacles, balls and other bodies. Each pair gets the
/// plane of the nearest point of the other's surface where the step begins, or, against a
/// sphere, where they first meet on their straight ways, so that a fast one does not pass
/// through. Farther than their ways and the gap reach, there is none. Bodies do not touch
/// themselves. Proxies follow x. Cost: about a microsecond for each sample that is near
/// another body; the same on any number of threads.
[[nodiscard]] Touches find_touches(World& world, const Course& course);

}  // namespace myotet::play
