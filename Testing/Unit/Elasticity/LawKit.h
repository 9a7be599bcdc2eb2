// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "Elasticity/LinearTet.h"

namespace myotet::elasticity::kit {

// Central differences over this step err by its square and by rounding / step.
inline constexpr double kStep = 1e-5, kDifference = 1e-7;
inline constexpr double kRounding = 1e-12;

inline Mat3 random_matrix(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> entry(-size, size);
    Mat3 m;
    for (int i = 0; i < 9; ++i) m.data()[i] = entry(random);
    return m;
}
inline Mat3 random_rotation(std::mt19937& random) {
    const Mat3 m = random_matrix(random, 1);
    return Eigen::AngleAxisd(3 * m(0, 0), m.col(1).normalized()).toRotationMatrix();
}
/// Deformations from none to large, all of positive volume.
inline std::vector<Mat3> deformations() {
    std::mt19937 random(5);
    std::vector<Mat3> all = {Mat3::Identity()};
    for (const double size : {1e-3, 0.1, 0.3, 0.5})
        for (int i = 0; i < 8; ++i) {
            Mat3 F = Mat3::Identity() + random_matrix(random, size);
            if (F.determinant() > 0.1) all.push_back(random_rotation(random) * F);
        }
    return all;
}
/// A tetrahedron of no symmetry, and one moved at random.
inline Corners some_tet() {
    return {Vec3(0.1, 0, 0), {2, 0.3, -0.1}, {0.4, 1.7, 0.2}, {0.3, 0.5, 1.9}};
}
inline Corners moved(const Corners& x, const Mat3& F) {
    return {F * x[0], F * x[1], F * x[2], F * x[3]};
}
inline Corners random_velocities(std::mt19937& random) {
    const Mat3 a = random_matrix(random, 1), b = random_matrix(random, 1);
    return {a.col(0), a.col(1), a.col(2), b.col(0)};
}

/// Total force and total torque are nothing beside the forces themselves.
inline void expect_no_push(const Corners& x, const Corners& f, double scale) {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (int i = 0; i < 4; ++i) {
        force += f[i];
        torque += x[i].cross(f[i]);
    }
    EXPECT_LT(force.norm(), kRounding * 10 * scale);
    EXPECT_LT(torque.norm(), kRounding * 50 * scale);
}

/// The tangent is symmetric and the derivative of the stress, and it turns with the
/// material: dP(Q F)[Q dF] = Q dP(F)[dF].
template <class Law>
void expect_tangent(const Law& law, const Mat3& F, const Mat3& Q, const Mat3& dF) {
    const Tangent C = law.tangent(F);
    const double scale = 1 + C.norm();
    EXPECT_LT((C - C.transpose()).norm(), kRounding * scale);
    const Mat3 slope = (law.stress(F + kStep * dF) - law.stress(F - kStep * dF)) / (2 * kStep);
    EXPECT_LT((C * dF.reshaped() - slope.reshaped()).norm(), kDifference * 20 * scale);
    const Mat3 turned = (law.tangent(Q * F) * (Q * dF).reshaped()).reshaped(3, 3);
    const Mat3 still = (C * dF.reshaped()).reshaped(3, 3);
    EXPECT_LT((turned - Q * still).norm(), 1e-10 * scale);
}

/// The laws that every constitutive law obeys: zero at rest, objectivity, stress
/// the derivative of the energy and the tangent that of the stress, no total force and no
/// torque on a tetrahedron.
template <class Law>
void expect_law(const Law& law) {
    EXPECT_NEAR(law.energy(Mat3::Identity()), 0, kRounding);
    EXPECT_LT(law.stress(Mat3::Identity()).norm(), kRounding);
    std::mt19937 random(9);
    const RestTet rest = rest_tet(some_tet());
    for (const Mat3& F : deformations()) {
        const double scale = 1 + law.stress(F).norm();
        const Mat3 Q = random_rotation(random);
        EXPECT_NEAR(law.energy(Q * F), law.energy(F), 1e-10 * scale);
        EXPECT_LT((law.stress(Q * F) - Q * law.stress(F)).norm(), 1e-10 * scale);
        EXPECT_GE(law.energy(F), -kRounding);
        for (int i = 0; i < 9; ++i) {
            Mat3 up = F, down = F;
            up.data()[i] += kStep;
            down.data()[i] -= kStep;
            const double slope = (law.energy(up) - law.energy(down)) / (2 * kStep);
            EXPECT_NEAR(law.stress(F).data()[i], slope, kDifference * 20 * scale);
        }
        expect_tangent(law, F, Q, random_matrix(random, 1));
        const Corners x = moved(some_tet(), F);
        expect_no_push(x, rest.forces(law.stress(rest.gradient(x))), scale * 10);
    }
}

/// Damping forces f(v): linear, symmetric, never adding energy, none for a rigid motion.
template <class Damping>
void expect_damping(const Corners& x, Damping&& forces) {
    std::mt19937 random(3);
    const auto power = [](const Corners& f, const Corners& v) {
        double p = 0;
        for (int i = 0; i < 4; ++i) p += f[i].dot(v[i]);
        return p;
    };
    for (int trial = 0; trial < 20; ++trial) {
        const Corners u = random_velocities(random), v = random_velocities(random);
        Corners sum;
        for (int i = 0; i < 4; ++i) sum[i] = u[i] + 2 * v[i];
        const Corners fu = forces(u), fv = forces(v), fs = forces(sum);
        double scale = 1;
        for (int i = 0; i < 4; ++i) scale += fu[i].norm() + fv[i].norm();
        for (int i = 0; i < 4; ++i) EXPECT_LT((fs[i] - fu[i] - 2 * fv[i]).norm(), 1e-12 * scale);
        EXPECT_NEAR(power(fu, v), power(fv, u), 1e-11 * scale);
        EXPECT_LE(power(fu, u), kRounding * scale);
        expect_no_push(x, fu, 10 * scale);
    }
    const Vec3 spin(0.3, -1, 0.5), drift(1, 2, 3);
    Corners rigid;
    for (int i = 0; i < 4; ++i) rigid[i] = drift + spin.cross(x[i]);
    for (const Vec3& f : forces(rigid)) EXPECT_LT(f.norm(), 1e-10);
}

}  // namespace myotet::elasticity::kit
