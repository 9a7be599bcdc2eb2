// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Contact.h"

#include <limits>

#include "ContactShapes.h"
#include "Core/Errors.h"

namespace myotet::contraction {
namespace {

TEST(Contact, NodesShareTheAreaOfTheSurface) {
    const TetMesh mesh = test::block(3, 2);
    const ContactNodes nodes = contact_nodes(mesh.points, boundary_faces(mesh.tets), {});
    EXPECT_EQ(nodes.node.size(), 64u - 8u);
    EXPECT_TRUE(std::is_sorted(nodes.node.begin(), nodes.node.end()));
    double sum = 0;
    for (const double a : nodes.area) sum += a;
    EXPECT_NEAR(sum, 6 * 36, 216 * test::kRounding);
}

TEST(Contact, NodesLeftOutAreNotThere) {
    const TetMesh mesh = test::block(2, 1);
    const std::vector<std::int32_t> left_out = {0, 5, 13};
    const auto faces = boundary_faces(mesh.tets);
    const ContactNodes all = contact_nodes(mesh.points, faces, {}),
                       some = contact_nodes(mesh.points, faces, left_out);
    EXPECT_EQ(some.node.size(), all.node.size() - 2);  // 13 is in the middle
    for (const std::int32_t n : some.node) EXPECT_TRUE(n != 0 && n != 5);
}

TEST(Contact, PiecesFillAQuadraticTetrahedronAndItsFaces) {
    const TetMesh linear = test::block(2, 1);
    const auto quadratic = elasticity::quadratic_mesh(linear);
    TetMesh pieces{quadratic.points, linear_pieces(quadratic), {}};
    ASSERT_EQ(pieces.tets.size(), 8 * linear.tets.size());
    for (const Tet& t : pieces.tets)
        EXPECT_NEAR(signed_volume(pieces.points[t[0]], pieces.points[t[1]], pieces.points[t[2]],
                                  pieces.points[t[3]]),
                    1.0 / 48, test::kRounding);
    EXPECT_EQ(boundary_faces(pieces.tets).size(), 4 * boundary_faces(linear.tets).size());
}

TEST(Contact, ReportsWhatPresses) {
    const std::vector<ContactTouch> touches = {
        {.area = 1, .press = 0.2, .depth = 0.1, .normal = Vec3::UnitZ()},
        {.area = 3, .press = 0.4, .depth = 0.3, .normal = -Vec3::UnitX()},
        {.area = 5, .press = 0, .depth = 7, .normal = Vec3::UnitX()}};
    const ContactReport report = report_of(touches, 2);
    EXPECT_EQ(report.nodes, 2);
    EXPECT_DOUBLE_EQ(report.area, 4);
    EXPECT_DOUBLE_EQ(report.max_depth, 0.3);
    EXPECT_DOUBLE_EQ(report.mean_depth, 0.25);
    EXPECT_DOUBLE_EQ(report.max_pressure, 0.8);
    EXPECT_DOUBLE_EQ(report.total, 0.4 + 2.4);
    EXPECT_LT((report.force - Vec3(-2.4, 0, 0.4)).norm(), test::kRounding);
}

TEST(Contact, RefusesWhatBreaksARule) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((PenaltyLaw{.stiffness = 0}).validate(), InputError);
    EXPECT_THROW((PenaltyLaw{.stiffness = nan}).validate(), InputError);
    EXPECT_THROW((PenaltyLaw{.gap = -1}).validate(), InputError);
    EXPECT_THROW((PenaltyLaw{.gap = nan}).validate(), InputError);
    const std::vector<Vec3> rest(3, Vec3::Zero());
    EXPECT_THROW((void)contact_nodes(rest, {{0, 1, 3}}, {}), InputError);
    const ContactField floor = test::floor_field();
    EXPECT_THROW((void)gaps_at_rest({{3}, {1}}, rest, floor, 0), InputError);
    EXPECT_THROW((void)gaps_at_rest({{0}, {0}}, rest, floor, 0), InputError);
    EXPECT_THROW((void)gaps_at_rest({{0}, {}}, rest, floor, 0), InputError);
    EXPECT_THROW((void)gaps_at_rest({{0}, {1}}, rest, {}, 0), InputError);
}

}  // namespace
}  // namespace myotet::contraction
