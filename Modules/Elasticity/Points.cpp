// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Points.h"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <string>

#include "Core/Errors.h"
#include "Elasticity/LinearTet.h"

namespace myotet::elasticity {
namespace {

void finish_point(Points& points, double volume, std::span<const std::int32_t> tets) {
    points.start.push_back(points.node.size());
    points.volume.push_back(volume);
    points.tet.insert(points.tet.end(), tets.begin(), tets.end());
    points.tet_start.push_back(points.tet.size());
}

// Derivatives of the ten basis functions by the barycentric coordinates L of corners
// 0 to 3: N_i = L_i (2 L_i - 1), N_ij = 4 L_i L_j; and grad L from the corners.
using Shapes = Eigen::Matrix<double, 10, 4>;

Shapes shape_slopes(const Eigen::Vector4d& L) {
    constexpr int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    Shapes slopes = Shapes::Zero();
    for (int i = 0; i < 4; ++i) slopes(i, i) = 4 * L[i] - 1;
    for (int e = 0; e < 6; ++e) {
        slopes(4 + e, ends[e][0]) = 4 * L[ends[e][1]];
        slopes(4 + e, ends[e][1]) = 4 * L[ends[e][0]];
    }
    return slopes;
}

}  // namespace

Points linear_points(const TetMesh& rest) {
    Points points;
    for (std::size_t t = 0; t < rest.tets.size(); ++t) {
        const RestTet tet = rest_tet(corners_of(rest.tets[t], rest.points));
        points.node.insert(points.node.end(), rest.tets[t].begin(), rest.tets[t].end());
        points.gradient.push_back(-tet.inverse_edges.colwise().sum().transpose());
        for (int c = 0; c < 3; ++c) points.gradient.push_back(tet.inverse_edges.row(c).transpose());
        const auto number = static_cast<std::int32_t>(t);
        finish_point(points, tet.volume, {&number, 1});
    }
    return points;
}

QuadraticMesh quadratic_mesh(const TetMesh& linear) {
    constexpr int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    QuadraticMesh mesh;
    mesh.points = linear.points;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
    for (const Tet& tet : linear.tets) {
        std::array<std::int32_t, 10> ten{tet[0], tet[1], tet[2], tet[3]};
        for (int e = 0; e < 6; ++e) {
            const auto [low, high] = std::minmax(tet[ends[e][0]], tet[ends[e][1]]);
            const auto [found, fresh] =
                middle.try_emplace({low, high}, static_cast<std::int32_t>(mesh.points.size()));
            if (fresh) mesh.points.push_back(0.5 * (linear.points[low] + linear.points[high]));
            ten[4 + e] = found->second;
        }
        mesh.tets.push_back(ten);
    }
    return mesh;
}

Points quadratic_points(const QuadraticMesh& rest) {
    // Four points at (a, b, b, b) and its permutations, a quarter of the volume each.
    const double b = (5 - std::sqrt(5.0)) / 20, a = 1 - 3 * b;
    Points points;
    for (std::size_t t = 0; t < rest.tets.size(); ++t)
        for (int q = 0; q < 4; ++q) {
            Eigen::Vector4d L = Eigen::Vector4d::Constant(b);
            L[q] = a;
            const Shapes slopes = shape_slopes(L);
            // Columns of dx/dL_i - dx/dL_0, i = 1 to 3: L_0 = 1 - L_1 - L_2 - L_3.
            Mat3 jacobian = Mat3::Zero();
            for (int n = 0; n < 10; ++n)
                for (int c = 0; c < 3; ++c)
                    jacobian.col(c) +=
                        (slopes(n, c + 1) - slopes(n, 0)) * rest.points[rest.tets[t][n]];
            const double volume = jacobian.determinant() / 24;
            if (!(volume > 0))
                throw MeshError("a quadratic tetrahedron at rest has the volume " +
                                std::to_string(volume) +
                                " mm^3 at one of its points, but it must be positive");
            const Mat3 inverse = jacobian.inverse();
            for (int n = 0; n < 10; ++n) {
                points.node.push_back(rest.tets[t][n]);
                points.gradient.push_back(inverse.transpose() * Vec3(slopes(n, 1) - slopes(n, 0),
                                                                     slopes(n, 2) - slopes(n, 0),
                                                                     slopes(n, 3) - slopes(n, 0)));
            }
            const auto number = static_cast<std::int32_t>(t);
            finish_point(points, volume, {&number, 1});
        }
    return points;
}

}  // namespace myotet::elasticity
