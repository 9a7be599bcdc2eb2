// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "Lattice/RedGreenLattice.h"
#include "LevelSet/LevelSet.h"
#include "Meshing/MeshLevelSet.h"

namespace myotet::meshing {

/// Levels of the lattice: edges of level l are coarsest_edge / 2^l.
struct LevelPlan {
    double coarsest_edge = 0;  ///< mm
    double surface_edge = 0;   ///< lattice edge at the surface, mm
    double smallest_edge = 0;  ///< mm; the finest level is not shorter
    int surface_level = 0;
    int max_level = 0;
    /// Tetrahedra with all nodes farther outside than this many edges are dropped.
    /// One edge suffices to enclose the object [Teran05, sec. 6]; the rest leaves
    /// room for nodes that topology adds.
    double outside = 1.8;
};
[[nodiscard]] LevelPlan plan_levels(const Options& options);

/// Local thickness of the part whose surface lies nearest to `point`, mm:
/// twice the depth at which the inward normal meets the medial set, where the
/// opposite wall faces away; at least `longest` when no such wall is met
/// before. Wedges and ridges, whose walls are not opposite, do not count.
[[nodiscard]] double local_thickness(const levelset::LevelSet& phi, const Vec3& point,
                                     double longest);

/// Covers phi's inside with the lattice and refines it where the options ask
/// [Teran05, sec. 5-6]: near the interface down to the surface edge, and
/// further where curvature, thickness or the sizing function want it.
[[nodiscard]] lattice::RedGreenLattice build_lattice(const levelset::LevelSet& phi,
                                                     const Options& options, const LevelPlan& plan,
                                                     ProgressSink& progress);

}  // namespace myotet::meshing
