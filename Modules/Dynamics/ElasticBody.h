// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "Dynamics/Potential.h"
#include "Elasticity/PointLaw.h"
#include "Elasticity/Points.h"

namespace myotet::dynamics {

/// The energy of a body of tetrahedra of any kind: what its points say. A law may change
/// with time, as activation does: the next move_to sees it.
/// Cost: about 1 kB a point; same bytes on any number of threads.
class ElasticBody final : public Potential {
public:
    /// Linear tetrahedra; the mesh as given is at rest. Throws MeshError when one is not
    /// positive.
    ElasticBody(const TetMesh& rest, std::shared_ptr<const elasticity::PointLaw> law);
    /// Any points, over `nodes` nodes.
    ElasticBody(elasticity::Points points, std::size_t nodes,
                std::shared_ptr<const elasticity::PointLaw> law);

    [[nodiscard]] double move_to(const NodeVectors& x) override;
    void add_forces(NodeVectors& forces) const override;
    [[nodiscard]] Cliques cliques() const override;
    void add_stiffness(BlockMatrix& K) const override;
    [[nodiscard]] double largest_step(const NodeVectors& x, const NodeVectors& by) const override;

    [[nodiscard]] const elasticity::Points& points() const { return points_; }
    /// Where move_to was last: a point's F, and its first Piola-Kirchhoff stress, MPa, but
    /// for its volume's; and that of its volume, by its group's pressure if it has one and
    /// nothing where other points have it.
    [[nodiscard]] const std::vector<Mat3>& gradients() const { return gradient_; }
    [[nodiscard]] Mat3 law_stress(std::size_t point) const;
    [[nodiscard]] Mat3 volume_stress(std::size_t point) const;

private:
    // Where a node occurs.
    struct Slot {
        std::uint32_t owner = 0;  // a point, or a group
        std::uint32_t entry = 0;  // among all nodes of all owners
    };
    struct Slots {
        std::vector<std::size_t> start;
        std::vector<Slot> slot;
        Slots(std::span<const std::size_t> owner_start, std::span<const std::int32_t> node,
              std::size_t nodes);
    };
    // Nodes of each group and, once there is a stiffness, the slopes of its mean volume.
    struct Groups {
        std::vector<std::size_t> start = {0};
        std::vector<std::int32_t> node;
        std::vector<double> pressure, slope;  // U', and U'' / V
        std::vector<Vec3> volume_slope;       // sum_t V_t cof(F_t) grad N_a
    };

    [[nodiscard]] double move_groups(const NodeVectors& x);
    void find_tangents() const;
    void find_volume_slopes() const;

    elasticity::Points points_;
    std::shared_ptr<const elasticity::PointLaw> law_;
    std::vector<std::int32_t> group_of_;  // a point, or -1
    std::vector<double> group_volume_;    // a point's rest volume in its group
    mutable Groups groups_;
    Slots slots_, group_slots_;
    std::vector<Mat3> gradient_;                        // F
    std::vector<Vec3> force_;                           // an entry of the points
    mutable std::vector<elasticity::Tangent> tangent_;  // times the volume
};

}  // namespace myotet::dynamics
