// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/TetMesh.h"
#include "Dynamics/Potential.h"

namespace myotet::dynamics {

/// Forces on nodes that keep their direction and size wherever the nodes go: weights, dead
/// tractions.
class NodalLoads final : public Potential {
public:
    explicit NodalLoads(std::size_t nodes) : force_(nodes, Vec3::Zero()) {}

    NodeVectors& forces() { return force_; }  ///< N, one a node; may change between solves

    [[nodiscard]] double move_to(const NodeVectors& x) override;
    void add_forces(NodeVectors& forces) const override;
    [[nodiscard]] Cliques cliques() const override { return {}; }
    void add_stiffness(BlockMatrix&) const override {}
    [[nodiscard]] double largest_step(const NodeVectors&, const NodeVectors&) const override {
        return 1;
    }

private:
    NodeVectors force_;
};

/// Adds a traction of `total` N, the same on all of the triangles' undeformed area, a third
/// of each triangle's at its corners. Throws InputError when there is no area.
void add_traction(const std::vector<Vec3>& rest, const std::vector<Triangle>& triangles,
                  const Vec3& total, NodeVectors& forces);

/// As add_traction for triangles with a node in the middle of each edge: the corners of each,
/// then the middles of 01 12 20, where the whole of it is.
void add_quadratic_traction(const std::vector<Vec3>& rest,
                            const std::vector<std::array<std::int32_t, 6>>& triangles,
                            const Vec3& total, NodeVectors& forces);

}  // namespace myotet::dynamics
