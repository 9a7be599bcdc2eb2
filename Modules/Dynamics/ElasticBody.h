// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "Core/TetMesh.h"
#include "Dynamics/MeshForces.h"
#include "Dynamics/Potential.h"
#include "Elasticity/TetLaw.h"

namespace myotet::dynamics {

/// The energy of linear tetrahedra; the mesh as given is at rest. A law may change with
/// time, as activation does: the next move_to sees it.
/// Cost: about 1 kB a tetrahedron; same bytes on any number of threads.
class ElasticBody final : public Potential {
public:
    /// Throws MeshError when a tetrahedron is not positive.
    ElasticBody(const TetMesh& rest, std::shared_ptr<const elasticity::TetLaw> law);

    [[nodiscard]] double move_to(const NodeVectors& x) override;
    void add_forces(NodeVectors& forces) const override;
    [[nodiscard]] Cliques cliques() const override;
    void add_stiffness(BlockMatrix& K) const override;
    [[nodiscard]] double largest_step(const NodeVectors& x, const NodeVectors& by) const override;

private:
    std::vector<Tet> tets_;
    std::vector<elasticity::RestTet> rest_;
    std::shared_ptr<const elasticity::TetLaw> law_;
    std::vector<Mat3> gradient_;  // F
    std::vector<elasticity::Corners> force_;
    mutable std::vector<elasticity::Tangent> tangent_;
    CornerSums sums_;
};

}  // namespace myotet::dynamics
