// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Path.h"

#include "PathShapes.h"

namespace myotet::skeleton {
namespace {

// Central differences over this step err by its square times the third derivative, of
// 1000 mm, and by lengths' rounding of 1e-12 mm over it.
constexpr double kStep = 1e-5, kDifference = 2e-6;
// Taut paths of the same ends are found to this, mm.
constexpr double kSame = 1e-9;

const Pose kBeside{Eigen::AngleAxisd(0.3, Vec3(1, 2, 0.5).normalized()).toRotationMatrix(),
                   Vec3{2, -3, 4}};

/// A muscle over one object at the hinge.
Arm over(const WrapObject& object) {
    Arm arm;
    arm.add_object(object, 1, kBeside);
    arm.lower_centre = {1, 2, 0};
    arm.lower_hinge = Vec3(0.1, 0.2, 1).normalized();
    arm.muscle.points = {point_on(0, {-20, 90, 10}), point_on(2, {-15, -80, -12})};
    arm.muscle.wraps = {{.object = 0}};
    return arm;
}

std::vector<Arm> single_arms() {
    std::vector<Arm> arms;
    for (const WrapObject& object : convex_objects()) arms.push_back(over(object));
    WrapObject held = cylinder(12, 500);
    held.quadrant = {0, 1};
    arms.push_back(over(held));
    // The ring lies across the way.
    Arm ring = over(torus(30, 8));
    ring.model.wrap_objects[0].in_body = {
        Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()).toRotationMatrix(), {12, 0, 0}};
    arms.push_back(ring);
    return arms;
}

/// Objects on all bodies, a point that moves and one that is only there when bent.
Arm over_many() {
    Arm arm;
    arm.lower_centre = {0, -60, 0};
    arm.hinge = Vec3(0.1, 0, 1).normalized();
    arm.add_object(cylinder(14, 200), 1, Pose{Mat3::Identity(), {0, -60, 0}});
    arm.add_object(ellipsoid(22, 12, 15), 1, Pose{kBeside.rotation, {-2, 0, 0}});
    arm.add_object(sphere(6), 2, Pose{Mat3::Identity(), {-4, -100, 0}});
    PathPoint moving = point_on(2, {});
    const Function place{.kind = FunctionKind::linear, .coefficients = {3, -14}};
    moving.moving = {
        PathPoint::Moving{1, place}, PathPoint::Moving{-1, constant_function(-130)},
        PathPoint::Moving{0, {.kind = FunctionKind::sine, .coefficients = {4, 1, 0, 1}}}};
    arm.muscle.points = {point_on(0, {-10, 70, 5}), point_on(1, {-17, -30, 3}), moving};
    arm.muscle.wraps = {{.object = 0}, {.object = 1}, {.object = 2}};
    return arm;
}

std::vector<Arm> all_arms() {
    std::vector<Arm> arms = single_arms();
    arms.push_back(over_many());
    return arms;
}

/// -150 to 150 degrees and back, the second coordinate along.
std::vector<std::pair<double, double>> sweep(int steps) {
    std::vector<std::pair<double, double>> poses;
    for (int n = 0; n <= 2 * steps; ++n) {
        const double share = static_cast<double>(n <= steps ? n : 2 * steps - n) / steps;
        const double angle = (300 * share - 150) * kPi / 180;
        poses.emplace_back(0.6 * angle, 0.4 * angle);
    }
    return poses;
}

TEST(Path, MomentArmsAreDifferencesOfTheLength) {
    int shape = 0;
    for (Arm& arm : all_arms()) {
        SCOPED_TRACE(shape++);
        PathMemory memory;
        int touching = 0, poses = 0;
        for (const auto& [a, b] : sweep(200)) {
            arm.place(a, b);
            const Path path = arm.find(memory);
            const std::vector<double> rates = arm.rates_of(path);
            const std::vector<double> expected = differences(arm, memory, kStep);
            // At first contact the moment arm has a kink, within a step of it.
            for (int q = 0; q < 2; ++q) EXPECT_NEAR(rates[q], expected[q], kDifference * 10) << a;
            touching += !memory.contacts.empty();
            ++poses;
        }
        EXPECT_GT(touching, 20);
        EXPECT_GT(poses, touching / 2);
    }
}

TEST(Path, LengthFollowsASweepWithoutAJump) {
    int shape = 0;
    for (Arm& arm : all_arms()) {
        SCOPED_TRACE(shape++);
        PathMemory memory;
        const auto poses = sweep(3000);
        double before = 0;
        std::vector<double> rates;
        for (std::size_t n = 0; n < poses.size(); ++n) {
            arm.place(poses[n].first, poses[n].second);
            const Path path = arm.find(memory);
            // The ends move by 150 mm a radian at most.
            const double turned = n > 0 ? std::abs(poses[n].first - poses[n - 1].first) +
                                              std::abs(poses[n].second - poses[n - 1].second)
                                        : 0;
            if (n > 0) {
                EXPECT_LE(std::abs(path.length - before), 150 * turned + kSame) << poses[n].first;
            }
            before = path.length;
            if (n % 50 == 0) expect_outside(arm, path, kSkinDepth);
        }
    }
}

TEST(Path, DoesNotEnterObjectsNorIsShorterThanTheStraightLine) {
    int shape = 0;
    for (Arm& arm : all_arms()) {
        SCOPED_TRACE(shape++);
        for (const auto& [a, b] : sweep(60)) {
            arm.place(a, b);
            const Path path = arm.find();
            expect_outside(arm, path, kSkinDepth);
            double straight = 0, pieces = 0;
            const PathNode* before = nullptr;
            for (const PathNode& node : path.nodes) {
                if (node.around >= 0) pieces += node.curve;
                if (node.point < 0) continue;
                if (before) straight += (node.at - before->at).norm();
                before = &node;
            }
            EXPECT_GE(path.length, straight - kSame);
            const std::vector<Vec3> points = drawn(arm.model, path, arm.bodies, 0.1);
            double chain = 0;
            for (std::size_t n = 1; n < points.size(); ++n)
                chain += (points[n] - points[n - 1]).norm();
            EXPECT_LE(chain, path.length + kSame);
            // Chords of 0.1 mm over a radius of at least 1 mm.
            EXPECT_GE(chain, path.length - pieces * 0.1 * 0.1 / 24 - kSame);
        }
    }
}

TEST(Path, DoesNotDependOnWhereTheGroundIsOrWhichEndIsFirst) {
    Dice dice(20);
    int shape = 0;
    for (Arm& arm : all_arms()) {
        SCOPED_TRACE(shape++);
        for (const auto& [a, b] : sweep(20)) {
            arm.place(a, b);
            const double length = arm.find().length;
            Arm moved = arm;
            const Pose pose{dice.rotation(), dice.point(300)};
            for (Pose& body : moved.bodies) body = pose * body;
            EXPECT_NEAR(moved.find().length, length, kSame);
            Arm turned = arm;
            std::reverse(turned.muscle.points.begin(), turned.muscle.points.end());
            EXPECT_NEAR(turned.find().length, length, kSame);
        }
    }
}

TEST(Path, OverTwoCylindersIsACrossedBelt) {
    // Circles of radius r, R at distance d with a belt that crosses between them.
    Arm arm;
    const double r = 8, R = 15, d = 60;
    arm.add_object(cylinder(r), 0, Pose{Mat3::Identity(), {0, 0, 0}});
    arm.add_object(cylinder(R), 1, Pose{Mat3::Identity(), {d, 0, 0}});
    arm.place(0, 0);
    arm.muscle.wraps = {{.object = 0}, {.object = 1}};
    const Vec3 p{-3, -40, 0}, q{d + 2, 50, 0};
    arm.muscle.points = {point_on(0, p), point_on(1, q)};
    // Over the first from the left and below, under the second: sides as remembered.
    PathMemory memory;
    for (const int wrap : {0, 1}) {
        const WrapObject& object = arm.model.wrap_objects[wrap];
        const Vec3 towards = wrap == 0 ? Vec3{d, 1, 0} : Vec3{-d, -1, 0};
        const Vec3 from = wrap == 0 ? p : Vec3(Vec3(d, 0, 0) - Vec3(d, 0, 0) + towards);
        const Vec3 to = wrap == 0 ? towards : Vec3(q - Vec3(d, 0, 0));
        WrapMemory side;
        side.side = wrap == 0 ? Vec3(-1, 1, 0).normalized() : Vec3(1, -1, 0).normalized();
        const Wrap begun = find_wrap(object, WrapSurface(object), from, to, side);
        ASSERT_EQ(begun.touch, WrapTouch::touching);
        memory.contacts.push_back({wrap, 0, 1, remembered(begun, from, to)});
    }
    const Path path = arm.find(memory);
    ASSERT_EQ(path.nodes.size(), 6u);
    // The crossed tangent: sin(lean) = (r + R) / d.
    const double lean = std::asin((r + R) / d), belt = std::sqrt(d * d - (r + R) * (r + R));
    const auto wrapped = [&](const Vec3& end, double radius) {
        const double far = end.norm();
        const double tangent = std::acos(radius / far);
        // Clockwise from the end's tangent point to that of the belt, seen from the other.
        double arc = std::atan2(end[1], end[0]) - tangent - (kPi / 2 - lean);
        while (arc < 0) arc += 2 * kPi;
        return std::sqrt(far * far - radius * radius) + radius * arc;
    };
    const Vec3 turned = -(q - Vec3(d, 0, 0));  // half a turn about the belt's crossing
    EXPECT_NEAR(path.length, wrapped(p, r) + belt + wrapped(turned, R), kClosedForm * 10);
}

TEST(Path, PointsAreThereWhileTheirConditionHoldsAndMoveWithCoordinates) {
    Arm arm;
    PathPoint via = point_on(1, {10, 0, 0});
    via.condition = {.coordinate = 0, .lowest = -0.1, .highest = 0.5};
    PathPoint end = point_on(2, {});
    end.moving = {PathPoint::Moving{-1, constant_function(5)},
                  PathPoint::Moving{1, {.kind = FunctionKind::linear, .coefficients = {7, -40}}},
                  PathPoint::Moving{-1, constant_function(0)}};
    arm.muscle.points = {point_on(0, {0, 40, 0}), via, end};
    arm.place(0.5, 0.2);
    Path path = arm.find();
    ASSERT_EQ(path.nodes.size(), 3u);
    EXPECT_EQ(path.nodes[1].point, 1);
    EXPECT_LT((path.nodes[2].at - arm.bodies[2]({5, 7 * 0.2 - 40, 0})).norm(), kSame);
    arm.place(0.500001, 0.2);
    path = arm.find();
    ASSERT_EQ(path.nodes.size(), 2u);
    EXPECT_EQ(path.nodes[1].point, 2);
}

TEST(Path, ActsOnlyInItsRangeAndWhileActive) {
    Arm arm = over(sphere(10));
    arm.muscle.points.insert(arm.muscle.points.begin() + 1, point_on(0, {-40, 60, 0}));
    arm.place(0, 0);
    arm.muscle.points.front().location = {2, -90, 3};
    arm.muscle.points[1].location = {3, 80, 4};
    // Both pieces run through the sphere: the first is wrapped.
    Path path = arm.find();
    ASSERT_EQ(path.nodes.size(), 5u);
    EXPECT_EQ(path.nodes[1].around, 0);
    arm.muscle.points.back().location = {4, -80, 2};
    arm.muscle.wraps[0] = {.object = 0, .first = 1, .last = 2};
    path = arm.find();
    ASSERT_EQ(path.nodes.size(), 5u);
    EXPECT_EQ(path.nodes[2].around, 0);
    arm.model.wrap_objects[0].active = false;
    EXPECT_EQ(arm.find().nodes.size(), 3u);
}

TEST(Path, SaysWhichObjectsAnEndLiesInside) {
    Arm arm = over(ellipsoid(35, 20, 20));
    arm.place(0, 0);
    arm.muscle.points.back().location = kBeside({3, 2, 1});
    const Path path = arm.find();
    ASSERT_EQ(path.inside.size(), 1u);
    EXPECT_EQ(path.inside[0], 0);
    EXPECT_EQ(path.nodes.size(), 2u);
    EXPECT_NEAR(path.length, (path.nodes[1].at - path.nodes[0].at).norm(), kSame);
}

}  // namespace
}  // namespace myotet::skeleton
