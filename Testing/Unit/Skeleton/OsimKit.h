// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "Core/Errors.h"
#include "Skeleton/ReadOsim.h"
#include "Support/TemporaryFolder.h"

namespace myotet::skeleton {

/// The parts of a small model in a file of version 4: an upper arm that a pin moves, and a
/// forearm that hangs on it by a joint with functions.
struct SmallModel {
    std::string ground = "";
    std::string upper_extra = "";
    std::string forearm_mass =
        "<mass>2</mass><mass_center>0 -0.1 0</mass_center>"
        "<inertia>0.02 0.001 0.0205 0 0 0</inertia>";
    std::string shoulder =
        "<PinJoint name=\"shoulder\"><socket_parent_frame>ground_offset</socket_parent_frame>"
        "<socket_child_frame>/bodyset/upper</socket_child_frame><coordinates>"
        "<Coordinate name=\"lift\"><default_value>0.25</default_value><range>-1.5 3</range>"
        "</Coordinate></coordinates><frames><PhysicalOffsetFrame name=\"ground_offset\">"
        "<socket_parent>/ground</socket_parent><translation>0 0.8 0</translation>"
        "<orientation>0 0.5 0</orientation></PhysicalOffsetFrame></frames></PinJoint>";
    std::string elbow_coordinates = "<Coordinate name=\"flex\"><range>0 2.25</range></Coordinate>";
    std::string elbow_axes =
        "<TransformAxis name=\"rotation1\"><coordinates>flex</coordinates><axis>0 0 2</axis>"
        "<LinearFunction name=\"function\"><coefficients>1 0</coefficients></LinearFunction>"
        "</TransformAxis>"
        "<TransformAxis name=\"rotation2\"><coordinates/><axis>0 1 0</axis>"
        "<Constant name=\"function\"><value>0</value></Constant></TransformAxis>"
        "<TransformAxis name=\"rotation3\"><axis>1 0 0</axis></TransformAxis>"
        "<TransformAxis name=\"translation1\"><coordinates>flex</coordinates><axis>1 0 0</axis>"
        "<SimmSpline name=\"function\"><x>0 1 2</x><y>0 0.005 0.004</y></SimmSpline>"
        "</TransformAxis>"
        "<TransformAxis name=\"translation2\"><axis>0 1 0</axis></TransformAxis>"
        "<TransformAxis name=\"translation3\"><axis>0 0 1</axis></TransformAxis>";
    std::string elbow_sockets =
        "<socket_parent_frame>upper_offset</socket_parent_frame>"
        "<socket_child_frame>../../bodyset/forearm</socket_child_frame>";
    std::string elbow_frames =
        "<PhysicalOffsetFrame name=\"upper_offset\"><socket_parent>/bodyset/upper"
        "</socket_parent><translation>0 -0.3 0</translation><orientation>0 0 0</orientation>"
        "</PhysicalOffsetFrame>";
    std::string elbow = "";  ///< in place of the joint of the parts above
    std::string forces = "";
    std::string rest = "";

    [[nodiscard]] std::string text() const {
        const std::string functions =
            "<CustomJoint name=\"elbow\">" + elbow_sockets + "<coordinates>" + elbow_coordinates +
            "</coordinates><frames>" + elbow_frames + "</frames><SpatialTransform>" + elbow_axes +
            "</SpatialTransform></CustomJoint>";
        return "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n"
               "<OpenSimDocument Version=\"40000\">\n<Model name=\"small\">\n"
               "<gravity>0 -9.8 0</gravity>\n"
               "<Ground name=\"ground\">" +
               ground +
               "</Ground>\n<BodySet><objects>\n"
               "<Body name=\"upper\"><mass>1.5</mass><mass_center>0 -0.15 0</mass_center>"
               "<inertia>0.01 0.002 0.01 0 0 0</inertia>" +
               upper_extra + "</Body>\n<Body name=\"forearm\">" + forearm_mass +
               "</Body>\n</objects></BodySet>\n<JointSet><objects>\n" + shoulder + "\n" +
               (elbow.empty() ? functions : elbow) +
               "\n</objects></JointSet>\n<ForceSet><objects>\n" + forces +
               "</objects></ForceSet>\n" + rest + "</Model>\n</OpenSimDocument>\n";
    }
};

inline Model read_text(const std::string& text) {
    const myotet::testing::TemporaryFolder folder;
    myotet::testing::write_bytes(folder / "small.osim", text);
    return read_osim(folder / "small.osim");
}
inline Model read(const SmallModel& small) { return read_text(small.text()); }

inline std::string refusal_of_text(const std::string& text) {
    try {
        (void)read_text(text);
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("small.osim:"));
        return error.what();
    }
    return "no refusal";
}
inline std::string refusal(const SmallModel& small) { return refusal_of_text(small.text()); }

}  // namespace myotet::skeleton
