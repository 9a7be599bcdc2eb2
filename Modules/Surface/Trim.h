// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Surface/Remesh.h"

namespace myotet::surface {

/// What a trimming level set does to a surface.
enum class Cut {
    none,        ///< the surface lies outside of it: all is kept
    some,        ///< they meet
    everything,  ///< no triangle is kept
};

/// Discards what lies inside `trim` by the rules of [Teran05, sec. 6] in two
/// dimensions. A point is enveloped when it is outside, and on each of its
/// edges that crosses trim = 0 the crossing is at least a quarter of the way
/// out; kept are the triangles around enveloped points. More points are taken
/// as enveloped until the boundary of what is kept is a manifold and no inner
/// edge joins two of its points. Points do not move.
Cut select_outside(Fans& fans, const Guide& guide);

/// Removes all connected pieces but the `count` largest by area; 0 keeps all.
void keep_largest_pieces(Fans& fans, int count);

/// Drives the rim onto trim = 0 [Teran05, sec. 11]: every edge is a spring of
/// its wished length, each step moves every point along the surface to the
/// mean of where its springs want it, the points of the rim also towards
/// trim = 0 by at most a fifth of an edge, and puts it back on phi = 0. Ends when
/// the rim is on trim = 0, or after a fixed number of steps; then the rim is
/// placed on both.
void drive_rim(Fans& fans, const Guide& guide);

/// Points of the rim that are not yet on both surfaces are placed there from
/// where they are, else from between their neighbours.
void land_rim(Fans& fans, const Guide& guide);

}  // namespace myotet::surface
