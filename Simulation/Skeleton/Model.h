// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "Core/Geometry.h"
#include "Skeleton/Function.h"

namespace myotet::skeleton {

/// A rigid body. Body 0 of a model is the ground, whose mass does not matter.
struct Body {
    std::string name;
    double mass = 0;                  ///< t
    Vec3 mass_center = Vec3::Zero();  ///< in the body's frame, mm
    Mat3 inertia = Mat3::Zero();      ///< about mass_center, axes of the body, t mm^2
};

/// A generalized coordinate: an angle, rad, or a length, mm.
struct Coordinate {
    std::string name;
    bool rotational = true;
    double at_rest = 0;                                        ///< its default value
    double lowest = -std::numeric_limits<double>::infinity();  ///< of its range
    double highest = std::numeric_limits<double>::infinity();
    bool locked = false;                 ///< keeps its default value
    std::optional<Function> prescribed;  ///< of time, s
};

/// A turn about, or a shift along, an axis by a function of one coordinate.
struct Freedom {
    Vec3 axis = Vec3::UnitX();  ///< unit; of turns: in the frame that the turns before made
    Function function = constant_function(0);
    int coordinate = -1;  ///< of the model; -1: the function is a constant's
};

/// How a body moves in another: in the parent's joint frame, shifted along three fixed
/// axes, then turned about three axes, one after the other, each in the turned frame.
/// Pins, welds and sliders are such joints too.
struct Joint {
    std::string name;
    int parent = 0, child = 0;  ///< bodies
    Pose in_parent, in_child;   ///< the joint's frame in each body
    std::array<Freedom, 3> rotations{Freedom{Vec3::UnitX()}, Freedom{Vec3::UnitY()},
                                     Freedom{Vec3::UnitZ()}};
    std::array<Freedom, 3> translations{Freedom{Vec3::UnitX()}, Freedom{Vec3::UnitY()},
                                        Freedom{Vec3::UnitZ()}};
};

/// A point that a muscle passes through.
struct PathPoint {
    std::string name;
    int body = 0;
    Vec3 location = Vec3::Zero();  ///< in the body's frame, mm
    /// It is there only while a coordinate is within a range.
    struct Condition {
        int coordinate = 0;
        double lowest = 0, highest = 0;
    };
    std::optional<Condition> condition;
    /// Its location moves with coordinates, an axis each; none: `location`.
    struct Moving {
        int coordinate = -1;  ///< -1: a constant
        Function location;    ///< mm
    };
    std::optional<std::array<Moving, 3>> moving;
};

/// What a muscle wraps around, centred at the origin of its frame.
enum class WrapShape {
    sphere,     ///< size[0]: radius
    cylinder,   ///< about z; size[0]: radius, size[1]: length
    ellipsoid,  ///< size: the three half axes
    torus,      ///< about z; size[0]: of the hole, size[1]: of the whole, both radii in its plane
};

/// The half of a wrap object that a muscle may touch: where the coordinate `axis` of its
/// frame has the sign; 0: anywhere.
struct Quadrant {
    int axis = 0;
    int sign = 0;
};

struct WrapObject {
    std::string name;
    int body = 0;
    WrapShape shape = WrapShape::sphere;
    std::array<double, 3> size{};  ///< mm
    Pose in_body;
    Quadrant quadrant;
    bool active = true;
};

/// A muscle's wrapping around an object.
struct PathWrap {
    int object = 0;
    /// Between these points of the path, counted from 0; -1: from the first, to the last.
    int first = -1, last = -1;
};

/// A muscle with its tendon, as its file tells it.
struct Muscle {
    std::string name;
    std::string type;                  ///< such as Thelen2003Muscle
    std::vector<PathPoint> points;     ///< at least two, from origin to insertion
    std::vector<PathWrap> wraps;       ///< in order of the file
    double max_isometric_force = 0;    ///< N
    double optimal_fibre_length = 0;   ///< mm
    double tendon_slack_length = 0;    ///< mm
    double pennation = 0;              ///< at optimal fibre length, rad
    double max_speed = 10;             ///< of shortening, optimal fibre lengths / s
    double rise = 0.015, fall = 0.05;  ///< time constants of activation, s
    double lowest_activation = 0.01, highest_activation = 1;
    bool rigid_tendon = false;  ///< the file asks for its tendon not to stretch
    bool disabled = false;
    /// Numbers without unit that belong to its type, named as in the file, those of a
    /// curve as `curve/number`.
    std::map<std::string, double> shape;
};

/// A skeleton with muscles. Lengths mm, masses t, forces N, angles rad, whatever its file
/// used. Joints stand so that a body's parent comes before it.
struct Model {
    std::string name;
    Vec3 gravity{0, 0, 0};  ///< mm/s^2
    std::vector<Body> bodies;
    std::vector<Joint> joints;  ///< one a body but the ground
    std::vector<Coordinate> coordinates;
    std::vector<WrapObject> wrap_objects;
    std::vector<Muscle> muscles;
    /// A sentence for each thing of the file that is not taken into account.
    std::vector<std::string> notes;
};

}  // namespace myotet::skeleton
