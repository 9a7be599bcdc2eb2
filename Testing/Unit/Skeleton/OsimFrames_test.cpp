// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/OsimFrames.h"

#include "OsimKit.h"

namespace myotet::skeleton {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kRounding = 1e-12;

std::string frame(const std::string& name, const std::string& parent, const std::string& rest) {
    return "<PhysicalOffsetFrame name=\"" + name + "\"><socket_parent>" + parent +
           "</socket_parent>" + rest + "</PhysicalOffsetFrame>";
}

SmallModel hung_on(const std::string& named, const std::string& frames) {
    SmallModel small;
    small.elbow_sockets = "<socket_parent_frame>" + named +
                          "</socket_parent_frame>"
                          "<socket_child_frame>/bodyset/forearm</socket_child_frame>";
    small.elbow_frames = frames;
    return small;
}

TEST(OsimFrames, FramesOfFramesAddUp) {
    const SmallModel small =
        hung_on("b", frame("a", "/bodyset/upper",
                           "<translation>0 -0.3 0</translation>"
                           "<orientation>0 0 1.5707963267948966</orientation>") +
                         frame("b", "../a", "<translation>0.1 0 0</translation>"));
    const Joint elbow = read(small).joints[1];
    EXPECT_EQ(elbow.parent, 1);
    EXPECT_TRUE(elbow.in_parent.translation.isApprox(Vec3(0, -200, 0), kRounding));
    EXPECT_NEAR(elbow.in_parent.rotation(1, 0), 1, kRounding);
}

TEST(OsimFrames, TurnsAreAboutXThenTheTurnedYThenZ) {
    const Pose pose = pose_of(Vec3(1, 2, 3), Vec3(0.3, 0.5, 0.7));
    const Mat3 expected =
        (Eigen::AngleAxisd(0.3, Vec3::UnitX()) * Eigen::AngleAxisd(0.5, Vec3::UnitY()) *
         Eigen::AngleAxisd(0.7, Vec3::UnitZ()))
            .toRotationMatrix();
    EXPECT_NEAR((pose.rotation - expected).norm(), 0, kRounding);
    EXPECT_EQ(pose.translation, Vec3(1000, 2000, 3000));
}

TEST(OsimFrames, NamesAreFoundAsPathsAndByTheirEnd) {
    for (const char* named : {"/bodyset/upper", "../../bodyset/upper", "upper", "../upper",
                              "/anything/upper", "/jointset/shoulder/../../bodyset/./upper"})
        EXPECT_EQ(read(hung_on(named, "")).joints[1].parent, 1) << named;
    SmallModel small = hung_on("/bodyset/upper/tip", "");
    small.upper_extra =
        "<components>" + frame("tip", "..", "<translation>0 0 1</translation>") + "</components>";
    EXPECT_EQ(read(small).joints[1].in_parent.translation, Vec3(0, 0, 1000));
    small = hung_on("base", "");
    small.rest = "<ComponentSet><objects>" +
                 frame("base", "/bodyset/upper", "<translation>0 1 0</translation>") +
                 "</objects></ComponentSet>";
    EXPECT_EQ(read(small).joints[1].in_parent.translation, Vec3(0, 1000, 0));
}

TEST(OsimFrames, WrongOnesAreRefused) {
    EXPECT_THAT(refusal(hung_on("uper", "")),
                AllOf(HasSubstr("names 'uper'"), HasSubstr("no such body or frame")));
    EXPECT_THAT(refusal(hung_on("", "")), HasSubstr("names no body"));
    EXPECT_THAT(refusal(hung_on("a", frame("a", "../b", "") + frame("b", "../a", ""))),
                HasSubstr("in a circle"));
    EXPECT_THAT(refusal(hung_on("a", frame("a", "", ""))), HasSubstr("names no body"));
    SmallModel small = hung_on("tip", "");
    small.upper_extra = "<components>" + frame("tip", "..", "") + "</components>";
    small.ground = small.upper_extra;
    EXPECT_THAT(refusal(small), HasSubstr("which may be /ground/tip or /bodyset/upper/tip"));
}

}  // namespace
}  // namespace myotet::skeleton
