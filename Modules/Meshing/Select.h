// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "Lattice/RedGreenLattice.h"

namespace myotet::meshing {

/// Which tetrahedra of the lattice are chosen. Only the first keeps the promises;
/// the others show what the passes are worth.
enum class Topology {
    repaired,   ///< at enveloped nodes, then repaired [Teran05, sec. 6]
    enveloped,  ///< at enveloped nodes, as they are
    inside,     ///< those whose mean phi is negative, as they are
};

/// How the candidate is chosen.
struct SelectOptions {
    Topology topology = Topology::repaired;
    /// Connected components that the candidate shall have; pieces beyond that
    /// are joined along the deepest way between them.
    int components = 1;
    /// Passes that split tetrahedra at trouble spots before nodes are added.
    int refinement_passes = 1;
    /// Also envelop boundary nodes with only three boundary faces, whose surface
    /// angles would be 120 degrees and more.
    bool avoid_three_faces = true;
};

/// A subset of the lattice that is ready for compression.
struct Candidate {
    TetMesh mesh;                      ///< labels empty
    std::vector<lattice::RedTet> red;  ///< |T|: the lattice's tetrahedron that each comes from
    int passes = 0;                    ///< times the connections were examined
    std::size_t nodes_added = 0;       ///< enveloped for the sake of topology
    std::size_t bridges = 0;           ///< pieces that had to be joined
};

/// Selects all tetrahedra at enveloped nodes (phi < 0 and every crossing edge
/// at least 25 % inside), then repairs the selection until its boundary is a
/// manifold, no tetrahedron has four boundary nodes and no interior edge joins
/// two boundary nodes [Teran05, sec. 6]. May refine the lattice. Without repair none
/// of this is promised, and there may be more components.
/// Throws MeshError when the selection reaches the lattice's end.
[[nodiscard]] Candidate select_candidate(lattice::RedGreenLattice& lattice,
                                         const SelectOptions& options, ProgressSink& progress);

}  // namespace myotet::meshing
