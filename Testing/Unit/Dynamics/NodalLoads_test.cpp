// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/NodalLoads.h"

#include <gtest/gtest.h>

#include <map>

#include "Core/Errors.h"
#include "Dynamics/NodeAlgebra.h"
#include "DynamicsShapes.h"
#include "Elasticity/Points.h"

namespace myotet::dynamics {
namespace {

constexpr double kRounding = 1e-14;

TEST(NodalLoads, KeepTheirForcesWhereverNodesGo) {
    NodalLoads loads(3);
    loads.forces() = test::random_vectors(3, 1, 1);
    const NodeVectors x = test::random_vectors(3, 1, 2), by = test::random_vectors(3, 100, 3);
    NodeVectors there = x;
    add_scaled(1, by, there);
    // The energy falls by the work that the forces do.
    EXPECT_NEAR(loads.move_to(x) - loads.move_to(there), dot(loads.forces(), by), 1e-12);
    NodeVectors f(3, Vec3(1, 2, 3));
    loads.add_forces(f);
    for (int n = 0; n < 3; ++n) EXPECT_EQ(f[n], Vec3(Vec3(1, 2, 3) + loads.forces()[n]));
    EXPECT_EQ(loads.cliques().size(), 0U);
    BlockMatrix K = block_pattern(3, loads.cliques());
    loads.add_stiffness(K);
    for (const Mat3& block : K.value) EXPECT_EQ(block, Mat3(Mat3::Zero()));
    EXPECT_EQ(loads.largest_step(x, by), 1);
}

// Total force and torque.
std::pair<Vec3, Vec3> totals(const std::vector<Vec3>& x, const NodeVectors& f) {
    std::pair<Vec3, Vec3> sum{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t n = 0; n < x.size(); ++n) {
        sum.first += f[n];
        sum.second += x[n].cross(f[n]);
    }
    return sum;
}

// Triangles of a block's face z = 0, whose middle is (1, 1, 0).
struct Floor {
    TetMesh mesh = test::block(2, 1);
    std::vector<Triangle> triangles;
    Floor() {
        for (const Triangle& t : boundary_faces(mesh.tets))
            if (mesh.points[t[0]].z() + mesh.points[t[1]].z() + mesh.points[t[2]].z() == 0)
                triangles.push_back(t);
    }
};

TEST(AddTraction, IsTheWholeForceAndActsInTheMiddle) {
    const Floor floor;
    ASSERT_EQ(floor.triangles.size(), 8U);
    const Vec3 total(1, -2, 3);
    NodeVectors f(floor.mesh.points.size(), Vec3::Zero());
    add_traction(floor.mesh.points, floor.triangles, total, f);
    const auto [force, torque] = totals(floor.mesh.points, f);
    EXPECT_LT((force - total).norm(), kRounding);
    EXPECT_LT((torque - Vec3(1, 1, 0).cross(total)).norm(), 10 * kRounding);
    for (std::size_t n = 0; n < f.size(); ++n)
        EXPECT_EQ(f[n].norm() > 0, floor.mesh.points[n].z() == 0);
    // Once more adds as much again.
    const NodeVectors once = f;
    add_traction(floor.mesh.points, floor.triangles, total, f);
    for (std::size_t n = 0; n < f.size(); ++n) EXPECT_LT((f[n] - 2 * once[n]).norm(), kRounding);
}

TEST(AddTraction, GoesByArea) {
    // Two triangles of areas 1 and 3.
    const std::vector<Vec3> x = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {5, 0, 0}, {8, 0, 0}, {5, 2, 0}};
    NodeVectors f(6, Vec3::Zero());
    add_traction(x, {{0, 1, 2}, {3, 4, 5}}, Vec3(0, 0, 12), f);
    for (int n = 0; n < 3; ++n) EXPECT_NEAR(f[n].z(), 1, kRounding);
    for (int n = 3; n < 6; ++n) EXPECT_NEAR(f[n].z(), 3, kRounding);
}

TEST(AddQuadraticTraction, IsTheWholeForceAndActsInTheMiddle) {
    const Floor floor;
    const elasticity::QuadraticMesh mesh = elasticity::quadratic_mesh(floor.mesh);
    // The middles of a face's edges by their ends.
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
    constexpr int kEnds[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    for (const auto& tet : mesh.tets)
        for (int e = 0; e < 6; ++e)
            middle[std::minmax(tet[kEnds[e][0]], tet[kEnds[e][1]])] = tet[4 + e];
    std::vector<std::array<std::int32_t, 6>> triangles;
    for (const Triangle& t : floor.triangles)
        triangles.push_back({t[0], t[1], t[2], middle.at(std::minmax(t[0], t[1])),
                             middle.at(std::minmax(t[1], t[2])),
                             middle.at(std::minmax(t[2], t[0]))});
    const Vec3 total(1, -2, 3);
    NodeVectors f(mesh.points.size(), Vec3::Zero());
    add_quadratic_traction(mesh.points, triangles, total, f);
    const auto [force, torque] = totals(mesh.points, f);
    EXPECT_LT((force - total).norm(), kRounding);
    EXPECT_LT((torque - Vec3(1, 1, 0).cross(total)).norm(), 10 * kRounding);
    for (std::size_t n = 0; n < floor.mesh.points.size(); ++n)
        EXPECT_EQ(f[n], Vec3(Vec3::Zero()));  // nothing at corners
}

TEST(AddTraction, RefusesFacesWithoutArea) {
    const std::vector<Vec3> x = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    NodeVectors f(3, Vec3::Zero());
    EXPECT_THROW(add_traction(x, {}, Vec3::UnitX(), f), InputError);
    EXPECT_THROW(add_traction(x, {{0, 1, 2}}, Vec3::UnitX(), f), InputError);
    EXPECT_THROW(add_quadratic_traction(x, {}, Vec3::UnitX(), f), InputError);
}

}  // namespace
}  // namespace myotet::dynamics
