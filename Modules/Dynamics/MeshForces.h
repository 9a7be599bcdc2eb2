// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "Core/TetMesh.h"
#include "Dynamics/ForceField.h"
#include "Elasticity/Materials.h"
#include "Elasticity/Springs.h"

namespace myotet::dynamics {

/// Where each node occurs among the corners of the tetrahedra: sums over them
/// are made node by node in a fixed order, so that threads change no byte.
class CornerSums {
public:
    CornerSums(const std::vector<Tet>& tets, std::size_t nodes);
    /// Adds the corners' vectors up at the nodes.
    void add(const std::vector<elasticity::Corners>& corners, NodeVectors& to) const;
    /// Where a node occurs: 4 * tetrahedron + corner, in increasing order.
    [[nodiscard]] std::span<const std::uint32_t> corners(std::size_t node) const {
        return {corner_.data() + start_[node], corner_.data() + start_[node + 1]};
    }

private:
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> corner_;  // 4 * tetrahedron + corner
};

/// Linear tetrahedra of one material [Teran05, sec. 7.2]; the mesh as given is
/// at rest.
class ElementForces final : public ForceField {
public:
    /// First Piola-Kirchhoff stress of a deformation gradient, MPa.
    using Law = std::function<Mat3(const Mat3&)>;
    ElementForces(const TetMesh& rest, Law law, elasticity::Viscosity viscosity);

    void move_to(const NodeVectors& x) override;
    void add_elastic(NodeVectors& forces) const override;
    void add_damping(const NodeVectors& v, NodeVectors& forces) const override;

private:
    std::vector<Tet> tets_;
    std::vector<elasticity::RestTet> rest_, now_;
    std::vector<elasticity::Corners> elastic_;
    mutable std::vector<elasticity::Corners> damping_;
    Law law_;
    elasticity::Viscosity viscosity_;
    CornerSums sums_;
};

/// What springs are made of.
struct SpringOptions {
    double sound_speed = 1;      ///< of the material, mm/s
    double damping_ratio = 0.5;  ///< of the critical damping of one spring
    double altitude_share = 1;   ///< stiffness of altitude springs beside edge springs
    elasticity::AltitudeChoice altitudes = elasticity::AltitudeChoice::all;
};

/// Springs along all edges and altitudes [Teran05, sec. 7.1]; the mesh as given
/// is at rest.
class SpringForces final : public ForceField {
public:
    SpringForces(const TetMesh& rest, const std::vector<double>& masses,
                 const SpringOptions& options);

    void move_to(const NodeVectors& x) override;
    void add_elastic(NodeVectors& forces) const override;
    void add_damping(const NodeVectors& v, NodeVectors& forces) const override;

private:
    std::vector<Tet> tets_;
    // Each edge is a spring of the first tetrahedron that has it, so that all
    // forces are corners'.
    struct Edge {
        std::uint32_t a, b;  ///< corners, 4 * tetrahedron + corner
        elasticity::Spring spring;
        Vec3 along = Vec3::Zero();  ///< unit
    };
    std::vector<Edge> edges_;
    std::vector<std::size_t> first_edge_;  // per tetrahedron
    std::vector<std::array<elasticity::Spring, 4>> altitude_springs_;
    std::vector<std::array<elasticity::Altitude, 4>> altitudes_;
    std::vector<unsigned> chosen_;
    std::vector<elasticity::Corners> elastic_;
    mutable std::vector<elasticity::Corners> damping_;
    elasticity::AltitudeChoice choice_;
    CornerSums sums_;
};

}  // namespace myotet::dynamics
