// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/MeshForces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "DynamicsShapes.h"

namespace myotet::dynamics {
namespace {

using elasticity::AltitudeChoice;

const TetMesh kBlock = test::block(2, 1.3);
const std::vector<double> kMasses = elasticity::nodal_masses(kBlock, 2);

NodeVectors moved(double size) {
    NodeVectors x = kBlock.points;
    const NodeVectors by = test::random_vectors(x.size(), size, 2);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += by[i];
    return x;
}

NodeVectors elastic(ForceField& field, const NodeVectors& x) {
    NodeVectors f(x.size(), Vec3::Zero());
    field.move_to(x);
    field.add_elastic(f);
    return f;
}

double product(const NodeVectors& a, const NodeVectors& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
}

void expect_laws(ForceField& field) {
    for (const Vec3& f : elastic(field, kBlock.points)) EXPECT_LT(f.norm(), 1e-12);
    const NodeVectors x = moved(0.15), f = elastic(field, x);
    Vec3 total = Vec3::Zero(), torque = Vec3::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
        total += f[i];
        torque += x[i].cross(f[i]);
    }
    EXPECT_GT(product(f, f), 1e-4);
    EXPECT_LT(total.norm(), 1e-11);
    EXPECT_LT(torque.norm(), 1e-11);

    // Symmetry of the forces' derivative: f is the gradient of some energy.
    const NodeVectors u = test::random_vectors(x.size(), 1, 6),
                      w = test::random_vectors(x.size(), 1, 7);
    const auto derivative = [&](const NodeVectors& along) {
        constexpr double step = 1e-6;
        NodeVectors up = x, down = x;
        for (std::size_t i = 0; i < x.size(); ++i) {
            up[i] += step * along[i];
            down[i] -= step * along[i];
        }
        NodeVectors d = elastic(field, up);
        const NodeVectors low = elastic(field, down);
        for (std::size_t i = 0; i < d.size(); ++i) d[i] = (d[i] - low[i]) / (2 * step);
        return d;
    };
    const double uw = product(derivative(u), w), wu = product(derivative(w), u);
    EXPECT_NEAR(uw, wu, 1e-5 * (std::abs(uw) + 1));

    field.move_to(x);
    NodeVectors du(x.size(), Vec3::Zero()), dw = du;
    field.add_damping(u, du);
    field.add_damping(w, dw);
    EXPECT_NEAR(product(du, w), product(dw, u), 1e-9 * (1 + std::abs(product(du, w))));
    EXPECT_LT(product(du, u), 0);
}

TEST(ElementForces, ObeyTheLaws) {
    const elasticity::NeoHookean neo{elasticity::lame_from(1, 0.3)};
    ElementForces a(kBlock, [&](const Mat3& F) { return neo.stress(F); }, {0.1, 0.05});
    expect_laws(a);
    const elasticity::StVenantKirchhoff stvk{elasticity::lame_from(1, 0.3)};
    ElementForces b(kBlock, [&](const Mat3& F) { return stvk.stress(F); }, {0.1, 0.05});
    expect_laws(b);
}

TEST(SpringForces, ObeyTheLaws) {
    for (const AltitudeChoice choice : {AltitudeChoice::all, AltitudeChoice::compressed}) {
        SpringForces springs(kBlock, kMasses, {.sound_speed = 2, .altitudes = choice});
        expect_laws(springs);
    }
}

TEST(SpringForces, TheShortestAltitudeAloneIsEnoughToResistFlattening) {
    SpringForces springs(kBlock, kMasses,
                         {.sound_speed = 2, .altitudes = AltitudeChoice::shortest});
    NodeVectors x = kBlock.points;
    for (Vec3& p : x) p.z() *= 0.3;
    const NodeVectors f = elastic(springs, x);
    double outward = 0;
    for (std::size_t i = 0; i < x.size(); ++i) outward += f[i].z() * (x[i].z() - 0.39);
    EXPECT_GT(outward, 0);
}

}  // namespace
}  // namespace myotet::dynamics
