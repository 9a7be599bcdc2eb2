// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::elasticity {

/// Points of a body at rest at which its energy is taken. At each the deformation gradient
/// is a sum over a few nodes, F = sum_a x_a (grad N_a)^T, and the point stands for some of
/// the body's volume. What elements a body is made of is told by its points alone.
///
/// Where `groups` are given, the energy of volume, U(J), is not taken at each point but for
/// each group, at the mean of J = det F over its points: that frees linear tetrahedra from
/// locking.
struct Points {
    /// Point q has nodes node[start[q]] to node[start[q + 1]], and their gradients.
    std::vector<std::size_t> start = {0};
    std::vector<std::int32_t> node;
    std::vector<Vec3> gradient;  ///< grad N_a, 1/mm
    std::vector<double> volume;  ///< |Q| that the point's law is taken for, mm^3

    /// Points whose J are averaged, and the rest volume that each has in that, mm^3. A point
    /// is in one group at most.
    struct Groups {
        std::vector<std::size_t> start = {0};
        std::vector<std::uint32_t> point;
        std::vector<double> volume;
        std::vector<std::uint32_t> law;  ///< a group: the point whose law gives U

        [[nodiscard]] std::size_t size() const { return start.size() - 1; }
    } groups;

    /// Tetrahedra whose mean a point is: tet[tet_start[q]] to tet[tet_start[q + 1]], so that
    /// fibres and tissues can be given to points.
    std::vector<std::size_t> tet_start = {0};
    std::vector<std::int32_t> tet;

    [[nodiscard]] std::size_t size() const { return start.size() - 1; }
    [[nodiscard]] std::span<const std::int32_t> nodes(std::size_t q) const {
        return {node.data() + start[q], node.data() + start[q + 1]};
    }
    [[nodiscard]] std::span<const std::int32_t> tets(std::size_t q) const {
        return {tet.data() + tet_start[q], tet.data() + tet_start[q + 1]};
    }
    /// F for positions of the nodes; for a change of them, dF.
    [[nodiscard]] Mat3 gradient_of(std::size_t q, const std::vector<Vec3>& x) const {
        Mat3 F = Mat3::Zero();
        for (std::size_t i = start[q]; i < start[q + 1]; ++i)
            F += x[node[i]] * gradient[i].transpose();
        return F;
    }
};

/// Linear tetrahedra: one point each, in their order. Locks where a material hardly changes
/// its volume. Throws MeshError when a tetrahedron is not positive.
[[nodiscard]] Points linear_points(const TetMesh& rest);

struct PatchOptions {
    int size = 7;  ///< tetrahedra in a patch: one pressure for so many; 4 to 8 work
    /// Part of a patch's energy that is taken at its mean F, the rest at its tetrahedra's:
    /// 0 frees it of volumetric locking only, and stays stiff in bending; 1 is unstable.
    double mean_share = 0.75;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Linear tetrahedra freed from locking. Neighbours of one label form patches; the energy
/// of a patch p of tetrahedra t with rest volumes V is
///   sum_t (1 - s) V_t Psi(F_t) + s V_p Psi(mean F) + V_p U(mean J),
/// means weighted by volume: mean dilatation [Nagtegaal, Parks and Rice 1974; on patches:
/// de Souza Neto, Andrade Pires and Owen 2005], and beside it a mean of the shape as
/// averaged and assumed strains have it. Exact for linear displacements. Points are the
/// tetrahedra, then the patches. Throws MeshError as linear_points, InputError.
/// Cost: O(|T|), about 2 us a tetrahedron.
[[nodiscard]] Points patch_points(const TetMesh& rest, const PatchOptions& options = {});

/// A mesh with a node in the middle of each edge as well; for quadratic tetrahedra.
struct QuadraticMesh {
    std::vector<Vec3> points;  ///< those of the linear mesh, then the edges' middles
    /// Corners, then the middles of the edges 01 12 20 03 13 23.
    std::vector<std::array<std::int32_t, 10>> tets;
};
[[nodiscard]] QuadraticMesh quadratic_mesh(const TetMesh& linear);

/// Quadratic tetrahedra: four points each, those of the rule that is exact for squares
/// [Zienkiewicz and Taylor 2000, table 9.2]. Throws MeshError where a tetrahedron is not
/// positive at one of its points.
[[nodiscard]] Points quadratic_points(const QuadraticMesh& rest);

}  // namespace myotet::elasticity
