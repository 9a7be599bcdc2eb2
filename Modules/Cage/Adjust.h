// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cage/Walls.h"

namespace myotet::cage {

struct AdjustOptions {
    double offset = 0;    ///< mm: boundary nodes are to come this near to the surface
    double step = 0.3;    ///< of the way to the mean of circumcentres, an iteration
    int iterations = 60;  ///< at most
};

/// Largest distance of a boundary node from the surface, mm.
[[nodiscard]] double farthest(Walls& walls);

/// Moves each node a step of its way to the volume-weighted mean of the circumcentres of its
/// tetrahedra [Stuart13, eq. 2], one after another, until all boundary nodes are within the
/// offset or none gets nearer. A step that the walls do not allow slides along them or is
/// halved; one that would make a shape worse than `floor` is left out.
/// Returns the number of iterations. Cost: an iteration |V| log |F|.
int adjust(Walls& walls, const AdjustOptions& options);

}  // namespace myotet::cage
