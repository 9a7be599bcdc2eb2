// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/ReadOsim.h"

#include <filesystem>

#include "OsimKit.h"

namespace myotet::skeleton {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Of numbers that were multiplied by powers of ten.
constexpr double kRounding = 1e-12;

TEST(ReadOsim, BodiesAndGravityInTheHousesUnits) {
    const Model model = read({});
    EXPECT_EQ(model.name, "small");
    EXPECT_NEAR(model.gravity.y(), -9800, kRounding);
    ASSERT_EQ(model.bodies.size(), 3u);
    EXPECT_EQ(model.bodies[0].name, "ground");
    EXPECT_EQ(model.bodies[1].name, "upper");
    EXPECT_NEAR(model.bodies[1].mass, 1.5e-3, kRounding);
    EXPECT_TRUE(model.bodies[1].mass_center.isApprox(Vec3(0, -150, 0), kRounding));
    EXPECT_NEAR(model.bodies[2].inertia(2, 2), 20.5, kRounding);
    EXPECT_THAT(model.notes, IsEmpty());
}

// The same model as version 3 writes it: joints in bodies, inertia in pieces.
const std::string kVersion3 =
    "<OpenSimDocument Version=\"30000\"><Model name=\"small\"><gravity> 0 -9.8 0</gravity>"
    "<BodySet><objects><Body name=\"ground\"><Joint/></Body><Body name=\"upper\"><mass>1.5</mass>"
    "<mass_center> 0 -0.15 0</mass_center><inertia_xx>0.01</inertia_xx>"
    "<inertia_yy>0.002</inertia_yy><inertia_zz>0.01</inertia_zz><Joint>"
    "<PinJoint name=\"shoulder\"><parent_body>ground</parent_body>"
    "<location_in_parent>0 0.8 0</location_in_parent>"
    "<orientation_in_parent>0 0.5 0</orientation_in_parent><location>0 0 0</location>"
    "<CoordinateSet><objects><Coordinate name=\"lift\"><motion_type>rotational</motion_type>"
    "<default_value>0.25</default_value><range>-1.5 3</range></Coordinate></objects><groups/>"
    "</CoordinateSet><reverse>false</reverse></PinJoint></Joint></Body>"
    "<Body name=\"forearm\"><mass>2</mass><mass_center>0 -0.1 0</mass_center>"
    "<inertia_xx>0.02</inertia_xx><inertia_yy>0.001</inertia_yy><inertia_zz>0.0205</inertia_zz>"
    "<Joint><CustomJoint name=\"elbow\"><parent_body> upper </parent_body>"
    "<location_in_parent>0 -0.3 0</location_in_parent><CoordinateSet><objects>"
    "<Coordinate name=\"flex\"><range>0 2.25</range></Coordinate></objects></CoordinateSet>"
    "<SpatialTransform><TransformAxis name=\"translation1\"><coordinates>flex</coordinates>"
    "<axis>1 0 0</axis><function><NaturalCubicSpline><x>0 1 2</x><y>0 0.005 0.004</y>"
    "</NaturalCubicSpline></function></TransformAxis><TransformAxis name=\"rotation1\">"
    "<coordinates>flex</coordinates><axis>0 0 1</axis></TransformAxis>"
    "<TransformAxis name=\"rotation2\"><axis>0 1 0</axis></TransformAxis>"
    "<TransformAxis name=\"rotation3\"><axis>1 0 0</axis></TransformAxis>"
    "<TransformAxis name=\"translation2\"/><TransformAxis name=\"translation3\"/>"
    "</SpatialTransform></CustomJoint></Joint></Body></objects></BodySet></Model>"
    "</OpenSimDocument>";

TEST(ReadOsim, Version3MeansTheSame) {
    const Model new_one = read({}), old = read_text(kVersion3);
    ASSERT_EQ(old.bodies.size(), new_one.bodies.size());
    for (std::size_t b = 0; b < old.bodies.size(); ++b) {
        EXPECT_EQ(old.bodies[b].name, new_one.bodies[b].name);
        EXPECT_EQ(old.bodies[b].mass, new_one.bodies[b].mass);
        EXPECT_EQ(old.bodies[b].inertia, new_one.bodies[b].inertia);
    }
    ASSERT_EQ(old.joints.size(), 2u);
    for (std::size_t j = 0; j < 2; ++j) {
        const Joint &a = old.joints[j], &b = new_one.joints[j];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.parent, b.parent);
        EXPECT_EQ(a.child, b.child);
        EXPECT_EQ(a.in_parent.rotation, b.in_parent.rotation);
        EXPECT_EQ(a.in_parent.translation, b.in_parent.translation);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(a.rotations[i].axis, b.rotations[i].axis);
            EXPECT_EQ(a.rotations[i].coordinate, b.rotations[i].coordinate);
            EXPECT_EQ(evaluate(a.translations[i].function, 0.7).value,
                      evaluate(b.translations[i].function, 0.7).value);
        }
    }
    EXPECT_EQ(old.coordinates[0].at_rest, new_one.coordinates[0].at_rest);
    EXPECT_EQ(old.coordinates[1].highest, new_one.coordinates[1].highest);
}

