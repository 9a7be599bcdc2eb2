// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/LinearTet.h"

#include <Eigen/LU>

#include "Core/Errors.h"

namespace myotet::elasticity {

RestTet rest_tet(const Corners& x) {
    const Mat3 edges = edges_of(x);
    const double volume = edges.determinant() / 6;
    if (!(volume > 0))
        throw MeshError("a tetrahedron at rest has the volume " + std::to_string(volume) +
                        " mm^3, but it must be positive");
    return {edges.inverse(), volume};
}

std::vector<RestTet> rest_tets(const TetMesh& mesh) {
    std::vector<RestTet> rest;
    rest.reserve(mesh.tets.size());
    for (const Tet& tet : mesh.tets) rest.push_back(rest_tet(corners_of(tet, mesh.points)));
    return rest;
}

std::array<Mat3, 4> RestTet::stiffness_row(const Tangent& tangent, int corner) const {
    const Vec3 gradient = corner == 0 ? Vec3(-inverse_edges.colwise().sum().transpose())
                                      : Vec3(inverse_edges.row(corner - 1).transpose());
    const Eigen::Matrix<double, 3, 9> row =
        volume * (gradient[0] * tangent.topRows<3>() + gradient[1] * tangent.middleRows<3>(3) +
                  gradient[2] * tangent.bottomRows<3>());
    std::array<Mat3, 4> blocks;
    for (int b = 0; b < 3; ++b)
        blocks[b + 1] = inverse_edges(b, 0) * row.leftCols<3>() +
                        inverse_edges(b, 1) * row.middleCols<3>(3) +
                        inverse_edges(b, 2) * row.rightCols<3>();
    // Moving all corners together costs nothing.
    blocks[0] = -blocks[1] - blocks[2] - blocks[3];
    return blocks;
}

Corners cauchy_forces(const Corners& x, const Mat3& sigma) {
    Corners normal;  // area-weighted, of the face opposite each node
    for (int i = 0; i < 4; ++i) {
        const Triangle f = face_of({0, 1, 2, 3}, i);
        normal[i] = 0.5 * (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]);
    }
    // The four area vectors of a closed surface add up to zero.
    Corners force;
    for (int i = 0; i < 4; ++i) force[i] = sigma * normal[i] / 3;
    return force;
}

std::vector<double> nodal_masses(const TetMesh& mesh, double density) {
    std::vector<double> masses(mesh.points.size(), 0.0);
    for (const Tet& t : mesh.tets) {
        const double share = density / 4 *
                             signed_volume(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]],
                                           mesh.points[t[3]]);
        for (const std::int32_t n : t) masses[n] += share;
    }
    return masses;
}

}  // namespace myotet::elasticity
