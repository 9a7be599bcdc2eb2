// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "PathShapes.h"

namespace myotet::skeleton {
namespace {

/// One to three objects of random shape and pose between the ends of a muscle; a fifth of
/// them in quadrants, objects that overlap among them.
Arm random_arm(Dice& dice, int number) {
    Arm arm;
    for (int n = 0; n <= number % 3; ++n) {
        std::vector<WrapObject> shapes{
            sphere(dice.between(3, 20)), cylinder(dice.between(3, 20), 4000),
            ellipsoid(dice.between(5, 30), dice.between(5, 30), dice.between(5, 30)),
            torus(dice.between(20, 30), dice.between(3, 10))};
        WrapObject object = shapes[static_cast<std::size_t>(dice.between(0, 3.999))];
        if (number % 5 == 0)
            object.quadrant = {static_cast<int>(dice.between(0, 2.999)),
                               dice.between(-1, 1) > 0 ? 1 : -1};
        arm.muscle.wraps.push_back({.object = n});
        arm.add_object(object, n, {dice.rotation(), dice.point(25) + Vec3(0, 60.0 * n - 60, 0)});
    }
    arm.muscle.points = {point_on(0, dice.point(40) + Vec3(0, 110, 0)),
                         point_on(2, dice.point(40) - Vec3(0, 110, 0))};
    arm.place(0, 0);
    return arm;
}

TEST(PathStress, PathsKeepOutOfObjectsOrSayWhichTheyDoNot) {
    Dice dice(30);
    int touching = 0, missed = 0, said_inside = 0;
    const int trials = 1500;
    for (int n = 0; n < trials; ++n) {
        SCOPED_TRACE(n);
        const Arm arm = random_arm(dice, n);
        const Path path = arm.find();
        ASSERT_TRUE(std::isfinite(path.length));
        EXPECT_GE(path.length, (path.nodes.back().at - path.nodes.front().at).norm() - 1e-9);
        touching += path.nodes.size() > 2;
        missed += !path.missed.empty();
        said_inside += !path.inside.empty();
        if (path.missed.empty()) expect_outside(arm, path, kSkinDepth);
    }
    EXPECT_GT(touching, trials / 3);
    // Rings whose tube is in the way twice, and objects that overlap.
    EXPECT_LT(missed, trials / 30);
    EXPECT_LT(said_inside, trials / 15);
}

}  // namespace
}  // namespace myotet::skeleton
