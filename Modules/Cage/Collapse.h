// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cage/Walls.h"

namespace myotet::cage {

/// Takes a boundary node out of the mesh: draws it along one of its boundary edges into that
/// edge's other end, which may move. A node that sits in a hollow too narrow for the faces
/// around it to follow, too far from the surface, so gives way to faces that span the hollow.
/// Done only where the mesh stays a manifold of the same shape (link condition of [Dey,
/// Edelsbrunner, Guha, Nekhayev 1999]), encloses what it enclosed, and all tetrahedra keep a
/// score (StarShape.h) of at least `least`; of the neighbours the one that leaves the best.
/// Returns whether it was done; star, fan and faces are then made anew.
[[nodiscard]] bool collapse(Walls& walls, std::int32_t node, double offset, double least);

}  // namespace myotet::cage
