// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "OsimKit.h"
#include "Skeleton/Skeleton.h"

namespace myotet::skeleton {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Of a few products and sums of numbers near 1000.
constexpr double kRounding = 1e-9;

/// The forearm on the upper arm, which is welded to the ground, by a joint of a kind.
SmallModel with_joint(const std::string& kind, const std::vector<std::string>& coordinates) {
    SmallModel small;
    std::string list;
    for (const std::string& name : coordinates)
        list += "<Coordinate name=\"" + name + "\"><range>-9 9</range></Coordinate>";
    small.shoulder =
        "<WeldJoint name=\"shoulder\"><socket_parent_frame>/ground</socket_parent_frame>"
        "<socket_child_frame>/bodyset/upper</socket_child_frame></WeldJoint>";
    small.elbow = "<" + kind +
                  " name=\"it\"><socket_parent_frame>/bodyset/upper</socket_parent_frame>"
                  "<socket_child_frame>/bodyset/forearm</socket_child_frame><coordinates>" +
                  list + "</coordinates></" + kind + ">";
    return small;
}

Pose placed(const SmallModel& small, const std::vector<double>& values) {
    const Model model = read(small);
    Skeleton skeleton(model);
    skeleton.place(values);
    return skeleton.poses()[2];
}

Mat3 turn(double angle, const Vec3& axis) {
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

TEST(OsimJoints, PlainKindsMoveAsTheyAreNamed) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const auto near = [](const Pose& pose, const Mat3& rotation, const Vec3& translation) {
        return (pose.rotation - rotation).norm() < kRounding &&
               (pose.translation - translation).norm() < kRounding;
    };
    EXPECT_TRUE(near(placed(with_joint("WeldJoint", {}), {}), Mat3::Identity(), Vec3::Zero()));
    EXPECT_TRUE(near(placed(with_joint("PinJoint", {"a"}), {0.4}), turn(0.4, z), Vec3::Zero()));
    EXPECT_TRUE(near(placed(with_joint("SliderJoint", {"a"}), {40}), Mat3::Identity(), 40 * x));
    EXPECT_TRUE(near(placed(with_joint("UniversalJoint", {"a", "b"}), {0.4, 0.7}),
                     turn(0.4, x) * turn(0.7, y), Vec3::Zero()));
    for (const char* kind : {"BallJoint", "GimbalJoint"})
        EXPECT_TRUE(near(placed(with_joint(kind, {"a", "b", "c"}), {0.4, 0.7, 0.2}),
                         turn(0.4, x) * turn(0.7, y) * turn(0.2, z), Vec3::Zero()));
    EXPECT_TRUE(near(placed(with_joint("PlanarJoint", {"a", "b", "c"}), {0.4, 7, 2}), turn(0.4, z),
                     Vec3(7, 2, 0)));
    EXPECT_TRUE(near(
        placed(with_joint("FreeJoint", {"a", "b", "c", "d", "e", "f"}), {0.4, 0.7, 0.2, 1, 2, 3}),
        turn(0.4, x) * turn(0.7, y) * turn(0.2, z), Vec3(1, 2, 3)));
}

TEST(OsimJoints, LengthsBecomeMillimetres) {
    const Model model = read(with_joint("PlanarJoint", {"a", "b", "c"}));
    EXPECT_TRUE(model.coordinates[0].rotational);
    EXPECT_FALSE(model.coordinates[1].rotational);
    EXPECT_EQ(model.coordinates[0].highest, 9);
    EXPECT_EQ(model.coordinates[1].highest, 9000);
}

TEST(OsimJoints, FunctionsMoveInOrderOfTheFile) {
    const Model model = read({});
    Skeleton skeleton(model);
    const std::vector<double> values{0.3, 1.0};
    skeleton.place(values);
    // By hand: up 800, turned 0.5 about y, then 0.3 about z; down 300; 5 along x; 1 about z.
    const Mat3 upper = turn(0.5, Vec3::UnitY()) * turn(0.3, Vec3::UnitZ());
    const Vec3 elbow = Vec3(0, 800, 0) + upper * Vec3(5, -300, 0);
    EXPECT_NEAR((skeleton.poses()[1].rotation - upper).norm(), 0, kRounding);
    EXPECT_NEAR((skeleton.poses()[2].translation - elbow).norm(), 0, kRounding);
    EXPECT_NEAR((skeleton.poses()[2].rotation - upper * turn(1, Vec3::UnitZ())).norm(), 0,
                kRounding);
}

// A coordinate in m whose turn is a function of it: f(0.02 m) is f at 20 mm.
TEST(OsimJoints, FunctionsOfLengthsTakeMillimetres) {
    SmallModel small;
    const std::string linear =
        "<LinearFunction name=\"function\"><coefficients>1 0</coefficients></LinearFunction>";
    const auto at = small.elbow_axes.find(linear);
    small.elbow_axes.replace(at, linear.size(),
                             "<PolynomialFunction name=\"function\"><coefficients>100 10 0.5"
                             "</coefficients></PolynomialFunction>");
    const std::string spline =
        "<SimmSpline name=\"function\"><x>0 1 2</x><y>0 0.005 0.004</y></SimmSpline>";
    small.elbow_axes.replace(small.elbow_axes.find(spline), spline.size(), linear);
    const Model model = read(small);
    EXPECT_FALSE(model.coordinates[1].rotational);
    EXPECT_EQ(model.coordinates[1].highest, 2250);
    const Joint& elbow = model.joints[1];
    EXPECT_NEAR(evaluate(elbow.rotations[0].function, 20).value, 0.04 + 0.2 + 0.5, kRounding);
    EXPECT_NEAR(evaluate(elbow.translations[0].function, 20).value, 20, kRounding);
}

TEST(OsimJoints, JointsAreSortedFromTheGround) {
    SmallModel small;
    std::swap(small.shoulder, small.rest);
    small.rest = "";
    const SmallModel usual;
    small.forces = "</objects></ForceSet><JointSet><objects>" + usual.shoulder +
                   "</objects></JointSet><ForceSet><objects>";
    const Model model = read(small);
    ASSERT_EQ(model.joints.size(), 2u);
    EXPECT_EQ(model.joints[0].name, "shoulder");
    EXPECT_EQ(model.joints[1].name, "elbow");
}

TEST(OsimJoints, PrescribedFunctionsAndLocks) {
    SmallModel small;
    small.elbow_coordinates =
        "<Coordinate name=\"flex\"><locked>true</locked><prescribed>true</prescribed>"
        "<LinearFunction name=\"prescribed_function\"><coefficients>2 1</coefficients>"
        "</LinearFunction></Coordinate>";
    const Model model = read(small);
    EXPECT_TRUE(model.coordinates[1].locked);
    ASSERT_TRUE(model.coordinates[1].prescribed);
    EXPECT_EQ(evaluate(*model.coordinates[1].prescribed, 3).value, 7);
    EXPECT_FALSE(model.coordinates[0].prescribed);
}

TEST(OsimJoints, WhatIsNotReadIsRefusedByName) {
    EXPECT_THAT(refusal(with_joint("EllipsoidJoint", {"a"})),
                AllOf(HasSubstr("(<EllipsoidJoint> 'it')"), HasSubstr("use PinJoint")));
    EXPECT_THAT(refusal(with_joint("PinJoint", {})),
                HasSubstr("has 0 coordinates where a PinJoint"));
    EXPECT_THAT(refusal(with_joint("GimbalJoint", {"a", "b", "a"})),
                HasSubstr("two coordinates of this name"));
    SmallModel small;
    small.elbow_sockets += "<reverse>true</reverse>";
    EXPECT_THAT(refusal(small), HasSubstr("reversed joint"));
    small = {};
    small.elbow_sockets = "<socket_child_frame>/bodyset/forearm</socket_child_frame>";
    EXPECT_THAT(refusal(small), HasSubstr("has no <socket_parent_frame>"));
    small = {};
    small.elbow_axes = "";
    EXPECT_THAT(refusal(small), HasSubstr("has 0 axes"));
    small = {};
    small.elbow_coordinates = "<Coordinate name=\"flex\"><range>2 1</range></Coordinate>";
    EXPECT_THAT(refusal(small), HasSubstr("the lower one first"));
    small.elbow_coordinates = "<Coordinate name=\"bend\"/>";
    EXPECT_THAT(refusal(small), HasSubstr("depends on 'flex'"));
    small.elbow_coordinates = "<Coordinate name=\"flex\"><locked>maybe</locked></Coordinate>";
    EXPECT_THAT(refusal(small), HasSubstr("write true or false"));
}

std::string with_axis(const std::string& from, const std::string& to) {
    SmallModel small;
    small.elbow_axes.replace(small.elbow_axes.find(from), from.size(), to);
    return refusal(small);
}

TEST(OsimJoints, WrongAxesAreRefused) {
    EXPECT_THAT(with_axis("<axis>0 0 2</axis>", "<axis>0 1e-9 0</axis>"), HasSubstr("parallel"));
    EXPECT_THAT(with_axis("<axis>0 0 2</axis>", "<axis>0 0 0</axis>"), HasSubstr("length 0"));
    EXPECT_THAT(with_axis("<axis>0 0 2</axis>", "<axis>0 0</axis>"), HasSubstr("2 numbers"));
    EXPECT_THAT(with_axis("rotation2", "rotation4"), HasSubstr("no TransformAxis 'rotation2'"));
    EXPECT_THAT(with_axis("<coordinates>flex", "<coordinates>flex lift"), HasSubstr("only one"));
    EXPECT_THAT(with_axis("<coordinates>flex</coordinates>", ""), HasSubstr("no coordinate"));
    EXPECT_THAT(with_axis("LinearFunction name", "StepFunction name"), HasSubstr("not valid XML"));
}

TEST(OsimJoints, CirclesAndBodiesThatTwoMoveAreRefused) {
    SmallModel small;
    const std::string ground = "/ground</socket_parent>";
    small.shoulder.replace(small.shoulder.find(ground), ground.size(),
                           "/bodyset/forearm</socket_parent>");
    EXPECT_THAT(refusal(small), HasSubstr("in a circle"));
    small = {};
    small.elbow_sockets =
        "<socket_parent_frame>/ground</socket_parent_frame>"
        "<socket_child_frame>/bodyset/upper</socket_child_frame>";
    EXPECT_THAT(refusal(small), HasSubstr("moves 'upper'"));
    small.elbow_sockets =
        "<socket_parent_frame>/bodyset/upper</socket_parent_frame>"
        "<socket_child_frame>/ground</socket_child_frame>";
    EXPECT_THAT(refusal(small), HasSubstr("moves the ground"));
}

}  // namespace
}  // namespace myotet::skeleton
