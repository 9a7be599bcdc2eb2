// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "Elasticity/LinearTet.h"
#include "Elasticity/Points.h"

namespace myotet::elasticity {

// Lumped masses, t, one a node, of tetrahedra whose densities, t/mm^3, may differ. Throw
// InputError unless there is one positive density a tetrahedron. Cost: O(|T|).

/// A quarter of each tetrahedron's mass at its corners; for linear_points and patch_points.
[[nodiscard]] std::vector<double> nodal_masses(const TetMesh& rest,
                                               std::span<const double> density);

/// For quadratic_points. Equal rows of the consistent mass matrix would give corners a
/// negative mass; shares in proportion to its diagonal [Hinton, Rock and Zienkiewicz 1976]
/// are all positive: 1/36 of a tetrahedron's mass at each corner and 4/27 at each middle,
/// as exact for straight edges.
[[nodiscard]] std::vector<double> nodal_masses(const QuadraticMesh& rest,
                                               std::span<const double> density);

}  // namespace myotet::elasticity
