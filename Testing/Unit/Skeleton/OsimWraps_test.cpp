// SPDX-License-Identifier: Apache-2.0
#include "OsimKit.h"

namespace myotet::skeleton {
namespace {

using ::testing::HasSubstr;

constexpr double kRounding = 1e-9;

SmallModel with(const std::string& wraps) {
    SmallModel small;
    small.upper_extra = "<WrapObjectSet><objects>" + wraps + "</objects></WrapObjectSet>";
    return small;
}

TEST(OsimWraps, ShapesAndSizes) {
    SmallModel small = with(
        "<WrapSphere name=\"s\"><radius>0.02</radius><active>false</active></WrapSphere>"
        "<WrapCylinder name=\"c\"><radius>0.02</radius><length>0.1</length></WrapCylinder>"
        "<WrapEllipsoid name=\"e\"><dimensions>0.01 0.02 0.03</dimensions></WrapEllipsoid>"
        "<WrapTorus name=\"t\"><inner_radius>0.01</inner_radius><outer_radius>0.03"
        "</outer_radius></WrapTorus>");
    small.ground =
        "<WrapObjectSet><objects><WrapSphere name=\"g\"><radius>1</radius>"
        "</WrapSphere></objects></WrapObjectSet>";
    const auto objects = read(small).wrap_objects;
    ASSERT_EQ(objects.size(), 5u);
    EXPECT_EQ(objects[0].body, 0);
    EXPECT_EQ(objects[1].body, 1);
    EXPECT_FALSE(objects[1].active);
    EXPECT_EQ(objects[1].shape, WrapShape::sphere);
    EXPECT_NEAR(objects[1].size[0], 20, kRounding);
    EXPECT_EQ(objects[2].shape, WrapShape::cylinder);
    EXPECT_NEAR(objects[2].size[1], 100, kRounding);
    EXPECT_EQ(objects[3].shape, WrapShape::ellipsoid);
    EXPECT_NEAR(objects[3].size[2], 30, kRounding);
    EXPECT_EQ(objects[4].shape, WrapShape::torus);
    EXPECT_NEAR(objects[4].size[0], 20, kRounding);
    EXPECT_NEAR(objects[4].size[1], 40, kRounding);
}

TEST(OsimWraps, PlaceInTheBodyAlsoThroughFrames) {
    SmallModel small;
    small.upper_extra =
        "<components><PhysicalOffsetFrame name=\"f\"><socket_parent>..</socket_parent>"
        "<translation>0 1 0</translation><orientation>0 0 1.5707963267948966</orientation>"
        "<WrapObjectSet><objects><WrapSphere name=\"s\"><radius>1</radius><translation>0.1 0 0"
        "</translation><xyz_body_rotation>0.5 0 0</xyz_body_rotation></WrapSphere></objects>"
        "</WrapObjectSet></PhysicalOffsetFrame></components>";
    const WrapObject object = read(small).wrap_objects.at(0);
    EXPECT_EQ(object.body, 1);
    EXPECT_TRUE(object.in_body.translation.isApprox(Vec3(0, 1100, 0), kRounding));
    // Its y axis: turned by 0.5 about x, then by 90 degrees about z.
    EXPECT_TRUE(
        object.in_body.rotation.col(1).isApprox(Vec3(-std::cos(0.5), 0, std::sin(0.5)), kRounding));
}

TEST(OsimWraps, Quadrants) {
    const auto quadrant = [](const std::string& said) {
        return read(with("<WrapSphere name=\"s\"><radius>1</radius><quadrant>" + said +
                         "</quadrant></WrapSphere>"))
            .wrap_objects.at(0)
            .quadrant;
    };
    for (const char* all : {"all", "All", " "}) EXPECT_EQ(quadrant(all).sign, 0);
    EXPECT_EQ(quadrant("x").axis, 0);
    EXPECT_EQ(quadrant("+x").sign, 1);
    EXPECT_EQ(quadrant("-y").axis, 1);
    EXPECT_EQ(quadrant("-y").sign, -1);
    EXPECT_EQ(quadrant("Z").axis, 2);
}

TEST(OsimWraps, WrongOnesAreRefused) {
    const auto why = [](const std::string& wrap) { return refusal(with(wrap)); };
    EXPECT_THAT(why("<WrapDouble name=\"d\"/>"), HasSubstr("(<WrapDouble> 'd')"));
    EXPECT_THAT(why("<WrapSphere name=\"s\"/>"), HasSubstr("has no <radius>"));
    EXPECT_THAT(why("<WrapSphere name=\"s\"><radius>-1</radius></WrapSphere>"),
                HasSubstr("radius -1 m"));
    EXPECT_THAT(why("<WrapEllipsoid name=\"e\"><dimensions>1 0 1</dimensions></WrapEllipsoid>"),
                HasSubstr("half axis"));
    EXPECT_THAT(why("<WrapTorus name=\"t\"><inner_radius>2</inner_radius><outer_radius>1"
                    "</outer_radius></WrapTorus>"),
                HasSubstr("not more than the inner"));
    EXPECT_THAT(why("<WrapSphere name=\"s\"><radius>1</radius><quadrant>w</quadrant></WrapSphere>"),
                HasSubstr("write all, x, -x"));
}

}  // namespace
}  // namespace myotet::skeleton
