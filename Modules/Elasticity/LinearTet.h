// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "Core/TetMesh.h"
#include "Elasticity/Tangent.h"

namespace myotet::elasticity {

/// Corner positions, velocities or forces of a tetrahedron.
using Corners = std::array<Vec3, 4>;

[[nodiscard]] inline Corners corners_of(const Tet& tet, const std::vector<Vec3>& points) {
    return {points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]};
}

/// Edge vectors from the first corner, as columns.
[[nodiscard]] inline Mat3 edges_of(const Corners& x) {
    Mat3 edges;
    for (int c = 0; c < 3; ++c) edges.col(c) = x[c + 1] - x[0];
    return edges;
}

/// A tetrahedron at rest, with linear basis functions.
struct RestTet {
    Mat3 inverse_edges = Mat3::Identity();  ///< of the rest edges, 1/mm
    double volume = 0;                      ///< mm^3

    /// F = dx/du; for velocities, dF/dt.
    [[nodiscard]] Mat3 gradient(const Corners& x) const { return edges_of(x) * inverse_edges; }

    /// Nodal forces of the first Piola-Kirchhoff stress P: f_i = -V P grad N_i,
    /// whose sum is zero. N for P in MPa.
    [[nodiscard]] Corners forces(const Mat3& P) const {
        const Mat3 H = -volume * P * inverse_edges.transpose();
        return {-H.col(0) - H.col(1) - H.col(2), H.col(0), H.col(1), H.col(2)};
    }

    /// Derivative of minus the force on a corner by the positions of all corners, N/mm:
    /// K_ab = V sum_jl dP_.j/dF_.l (grad N_a)_j (grad N_b)_l.
    [[nodiscard]] std::array<Mat3, 4> stiffness_row(const Tangent& tangent, int corner) const;
};

/// Throws MeshError when the tetrahedron is not positive.
[[nodiscard]] RestTet rest_tet(const Corners& x);
[[nodiscard]] std::vector<RestTet> rest_tets(const TetMesh& mesh);

/// Nodal forces of a Cauchy stress in the tetrahedron as it is: a third of the
/// traction on the three faces that meet in node i, f_i = -sigma (A_j n_j + A_k n_k
/// + A_l n_l) / 3 with outward normals, so that tension pulls the nodes together
/// [Teran05, appendix, where the sign is that of the force on the tetrahedron].
[[nodiscard]] Corners cauchy_forces(const Corners& x, const Mat3& sigma);

/// A quarter of each tetrahedron's mass at its nodes, t, for a density in t/mm^3
/// [Teran05, sec. 7.1].
[[nodiscard]] std::vector<double> nodal_masses(const TetMesh& mesh, double density);

}  // namespace myotet::elasticity
