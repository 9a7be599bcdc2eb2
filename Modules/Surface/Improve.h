// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Surface/Guard.h"
#include "Surface/Remesh.h"

namespace myotet::surface {

/// When angles are good enough.
struct AngleGoal {
    double smallest_deg = 33;  ///< triangles with all angles above are left alone
    int rounds = 12;           ///< at most
};

/// Moves a point by pattern search to where the smallest angle about it is
/// largest and the least is wrong; whether it moved.
bool improve_point(Fans& fans, const Guide& guide, std::int32_t v);

/// Makes the smallest angles larger, on the level sets: flips edges where that
/// helps the worse of two triangles, moves points by pattern search for the
/// largest smallest angle around them [Teran05, sec. 8, in two dimensions], and
/// where this does not suffice takes points away or adds some. Stops when the
/// goal is met or a round changes nothing. Three angles of at least a leave
/// none above 180 - 2 a, so one goal serves both ends.
void improve_angles(Fans& fans, const Guide& guide, CrossingGuard& guard,
                    const AngleGoal& goal = {});

}  // namespace myotet::surface
