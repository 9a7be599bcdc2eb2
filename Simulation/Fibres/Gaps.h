// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/TetMesh.h"

namespace myotet::fibres {

/// Gives each zero direction the mean line of the neighbours' that have one, neighbours
/// sharing a node; in rounds, until no zero is left. Returns how many it filled. Throws
/// MeshError where a connected part has no direction at all. Cost: O(|T|) a round.
std::size_t fill_gaps(const TetMesh& mesh, std::vector<Vec3>& direction);

}  // namespace myotet::fibres
