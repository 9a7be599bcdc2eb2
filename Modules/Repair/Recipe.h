// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "Core/Geometry.h"

namespace myotet::repair {

/// Solids, in mm. Points and directions are the patient's (LPS), or stand in
/// the principal axes of a tissue; see Solid.
struct Sphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
};
struct Ellipsoid {
    Vec3 centre = Vec3::Zero();
    Vec3 semi_axes = Vec3::Ones();
    Mat3 axes = Mat3::Identity();  ///< columns
};
/// A capsule where both radii are equal, else the hull of two balls.
struct Capsule {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    std::array<double, 2> radius{0, 0};
};
/// A cylinder where both radii are equal, else a cone with flat ends.
struct Cone {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    std::array<double, 2> radius{0, 0};
};
struct Cuboid {
    Vec3 centre = Vec3::Zero();
    Vec3 size = Vec3::Ones();      ///< whole side lengths
    Mat3 axes = Mat3::Identity();  ///< columns
};
struct Torus {
    Vec3 centre = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ();
    double ring = 0, tube = 0;  ///< radii
};
struct HalfSpace {
    Vec3 point = Vec3::Zero();     ///< on its plane
    Vec3 outward = Vec3::UnitZ();  ///< unit vector that points away from the solid
};

/// A primitive, and the tissue whose principal axes its coordinates are
/// measured along: from the centroid, first axis longest, each axis pointing
/// where its largest LPS component is positive, but the third, which makes them
/// right-handed. Empty: LPS.
struct Solid {
    std::variant<Sphere, Ellipsoid, Capsule, Cone, Cuboid, Torus, HalfSpace> shape;
    std::string relative_to;
};
/// A closed surface in a file, mm, LPS.
struct SurfaceFile {
    std::filesystem::path file;  ///< as written, beside the recipe where it is relative
    bool heal = false;           ///< close its cracks
};
struct TissueName {
    std::string name;
};
using Operand = std::variant<TissueName, Solid, SurfaceFile>;

/// A tissue that a step makes.
struct NewTissue {
    std::string name;
    std::int32_t label = 0;  ///< 0: the next free value
};

enum class Combination { unite, intersect, subtract };
struct Combine {
    Combination how = Combination::unite;
    std::string tissue;
    Operand with;
    double blend = 0;                     ///< radius of the seam, mm
    std::optional<NewTissue> into;        ///< receives the result, which `tissue` gives away
    std::vector<std::string> takes_from;  ///< tissues that give way
};
/// A new tissue that has the operand's form.
struct Create {
    NewTissue tissue;
    Operand from;
    std::vector<std::string> takes_from;
};
enum class Change { offset, open, close };
struct Reshape {
    Change how = Change::offset;
    std::vector<std::string> tissues;
    double by = 0;  ///< mm; negative shrinks (offset alone)
    std::vector<std::string> takes_from;
};
struct KeepLargest {
    std::vector<std::string> tissues;
    int count = 1;
};
struct DropIslands {
    std::vector<std::string> tissues;
    double under = 0;  ///< mm^3
};
struct FillCavities {
    std::vector<std::string> tissues;
    double under = std::numeric_limits<double>::infinity();  ///< mm^3
    std::vector<std::string> takes_from;
};
struct Clip {
    std::vector<std::string> tissues;
    double margin = 0;  ///< kept free inside the field of view, mm
};
/// How a bridge is laid through the space between tissues.
struct Bridge {
    double within = 0;  ///< its longest length, mm
    /// At its beginning and its end, mm; 0: as thick as the tissue is there.
    std::array<double, 2> radius{0, 0};
    double blend = -1;                    ///< radius of the seam, mm; negative: half its radius
    double clearance = -1;                ///< wished from other tissues; negative: its radius
    std::vector<std::string> takes_from;  ///< tissues it may pass through, which give way
};
struct Join {
    std::string tissue;
    Bridge bridge;
};
struct Grow {
    std::string tissue, until_it_touches;
    Bridge bridge;
    double over = 0;                ///< area that shall touch at least, mm^2
    std::optional<Vec3> from, to;   ///< where to begin and to end, LPS; empty: where nearest
    std::optional<NewTissue> into;  ///< receives what is added
};
/// What lies in two of these tissues is the first one's.
struct Priority {
    std::vector<std::string> tissues;
};

struct Step {
    int number = 0;    ///< from 1
    int line = 0;      ///< in the file
    std::string what;  ///< the step's keyword
    std::variant<Combine, Create, Reshape, KeepLargest, DropIslands, FillCavities, Clip, Join, Grow,
                 Priority>
        task;
};

struct Recipe {
    std::filesystem::path file;
    std::vector<Step> steps;
};

/// Reads and checks a recipe: every key known, every value in its range. What
/// only the scan can tell (names of tissues) is checked by apply().
/// Throws IoError, InputError with the step's number, its line, the value, the
/// rule and the remedy.
[[nodiscard]] Recipe read_recipe(const std::filesystem::path& file);

}  // namespace myotet::repair