TEST(ReadOsim, WhatActsAndIsNotReadIsNoted) {
    SmallModel small;
    small.forces =
        "<CoordinateLimitForce name=\"stop\"/><CoordinateLimitForce name=\"stop2\"/>"
        "<BushingForce name=\"off\"><isDisabled>true</isDisabled></BushingForce>"
        "<BushingForce name=\"off4\"><appliesForce>false</appliesForce></BushingForce>";
    small.rest =
        "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"pair\"/>"
        "<PointConstraint name=\"no\"><isEnforced>false</isEnforced></PointConstraint>"
        "</objects></ConstraintSet><MarkerSet><objects><Marker name=\"m\"/></objects></MarkerSet>"
        "<components><PhysicalOffsetFrame name=\"f\"><socket_parent>/ground</socket_parent>"
        "</PhysicalOffsetFrame></components>";
    EXPECT_THAT(read(small).notes,
                ElementsAre("1 CoordinateCouplerConstraint is not taken into account: pair",
                            "2 CoordinateLimitForce are not taken into account: stop, stop2"));
}

TEST(ReadOsim, DefaultsOfAKindAreItsOwnWhereItSaysNothing) {
    SmallModel small;
    small.rest =
        "<defaults><Coordinate name=\"default\"><default_value>0.5</default_value>"
        "<locked>true</locked></Coordinate></defaults>";
    const Model model = read(small);
    EXPECT_EQ(model.coordinates[0].at_rest, 0.25);
    EXPECT_EQ(model.coordinates[1].at_rest, 0.5);
    EXPECT_TRUE(model.coordinates[1].locked);
}

TEST(ReadOsim, WrongBodiesAreRefusedWithTheirLine) {
    SmallModel small;
    small.forearm_mass = "<mass>-2</mass>";
    EXPECT_THAT(refusal(small), AllOf(HasSubstr(":8: (<Body> 'forearm')"), HasSubstr("-2")));
    small.forearm_mass = "<mass>two</mass>";
    EXPECT_THAT(refusal(small), HasSubstr("'two' where a number should stand"));
    small.forearm_mass = "<mass>nan</mass>";
    EXPECT_THAT(refusal(small), HasSubstr("nan"));
    small.forearm_mass = "<mass>1e999</mass>";
    EXPECT_THAT(refusal(small), HasSubstr("1e999"));
    small.forearm_mass = "<mass></mass>";
    EXPECT_THAT(refusal(small), HasSubstr("holds 0 numbers where 1 belong"));
    small.forearm_mass = "<mass>1</mass><inertia>1 2 3</inertia>";
    EXPECT_THAT(refusal(small), HasSubstr("holds 3 numbers where 6 belong"));
    small.forearm_mass = "<mass>1</mass><mass_center>0 inf 0</mass_center>";
    EXPECT_THAT(refusal(small), HasSubstr("must be finite"));
    small.forearm_mass = "</Body><Body name=\"upper\">";
    EXPECT_THAT(refusal(small), HasSubstr("two of this name (/bodyset/upper)"));
    small.forearm_mass = "</Body><Body>";
    EXPECT_THAT(refusal(small), HasSubstr("has no name"));
    small.forearm_mass = "</Body><Body name=\"loose\">";
    EXPECT_THAT(refusal(small), HasSubstr("no joint that moves the body 'loose'"));
}

TEST(ReadOsim, FilesThatAreNoModelAreRefused) {
    EXPECT_THAT(refusal_of_text("<OpenSimDocument><ScaleTool/></OpenSimDocument>"),
                HasSubstr("holds no <Model>"));
    EXPECT_THAT(refusal_of_text("name,value\n1,2\n"), HasSubstr("is not valid XML"));
    EXPECT_THAT(refusal_of_text(""), HasSubstr("is not valid XML"));
    EXPECT_THROW((void)read_osim("/nowhere/x.osim"), IoError);
}

// One arm in three versions: the bodies weigh the same, and so many muscles pull.
TEST(ReadOsim, ModelsOfOpenSimAreRead) {
    const std::filesystem::path data = std::filesystem::path(MYOTET_SHARED_DIR) / "data/opensim";
    for (const char* name :
         {"models/Arm26/arm26.osim", "core/Applications/Analyze/tests/resources/arm26.osim",
          "core/Applications/ID/tests/resources/arm26.osim"}) {
        if (!std::filesystem::exists(data / name)) GTEST_SKIP() << data / name << " is absent";
        const Model model = read_osim(data / name);
        EXPECT_EQ(model.muscles.size(), 6u) << name;
        EXPECT_EQ(model.wrap_objects.size(), 4u);
        EXPECT_THAT(model.notes, IsEmpty());
        ASSERT_EQ(model.coordinates.size(), 2u);
        EXPECT_EQ(model.coordinates[1].name, "r_elbow_flex");
        EXPECT_NEAR(model.coordinates[1].highest, 2.268928, 1e-6);
        EXPECT_NEAR(model.bodies.back().mass, 1.534315e-3, kRounding);
        EXPECT_EQ(model.muscles[3].name, "BIClong");
        EXPECT_EQ(model.muscles[3].points.size(), 9u);
        EXPECT_NEAR(model.muscles[3].tendon_slack_length, 272.3, 1e-9);
        ASSERT_EQ(model.muscles[3].wraps.size(), 1u);
        EXPECT_EQ(model.muscles[3].wraps[0].first, 1);
        EXPECT_EQ(model.muscles[3].wraps[0].last, 2);
        EXPECT_NEAR(model.muscles[3].shape.at("FmaxTendonStrain"), 0.033, kRounding);
    }
}

}  // namespace
}  // namespace myotet::skeleton
