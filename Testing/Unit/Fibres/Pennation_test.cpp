// SPDX-License-Identifier: Apache-2.0
#include "Fibres/Pennation.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "FibreShapes.h"
#include "Fibres/CentralLine.h"
#include "Fibres/Laplace.h"

namespace myotet::fibres {
namespace {

// Degrees: solving and turning.
constexpr double kDegrees = 1e-5;
constexpr double kAngle = 20;

class Pennate : public ::testing::Test {
protected:
    Pennate() : mesh_(test::shaken_cylinder(5, 40)) { options_.pennation.angle_deg = kAngle; }
    [[nodiscard]] FibreField fibres() const {
        return laplace_fibres(mesh_, test::nodes_at(mesh_, 0), test::nodes_at(mesh_, 40), options_);
    }
    TetMesh mesh_;
    LaplaceOptions options_;
};

TEST_F(Pennate, LeansByTheAngleTowardsAPlaneBeside) {
    options_.pennation.aponeurosis = Plane{Vec3(8, 0, 0), Vec3(-2, 0, 0)};
    const double a = kAngle * std::numbers::pi / 180;
    const FibreField f = fibres();
    for (const Vec3& v : f.direction)
        EXPECT_LT((v - Vec3(std::sin(a), 0, std::cos(a))).norm(), 1e-7);
    EXPECT_TRUE(f.notes.empty());
}

TEST_F(Pennate, ANegativeAngleLeansAway) {
    options_.pennation.aponeurosis = Plane{Vec3(8, 0, 0), Vec3(1, 0, 0)};
    options_.pennation.angle_deg = -kAngle;
    for (const Vec3& v : fibres().direction) EXPECT_LT(v.x(), 0);
}

TEST_F(Pennate, LeansToBothSidesOfAPlaneWithin) {
    options_.pennation.aponeurosis = Plane{Vec3(0, 0, 0), Vec3(0, 1, 0)};
    const FibreField f = fibres();
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
        EXPECT_NEAR(test::line_angle(f.direction[t], Vec3::UnitZ()), kAngle, kDegrees);
        EXPECT_LT(f.direction[t].y() * centroid_of(mesh_, mesh_.tets[t]).y(), 0);
    }
}

TEST_F(Pennate, LeansTowardsTheDerivedCentralLine) {
    // A section's centroid is off the axis by less than this on a shaken mesh, mm.
    constexpr double kOff = 0.4;
    const FibreField f = fibres();
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
        EXPECT_NEAR(test::line_angle(f.direction[t], Vec3::UnitZ()), kAngle, kDegrees);
        const Vec3 x = centroid_of(mesh_, mesh_.tets[t]);
        if (x.head<2>().norm() < 2 * kOff) continue;
        EXPECT_LT(f.direction[t].head<2>().dot(x.head<2>()), 0);
    }
}

TEST_F(Pennate, TurnsWithTheMuscle) {
    const FibreField straight = fibres();
    TetMesh turned = mesh_;
    const Mat3 R = test::some_rotation();
    for (Vec3& p : turned.points) p = R * p;
    const FibreField f =
        laplace_fibres(turned, test::nodes_at(mesh_, 0), test::nodes_at(mesh_, 40), options_);
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
        EXPECT_LT((f.direction[t] - R * straight.direction[t]).norm(), 1e-7);
}

TEST_F(Pennate, RefusesAPlaneWithoutANormal) {
    options_.pennation.aponeurosis = Plane{Vec3::Zero(), Vec3::Zero()};
    EXPECT_THROW((void)fibres(), InputError);
}

TEST(CentralLine, OfASpindleIsItsAxis) {
    const TetMesh mesh = test::fusiform(5, 50);
    std::vector<double> height;
    for (const Vec3& p : mesh.points) height.push_back(p.z());
    const CentralLine line = central_line(mesh, height, 20);
    // Parts cut through layers of tetrahedra, and are not symmetric.
    constexpr double kOff = 0.4;
    EXPECT_LT((line.point.front() - Vec3(0, 0, 0)).norm(), 1e-9);
    EXPECT_LT((line.point.back() - Vec3(0, 0, 100)).norm(), 1e-9);
    EXPECT_NEAR(line.length.back(), 100, 1);
    for (double z = 0; z <= 100; z += 3.3) {
        EXPECT_LT(line.at(z).head<2>().norm(), kOff);
        EXPECT_NEAR(line.at(z).z(), z, kOff);
        EXPECT_NEAR(line.potential_at(line.length.back() * z / 100), z, 2 * kOff);
    }
}

}  // namespace
}  // namespace myotet::fibres
