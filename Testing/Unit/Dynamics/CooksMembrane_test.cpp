// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "Dynamics/ElasticBody.h"
#include "Dynamics/NodalLoads.h"
#include "Dynamics/QuasiStatic.h"
#include "Support/ReferenceCase.h"

namespace myotet::dynamics {
namespace {

// Cook's membrane (Cook 1974) in three dimensions: a tapered panel, held at its left, sheared
// at its right, of a material that hardly changes its volume. Bending and incompressibility
// at once show how stiff elements are.
constexpr double kMu = 0.01, kBulk = 1000 * kMu;  // MPa
// Tip of quadratic three-field elements, n = 16, by another program, mm.
constexpr double kTip = 18.00;

// Isochoric neo-Hookean, mu/2 (J^(-2/3) tr(F^T F) - 3), by its own invariants.
class Rubber final : public elasticity::PointLaw {
public:
    double energy(std::size_t, const Mat3& F) const override {
        const double J = F.determinant();
        if (!(J > 0)) return std::numeric_limits<double>::infinity();
        return 0.5 * kMu * (std::pow(J, -2.0 / 3) * F.squaredNorm() - 3);
    }
    // P = mu J^(-2/3) (F - I1/3 F^-T)
    Mat3 stress(std::size_t, const Mat3& F) const override {
        const Mat3 G = F.inverse().transpose();
        return kMu * std::pow(F.determinant(), -2.0 / 3) * (F - F.squaredNorm() / 3 * G);
    }
    elasticity::Tangent tangent(std::size_t, const Mat3& F) const override {
        const Mat3 G = F.inverse().transpose();
        const double I = F.squaredNorm(), s = kMu * std::pow(F.determinant(), -2.0 / 3);
        elasticity::Tangent C;
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i)
                for (int l = 0; l < 3; ++l)
                    for (int k = 0; k < 3; ++k)
                        C(i + 3 * j, k + 3 * l) =
                            s * ((i == k && j == l) -
                                 2.0 / 3 * (G(k, l) * F(i, j) + F(k, l) * G(i, j)) +
                                 2.0 / 9 * I * G(k, l) * G(i, j) + I / 3 * G(i, l) * G(k, j));
        return C;
    }
    elasticity::VolumeLaw volume(std::size_t) const override { return {kBulk}; }
};

TetMesh membrane(int n) {
    TetMesh mesh = myotet::test::five_tet_block({1, 1, 10}, {n, n, std::max(1, n / 4)});
    for (Vec3& p : mesh.points) p = Vec3(48 * p.x(), 44 * p.x() + p.y() * (44 - 28 * p.x()), p.z());
    return mesh;
}

double tip(const TetMesh& mesh, elasticity::Points points) {
    ElasticBody body(std::move(points), mesh.points.size(), std::make_shared<Rubber>());
    NodalLoads shear(mesh.points.size());
    std::vector<Triangle> right;
    for (const Triangle& t : boundary_faces(mesh.tets))
        if (std::ranges::all_of(t, [&](int n) { return mesh.points[n].x() > 48 - 1e-9; }))
            right.push_back(t);
    NodeVectors whole(mesh.points.size(), Vec3::Zero());
    add_traction(mesh.points, right, Vec3(0, 0.4, 0), whole);
    std::vector<std::int32_t> held;
    std::int32_t corner = -1;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        if (mesh.points[n].x() == 0) held.push_back(static_cast<std::int32_t>(n));
        if ((mesh.points[n] - Vec3(48, 60, 0)).norm() < 1e-9) corner = static_cast<std::int32_t>(n);
    }
    NodeVectors x = mesh.points;
    const LoadCase load_case{{&body, &shear}, held, [&](double load, NodeVectors&) {
                                 shear.forces() = whole;
                                 for (Vec3& f : shear.forces()) f *= load;
                             }};
    const LoadSummary summary =
        apply_load(load_case, {.first_step = 0.25, .most_step = 0.5}, x, {});
    EXPECT_TRUE(summary.completed) << summary.message;
    return (x[corner] - mesh.points[corner]).y();
}

TEST(CooksMembrane, PatchesDoNotLockAndLinearTetrahedraDo) {
    const TetMesh mesh = membrane(8);
    const double patched = tip(mesh, elasticity::patch_points(mesh)),
                 linear = tip(mesh, elasticity::linear_points(mesh));
    EXPECT_NEAR(patched / kTip, 1, 0.04);
    // Another program's linear tetrahedra on such a mesh: 13.16 mm.
    EXPECT_NEAR(linear / 13.16, 1, 0.02);
}

}  // namespace
}  // namespace myotet::dynamics
