// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "Cage/Bombs.h"
#include "Cage/Enclosure.h"
#include "Cage/Parts.h"
#include "Cage/StarShape.h"
#include "Core/Progress.h"

namespace myotet::cage {

/// What kind of cage.
struct Options {
    double cell = 0;           ///< mm, of the lattice; 0: chosen for `tets`
    std::int64_t tets = 1000;  ///< about as many tetrahedra, where `cell` is 0
    /// Boundary nodes end within this part of a cell of the surface. Smaller: closer to the
    /// surface and worse shapes.
    double offset_ratio = 0.4;
    /// Smallest dihedral angle to be content with, degrees. What is left goes into a closer
    /// fit: where shapes are better than that, they are given up for less volume. Those of the
    /// lattice have 60, and little gets better than that.
    double angle_deg = 30;
    double max_angle_deg = 0;     ///< largest dihedral angle; 0: 180 less 1/0.7 of angle_deg
    double max_aspect_ratio = 0;  ///< longest edge by shortest altitude; 0: 105 over angle_deg
    int tries = 1;                ///< lattices: the first as it is, others turned and shifted
    std::uint64_t seed = 1;       ///< of turns and shifts
    /// Of the surface's triangles with each other. They change nothing about enclosure, but are
    /// most often a mistake; what level sets make has some in creases thinner than a sample.
    Crossings crossings = Crossings::refused;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
    /// By which all three limits score angle_deg.
    [[nodiscard]] Scale scale() const;
};

/// What one lattice came to.
struct Try {
    int number = 0;
    std::int64_t tets = 0;
    BombSummary bombs;
    std::int64_t split_nodes = 0;               ///< added where parts only touched
    int adjust_steps = 0;                       ///< of variational adjustment
    int jumps = 0, collapsed = 0, refined = 0;  ///< of nodes that stuck (Reach.h)
    int relax_rounds = 0;
    bool reached = false;   ///< all boundary nodes are within the offset
    bool enclosed = false;  ///< proved (Enclosure.h)
    double score_deg = 0;   ///< of the worst tetrahedron (StarShape.h)
    double volume = 0;      ///< mm^3
};

/// How good the cage is.
struct Measures {
    std::int64_t tets = 0, nodes = 0, boundary_faces = 0;
    double min_dihedral_deg = 0, max_dihedral_deg = 0;
    double max_aspect_ratio = 0, mean_aspect_ratio = 0;
    double distance_min = 0, distance_max = 0, distance_mean = 0;  ///< of boundary nodes, mm
    double volume_ratio = 0;                ///< the cage's volume over the surface's
    std::int64_t euler_characteristic = 0;  ///< of the boundary
    bool boundary_manifold = false;
    int components = 0;
};

/// A cage and how it came about.
struct Cage {
    TetMesh mesh;
    double cell = 0;         ///< mm
    double offset = 0;       ///< mm
    int best = 0;            ///< which of the tries was taken
    std::vector<Try> tries;  ///< those that were finished, in their order
    int tries_asked = 0;
    Measures measures;
    Enclosure enclosure;
    [[nodiscard]] bool reached() const { return tries[static_cast<std::size_t>(best)].reached; }
};

/// A coarse mesh of good tetrahedra that encloses a closed surface and stays close to it
/// [Stuart13]: a body-centred cubic lattice, sculpted, bombs defused, its nodes adjusted, those
/// that stick brought to the surface and the worst shapes relaxed, within exact walls all the
/// way, and enclosure proved at the end. Of several tries, which differ in how the lattice lies,
/// that one is taken that is enclosed and within the offset and whose worst tetrahedron has the
/// best score; of those whose angles are enough, the one of least volume; of equals the first.
/// Stops at an interruption with the best so far, and throws Interrupted when none is finished.
/// Tries run on all threads; the result does not depend on their number.
/// Throws InputError for options out of range, a surface that is not closed or meets itself,
/// and a cell larger than the surface; ResourceError when the lattice has too many cells.
/// Cost: about a processor second a thousand tetrahedra and try.
[[nodiscard]] Cage make_cage(const TriMesh& surface, const Options& options,
                             ProgressSink& progress);

/// A mesh measured beside its surface.
[[nodiscard]] Measures measure(const TetMesh& mesh, const TriMesh& surface,
                               const SurfaceTree& tree);

}  // namespace myotet::cage
