// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Dynamics/Potential.h"
#include "Elasticity/LinearTet.h"
#include "Elasticity/Materials.h"

namespace myotet::play {

/// Linear tetrahedra of a neo-Hookean material, elasticity::NeoHookean, made for steps that
/// must take little time. Its stiffness is the second derivative with each tetrahedron's
/// negative curvatures taken away, so that conjugate gradients never meet any: with
/// F = U S V^T, J = det F, s = mu - lambda ln J and spatial gradients h_a = F^-T grad N_a
///   K_ab = V (mu (grad N_a . grad N_b) I + s h_b h_a^T + lambda h_a h_b^T),
/// and where mu - s / (S_i S_j) is negative, which is the curvature along
/// U (e_i e_j^T - e_j e_i^T) V^T / sqrt 2, that much of it is added back [Smith, de Goes and
/// Kim 2019, sec. 4]; where s is negative, as in strong dilation, s is bounded instead so
/// that nothing is negative.
///
/// Cost: about 0.06 us a tetrahedron in move_to, 0.35 us in add_stiffness, on one thread,
/// which it uses: bodies of a scene go to different threads.
class SoftBody final : public dynamics::Potential {
public:
    /// Tetrahedra over all nodes of a scene, which are at `rest`; mu and lambda of each, MPa.
    /// Throws MeshError when one is not positive, InputError when there is not one law a
    /// tetrahedron.
    SoftBody(std::span<const Vec3> rest, std::vector<Tet> tets,
             std::span<const elasticity::Lame> laws);

    [[nodiscard]] double move_to(const dynamics::NodeVectors& x) override;
    void add_forces(dynamics::NodeVectors& forces) const override;
    [[nodiscard]] dynamics::Cliques cliques() const override;
    /// The pattern of K shall be that of the first call.
    void add_stiffness(dynamics::BlockMatrix& K) const override;
    [[nodiscard]] double largest_step(const dynamics::NodeVectors& x,
                                      const dynamics::NodeVectors& by) const override;

    /// Smallest det F where move_to was last.
    [[nodiscard]] double smallest_volume_ratio() const;

private:
    struct Element {
        Mat3 inverse_edges;         // of the rest edges, 1/mm
        double mu = 0, lambda = 0;  // times the rest volume, N mm
    };
    void find_places(const dynamics::BlockMatrix& K) const;
    [[nodiscard]] Mat3 edges(std::size_t t, const dynamics::NodeVectors& x) const {
        Mat3 E;
        for (int c = 0; c < 3; ++c) E.col(c) = x[tets_[t][c + 1]] - x[tets_[t][0]];
        return E;
    }

    std::vector<Tet> tets_;
    std::vector<Element> elements_;
    std::vector<Mat3> F_;
    std::vector<double> J_;
    mutable std::vector<std::array<std::uint32_t, 16>> places_;  // of blocks in K, row by row
};

}  // namespace myotet::play
