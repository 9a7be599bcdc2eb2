// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Dynamics/BlockMatrix.h"

namespace myotet::dynamics {

/// An energy of nodes, a function of their positions alone, with its derivatives: a
/// body's, a spring's, a load's. Several of them add up. What it depends on besides,
/// such as activation, its owner changes between two calls of move_to.
class Potential {
public:
    virtual ~Potential() = default;
    /// Takes the positions that the others refer to and returns the energy there, mJ;
    /// infinite where the nodes must not be.
    [[nodiscard]] virtual double move_to(const NodeVectors& x) = 0;
    /// Adds minus the gradient, N.
    virtual void add_forces(NodeVectors& forces) const = 0;
    /// Which nodes' forces depend on which nodes' positions.
    [[nodiscard]] virtual Cliques cliques() const = 0;
    /// Adds the second derivative, N/mm, to a matrix whose pattern holds the cliques.
    virtual void add_stiffness(BlockMatrix& K) const = 0;
    /// The greatest s of at most 1 such that the energy stays finite on the way from x
    /// to x + s `by`.
    [[nodiscard]] virtual double largest_step(const NodeVectors& x,
                                              const NodeVectors& by) const = 0;
};

}  // namespace myotet::dynamics
