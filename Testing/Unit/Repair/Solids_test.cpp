// SPDX-License-Identifier: Apache-2.0
#include "Repair/Solids.h"

#include <gtest/gtest.h>

#include "RepairShapes.h"

namespace myotet::repair {
namespace {

constexpr double kRounding = 1e-9;

Frame some_frame() {
    Frame frame;
    frame.rotation = Mat3(Eigen::AngleAxisd(0.8, Vec3(0.2, 1, -0.4).normalized()));
    frame.origin = Vec3(10, -200, 900);
    return frame;
}

const Box kDomain = test::box_around(Vec3::Zero(), 1e3);

TEST(Solids, solids_lie_where_the_patient_s_coordinates_say) {
    const Frame frame = some_frame();
    const Pose pose = patient_pose(frame);
    const Vec3 centre(12, -190, 905), x = Vec3(1, 2, 2) / 3, y = Vec3(2, 1, -2) / 3;
    Mat3 axes;
    axes << x, y, x.cross(y);
    struct Case {
        Solid solid;
        Vec3 on;  ///< a point of the surface, LPS
    };
    const std::vector<Case> cases{
        {{Sphere{centre, 5}, ""}, centre + 5 * y},
        {{Ellipsoid{centre, Vec3(7, 4, 2), axes}, ""}, centre + 7 * x},
        {{Ellipsoid{centre, Vec3(7, 4, 2), axes}, ""}, centre - 4 * y},
        {{Capsule{centre, centre + 10 * x, {3, 3}}, ""}, centre + 5 * x + 3 * y},
        {{Cone{centre, centre + 10 * x, {4, 2}}, ""}, centre + 5 * x - 3 * y},
        {{Cuboid{centre, Vec3(8, 6, 2), axes}, ""}, centre + 4 * x + y},
        {{Torus{centre, x, 9, 2}, ""}, centre + 11 * y},
        {{HalfSpace{centre, x}, ""}, centre + 30 * y},
    };
    for (const Case& c : cases) {
        const PlacedSolid placed = place(c.solid, pose, kDomain);
        EXPECT_NEAR(placed.distance(frame.to_local(c.on)), 0, kRounding);
        // The surface lies in the box.
        const Vec3 local = frame.to_local(c.on);
        EXPECT_TRUE((local.array() >= placed.box.min.array() - kRounding).all());
        EXPECT_TRUE((local.array() <= placed.box.max.array() + kRounding).all());
    }
}

TEST(Solids, principal_axes_point_to_the_patient_s_positive_sides) {
    const Frame frame = some_frame();
    // Long along the lattice's z, less along its x.
    const levelset::Band body = test::bar(Vec3(40, 41, 42), Vec3(8, 5, 20));
    const Pose pose = principal_pose(body, frame);
    EXPECT_LT((pose.origin - Vec3(40, 41, 42)).norm(), 0.01);  // of a sample
    EXPECT_GT(std::abs(pose.rotation.col(0).z()), 0.999);
    EXPECT_GT(std::abs(pose.rotation.col(1).x()), 0.999);
    EXPECT_NEAR(pose.rotation.determinant(), 1, kRounding);
    for (int a = 0; a < 2; ++a) {
        const Vec3 lps = frame.rotation * pose.rotation.col(a);
        EXPECT_GT(lps[std::abs(lps.x()) > std::abs(lps.y())
                          ? (std::abs(lps.x()) > std::abs(lps.z()) ? 0 : 2)
                          : (std::abs(lps.y()) > std::abs(lps.z()) ? 1 : 2)],
                  0);
    }
}

TEST(Solids, a_solid_relative_to_a_tissue_follows_it) {
    // A cut 5 mm along the longest axis, wherever the tissue lies.
    for (const Vec3& centre : {Vec3(40, 40, 40), Vec3(61.4, 33.3, 47.9)}) {
        test::Scene scene = test::make_scene({{"bone", test::bar(centre, Vec3(8, 5, 20))}});
        test::repaired(scene,
                       "  - intersection: bone\n    with: {half_space: {relative_to: bone, point: "
                       "[5, 0, 0], outward: [1, 0, 0]}}\n");
        const double wanted = 16 * 10 * 25;
        EXPECT_NEAR(test::volume_of(scene, "bone"), wanted, test::kEdge * (4 * 25 + 8 * 13));
    }
}

}  // namespace
}  // namespace myotet::repair
