// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/Geometry.h"

namespace myotet::dynamics {

/// Positions (mm), velocities (mm/s) or forces (N) of all nodes.
using NodeVectors = std::vector<Vec3>;

/// Forces of a system of nodes: elastic ones depend on the positions, damping
/// ones linearly on the velocities, symmetric and negative semi-definite.
class ForceField {
public:
    virtual ~ForceField() = default;
    /// Takes the positions that the others refer to and keeps what depends on them alone.
    virtual void move_to(const NodeVectors& x) = 0;
    virtual void add_elastic(NodeVectors& forces) const = 0;
    virtual void add_damping(const NodeVectors& v, NodeVectors& forces) const = 0;
};

}  // namespace myotet::dynamics
