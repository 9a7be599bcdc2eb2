// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/StrainLimit.h"

#include <gtest/gtest.h>

#include "DynamicsShapes.h"
#include "Elasticity/Springs.h"

namespace myotet::dynamics {
namespace {

using elasticity::altitude_of;
using elasticity::corners_of;

const TetMesh kTet{{Vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0.2, 0.3, 1}}, {{0, 1, 2, 3}}, {}};
const std::vector<double> kMasses = {1, 2, 3, 4};

TEST(AltitudeLimiter, BoundsTheRate) {
    const AltitudeLimiter limit(kTet, kMasses, {.strain = 0.5, .rate = 0.1});
    for (const double speed : {-5.0, 5.0}) {
        NodeVectors v(4, Vec3::Zero());
        v[3].z() = speed;
        limit(kTet.points, v, 1);
        const auto h = altitude_of(corners_of(kTet.tets[0], kTet.points), 3);
        // Altitudes that come later in the same element shift it a little.
        EXPECT_LT(std::abs(h.rate({v[0], v[1], v[2], v[3]})), 0.13) << speed;
        EXPECT_GT(std::abs(h.rate({v[0], v[1], v[2], v[3]})), 0.05) << speed;
    }
}

TEST(AltitudeLimiter, BoundsTheStrain) {
    const AltitudeLimiter limit(kTet, kMasses, {.strain = 0.5, .rate = 10});
    TetMesh squeezed = kTet;
    squeezed.points[3].z() = 0.5;  // at the limit: no further, but back is free
    NodeVectors down(4, Vec3::Zero()), up(4, Vec3::Zero());
    down[3].z() = -0.3;
    up[3].z() = 0.3;
    const auto h = altitude_of(corners_of(kTet.tets[0], squeezed.points), 3);
    limit(squeezed.points, down, 1);
    EXPECT_GT(h.rate({down[0], down[1], down[2], down[3]}), -0.05);
    limit(squeezed.points, up, 1);
    EXPECT_NEAR(h.rate({up[0], up[1], up[2], up[3]}), 0.3, 1e-12);
}

TEST(AltitudeLimiter, KeepsBothMomenta) {
    const TetMesh mesh = test::block(2, 1);
    const std::vector<double> masses = elasticity::nodal_masses(mesh, 3);
    const AltitudeLimiter limit(mesh, masses, {});
    NodeVectors v = test::random_vectors(mesh.points.size(), 3, 1), before = v;
    limit(mesh.points, v, 1);
    EXPECT_NE(v, before);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) {
        force += masses[i] * (v[i] - before[i]);
        torque += masses[i] * mesh.points[i].cross(v[i] - before[i]);
    }
    EXPECT_LT(force.norm(), 1e-12);
    EXPECT_LT(torque.norm(), 1e-12);
}

TEST(AltitudeLimiter, LeavesSlowMotionAlone) {
    const TetMesh mesh = test::block(2, 1);
    const AltitudeLimiter limit(mesh, elasticity::nodal_masses(mesh, 1), {});
    NodeVectors v = test::random_vectors(mesh.points.size(), 0.01, 1);
    const NodeVectors before = v;
    limit(mesh.points, v, 1);
    EXPECT_EQ(v, before);
}

}  // namespace
}  // namespace myotet::dynamics
