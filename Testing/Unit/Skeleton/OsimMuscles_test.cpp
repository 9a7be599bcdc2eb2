// SPDX-License-Identifier: Apache-2.0
#include "OsimKit.h"

namespace myotet::skeleton {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kRounding = 1e-9;

const std::string kPoints =
    "<PathPoint name=\"p1\"><socket_parent_frame>/ground</socket_parent_frame>"
    "<location>0.01 0.7 0</location></PathPoint>"
    "<PathPoint name=\"p2\"><socket_parent_frame>/bodyset/upper</socket_parent_frame>"
    "<location>0.02 -0.1 0</location></PathPoint>"
    "<PathPoint name=\"p3\"><socket_parent_frame>/bodyset/forearm</socket_parent_frame>"
    "<location>0.03 -0.05 0</location></PathPoint>";

std::string muscle(const std::string& points, const std::string& wraps, const std::string& rest,
                   const std::string& kind = "Thelen2003Muscle") {
    return "<" + kind + " name=\"flexor\"><GeometryPath name=\"path\"><PathPointSet><objects>" +
           points + "</objects></PathPointSet><PathWrapSet><objects>" + wraps +
           "</objects></PathWrapSet></GeometryPath>" + rest + "</" + kind + ">\n";
}
SmallModel with(const std::string& forces) {
    SmallModel small;
    small.forces = forces;
    small.upper_extra =
        "<WrapObjectSet><objects><WrapCylinder name=\"bone\"><xyz_body_rotation>0.1 0.2 0.3"
        "</xyz_body_rotation><translation>0 -0.2 0</translation><quadrant>-y</quadrant>"
        "<radius>0.016</radius><length>0.05</length></WrapCylinder></objects></WrapObjectSet>";
    return small;
}
std::string path_wrap(const std::string& object, const std::string& range) {
    return "<PathWrap name=\"w\"><wrap_object>" + object + "</wrap_object><range>" + range +
           "</range></PathWrap>";
}

TEST(OsimMuscles, NumbersAndPoints) {
    const Model model = read(with(muscle(
        kPoints, path_wrap("bone", "-1 -1") + path_wrap("bone", "2 3"),
        "<max_isometric_force>800</max_isometric_force><optimal_fiber_length>0.13"
        "</optimal_fiber_length><tendon_slack_length>0.14</tendon_slack_length>"
        "<pennation_angle_at_optimal>0.2</pennation_angle_at_optimal>"
        "<max_contraction_velocity>12</max_contraction_velocity><activation_time_constant>0.01"
        "</activation_time_constant><FmaxTendonStrain>0.033</FmaxTendonStrain><Af>0.3</Af>"
        "<min_control>0.02</min_control><ignore_tendon_compliance>true"
        "</ignore_tendon_compliance>")));
    ASSERT_EQ(model.muscles.size(), 1u);
    const Muscle& m = model.muscles[0];
    EXPECT_EQ(m.name, "flexor");
    EXPECT_EQ(m.type, "Thelen2003Muscle");
    EXPECT_EQ(m.max_isometric_force, 800);
    EXPECT_NEAR(m.optimal_fibre_length, 130, kRounding);
    EXPECT_NEAR(m.tendon_slack_length, 140, kRounding);
    EXPECT_EQ(m.pennation, 0.2);
    EXPECT_EQ(m.max_speed, 12);
    EXPECT_EQ(m.rise, 0.01);
    EXPECT_EQ(m.fall, 0.05);
    EXPECT_EQ(m.lowest_activation, 0.02);
    EXPECT_TRUE(m.rigid_tendon);
    EXPECT_FALSE(m.disabled);
    EXPECT_THAT(m.shape,
                ElementsAre(std::pair<const std::string, double>("Af", 0.3),
                            std::pair<const std::string, double>("FmaxTendonStrain", 0.033)));
    ASSERT_EQ(m.points.size(), 3u);
    EXPECT_EQ(m.points[2].body, 2);
    EXPECT_TRUE(m.points[2].location.isApprox(Vec3(30, -50, 0), kRounding));
    ASSERT_EQ(m.wraps.size(), 2u);
    EXPECT_EQ(m.wraps[0].first, -1);
    EXPECT_EQ(m.wraps[1].first, 1);
    EXPECT_EQ(m.wraps[1].last, 2);
}

TEST(OsimMuscles, TypesKeepTheirOwnNumbersAndDefaults) {
    SmallModel small =
        with(muscle(kPoints, "",
                    "<fiber_damping>0.1</fiber_damping><appliesForce>false</appliesForce>"
                    "<ActiveForceLengthCurve name=\"c\"><min_norm_active_fiber_length>0.47"
                    "</min_norm_active_fiber_length></ActiveForceLengthCurve>",
                    "Millard2012EquilibriumMuscle"));
    small.rest =
        "<defaults><Millard2012EquilibriumMuscle name=\"default\"><max_isometric_force>50"
        "</max_isometric_force><ActiveForceLengthCurve><max_norm_active_fiber_length>1.8"
        "</max_norm_active_fiber_length></ActiveForceLengthCurve></Millard2012EquilibriumMuscle>"
        "</defaults>";
    const Muscle m = read(small).muscles.at(0);
    EXPECT_EQ(m.max_isometric_force, 50);
    EXPECT_EQ(m.rise, 0.01);
    EXPECT_EQ(m.fall, 0.04);
    EXPECT_TRUE(m.disabled);
    EXPECT_EQ(m.shape.at("fiber_damping"), 0.1);
    EXPECT_EQ(m.shape.at("ActiveForceLengthCurve/min_norm_active_fiber_length"), 0.47);
    EXPECT_EQ(m.shape.at("ActiveForceLengthCurve/max_norm_active_fiber_length"), 1.8);
    EXPECT_TRUE(read(with(muscle(kPoints, "", "", "RigidTendonMuscle"))).muscles[0].rigid_tendon);
}

TEST(OsimMuscles, OlderFilesNameThingsOtherwise) {
    const std::string old =
        "<Schutte1993Muscle_Deprecated name=\"flexor\"><MusclePointSet><objects>"
        "<MusclePoint name=\"a\"><location>0 0.1 0</location><body>ground</body></MusclePoint>"
        "<MuscleViaPoint name=\"b\"><location>0 0 0</location><body>upper</body>"
        "<coordinate>flex</coordinate><range>0.5 2</range></MuscleViaPoint>"
        "</objects></MusclePointSet><MuscleWrapSet><objects><MuscleWrap><wrap_object>bone"
        "</wrap_object><range>-1 -1</range></MuscleWrap></objects></MuscleWrapSet>"
        "<pennation_angle>0.1</pennation_angle><Vmax>8</Vmax><time_scale>0.1</time_scale>"
        "</Schutte1993Muscle_Deprecated>";
    const Muscle m = read(with(old)).muscles.at(0);
    EXPECT_EQ(m.points.size(), 2u);
    ASSERT_TRUE(m.points[1].condition);
    EXPECT_EQ(m.points[1].condition->coordinate, 1);
    EXPECT_EQ(m.points[1].condition->highest, 2);
    EXPECT_EQ(m.wraps.size(), 1u);
    EXPECT_EQ(m.pennation, 0.1);
    EXPECT_EQ(m.max_speed, 8);
    EXPECT_EQ(m.shape.at("time_scale"), 0.1);
}

TEST(OsimMuscles, PointsThatMove) {
    const std::string moving =
        "<MovingPathPoint name=\"m\"><socket_parent_frame>/bodyset/forearm</socket_parent_frame>"
        "<socket_x_coordinate>/jointset/elbow/flex</socket_x_coordinate>"
        "<LinearFunction name=\"x_location\"><coefficients>0.01 0.02</coefficients>"
        "</LinearFunction>"
        "<y_location><Constant><value>-0.03</value></Constant></y_location>"
        "<MultiplierFunction name=\"z_location\"><function><SimmSpline name=\"function\">"
        "<x>0 1</x><y>0 0.01</y></SimmSpline></function><scale>2</scale></MultiplierFunction>"
        "<z_coordinate>flex</z_coordinate></MovingPathPoint>";
    const auto point = read(with(muscle(kPoints + moving, "", ""))).muscles.at(0).points.at(3);
    ASSERT_TRUE(point.moving);
    EXPECT_EQ((*point.moving)[0].coordinate, 1);
    EXPECT_EQ((*point.moving)[1].coordinate, -1);
    EXPECT_NEAR(evaluate((*point.moving)[0].location, 0.5).value, 25, kRounding);
    EXPECT_NEAR(evaluate((*point.moving)[1].location, 0.5).value, -30, kRounding);
    EXPECT_NEAR(evaluate((*point.moving)[2].location, 0.5).value, 10, kRounding);
}

TEST(OsimMuscles, PointsInOffsetFramesAreInTheirBody) {
    SmallModel small =
        with(muscle(kPoints + "<PathPoint name=\"q\"><socket_parent_frame>/bodyset/upper/tip"
                              "</socket_parent_frame><location>0.1 0 0</location></PathPoint>",
                    "", ""));
    small.upper_extra +=
        "<components><PhysicalOffsetFrame name=\"tip\"><socket_parent>/bodyset/upper"
        "</socket_parent><translation>0 1 0</translation><orientation>0 0 1.5707963267948966"
        "</orientation></PhysicalOffsetFrame></components>";
    const auto point = read(small).muscles.at(0).points.at(3);
    EXPECT_EQ(point.body, 1);
    EXPECT_TRUE(point.location.isApprox(Vec3(0, 1100, 0), kRounding));
}

TEST(OsimMuscles, PathsThatAreNoneOfOursAreNoted) {
    SmallModel small = with(
        "<Thelen2003Muscle name=\"a\"><path><FunctionBasedPath/></path>"
        "</Thelen2003Muscle>");
    const Model model = read(small);
    EXPECT_TRUE(model.muscles.empty());
    EXPECT_THAT(model.notes, ElementsAre("1 Thelen2003Muscle without a GeometryPath is not taken "
                                         "into account: a"));
}

TEST(OsimMuscles, WrongOnesAreRefused) {
    const auto why = [](const std::string& points, const std::string& wraps,
                        const std::string& rest) {
        return refusal(with(muscle(points, wraps, rest)));
    };
    EXPECT_THAT(why("", "", ""), HasSubstr("has 0 points"));
    EXPECT_THAT(why(kPoints, path_wrap("bne", "-1 -1"), ""), HasSubstr("'bne'"));
    for (const char* range : {"3 2", "0 2", "1 4", "1.5 2", "2 2"})
        EXPECT_THAT(why(kPoints, path_wrap("bone", range), ""), HasSubstr("has points 1 to 3"));
    EXPECT_THAT(why(kPoints, path_wrap("bone", "1"), ""), HasSubstr("holds 1 numbers"));
    EXPECT_THAT(why(kPoints, "", "<max_isometric_force>-1</max_isometric_force>"),
                HasSubstr("is -1, but must be at least 0"));
    EXPECT_THAT(why(kPoints, "", "<optimal_fiber_length>0</optimal_fiber_length>"),
                HasSubstr("(<optimal_fiber_length>) is 0"));
    EXPECT_THAT(why(kPoints, "", "<min_control>3</min_control>"), HasSubstr("at least 3"));
    EXPECT_THAT(why(kPoints + "<StrangePoint name=\"s\"/>", "", ""), HasSubstr("<StrangePoint>"));
    EXPECT_THAT(why(kPoints + "<PathPoint name=\"s\"><body>upper</body></PathPoint>", "", ""),
                HasSubstr("has no <location>"));
    EXPECT_THAT(
        why(kPoints + "<PathPoint name=\"s\"><location>0 0 0</location></PathPoint>", "", ""),
        HasSubstr("is in no body"));
    EXPECT_THAT(why(kPoints + "<ConditionalPathPoint name=\"c\"><body>upper</body><location>0 0 0"
                              "</location><coordinate>knee</coordinate><range>0 1</range>"
                              "</ConditionalPathPoint>",
                    "", ""),
                AllOf(HasSubstr("'knee'"), HasSubstr("known are flex, lift")));
    EXPECT_THAT(refusal(with(muscle(kPoints, "", "") + muscle(kPoints, "", ""))),
                HasSubstr("two muscles of this name"));
}

}  // namespace
}  // namespace myotet::skeleton
