// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Surface/Change.h"
#include "Surface/Guard.h"

namespace myotet::surface {

/// How long edges shall be.
struct Sizing {
    double edge_length = 0;      ///< where the surface is flat enough, mm
    double smallest_length = 0;  ///< nowhere shorter, mm
    /// No longer than this part of the smallest radius of curvature: a chord of
    /// length L leaves an arc of radius R by L^2 / (8 R).
    double curvature_factor = 1;
};

/// Wished edge lengths at all points: by curvature, and so that a chord leaves
/// its arc by no more than a quarter of the solid's thickness there or of the
/// gap beside it, also to other parts, lest the two sides cross; growing by at most a
/// quarter of the way from one point to the next.
void find_sizes(Fans& fans, const Guide& guide, const Sizing& sizing);

/// Isotropic remeshing towards the wished lengths (Botsch, Kobbelt 2004):
/// splits edges longer than 4/3 of it, collapses edges shorter than 4/5, flips
/// edges so that points have six of them (four on the rim), and moves points
/// along the surface to the middle of their triangles, on the rim along it.
/// Every point is placed on its level sets after each move. The topology does
/// not change.
void remesh(Fans& fans, const Guide& guide, CrossingGuard& guard, const Sizing& sizing, int rounds);

/// One step of moving all points along the surface.
void smooth(Fans& fans, const Guide& guide);

/// One pass of flips that even out the number of edges at the points.
void even_valences(Fans& fans, const Guide& guide);

}  // namespace myotet::surface
