// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "Surface/Measure.h"
#include "Surface/Trim.h"

namespace myotet::surface {

/// How a level set's surface is triangulated.
struct Options {
    double edge_length = 0;           ///< where the surface is flat enough, mm; must be positive
    double smallest_edge_length = 0;  ///< how fine curved parts may get, mm; 0: edge_length / 4
    /// Edges are at most this part of the smallest radius of curvature.
    double curvature_factor = 1;
    int pieces = 0;  ///< how many of the largest to keep after trimming; 0: all
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

struct Result {
    TriMesh mesh;  ///< empty when all was discarded
    Cut cut = Cut::none;
    Quality quality;
};

/// A well-shaped triangle mesh of phi = 0, trimmed where `guide.trim` is given
/// [Teran05, sec. 11]: what lies inside it is discarded, and the new boundary
/// lies on both surfaces. `start` is any closed manifold near phi = 0, outward:
/// the boundary of a tetrahedral mesh or an extracted zero set; the result has
/// its topology. The same bytes on any number of threads.
/// Throws InputError (options; a start that is empty or not a closed
/// manifold), Interrupted.
[[nodiscard]] Result make_surface(const TriMesh& start, const Guide& guide, const Options& options,
                                  ProgressSink& progress);

}  // namespace myotet::surface
