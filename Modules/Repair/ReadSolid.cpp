// SPDX-License-Identifier: Apache-2.0
#include "Repair/ReadSolid.h"

#include <cmath>
#include <functional>
#include <utility>

namespace myotet::repair {
namespace {

constexpr Range kRadiusOrZero = kLengthOrZero;

// Columns from two perpendicular directions; the third follows.
Mat3 read_axes(Fields& fields) {
    if (!fields.has("x_axis") && !fields.has("y_axis")) return Mat3::Identity();
    Mat3 axes;
    axes.col(0) = fields.direction("x_axis");
    axes.col(1) = fields.direction("y_axis");
    constexpr double kPerpendicular = 1e-3;  // cosine: numbers written with three digits
    if (!(std::abs(axes.col(0).dot(axes.col(1))) <= kPerpendicular))
        fields.refuse("'x_axis' and 'y_axis' must be perpendicular");
    axes.col(1) = (axes.col(1) - axes.col(0).dot(axes.col(1)) * axes.col(0)).normalized();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
}

template <class Shape>
Shape read_along(Fields& fields, const Range& radius) {
    Shape shape;
    shape.from = fields.point("from");
    shape.to = fields.point("to");
    shape.radius = fields.pair("radius", radius);
    if (!((shape.to - shape.from).norm() > 0))
        fields.refuse("'from' and 'to' are the same point; move one of them");
    return shape;
}

Cone read_cone(Fields& fields) {
    const Cone cone = read_along<Cone>(fields, kRadiusOrZero);
    if (!(cone.radius[0] + cone.radius[1] > 0))
        fields.refuse("'radius' is 0 at both ends; one must be above 0");
    return cone;
}

Cone read_cylinder(Fields& fields) {
    Cone cylinder;
    cylinder.from = fields.point("from");
    cylinder.to = fields.point("to");
    cylinder.radius[0] = cylinder.radius[1] = fields.number("radius", kLength);
    if (!((cylinder.to - cylinder.from).norm() > 0))
        fields.refuse("'from' and 'to' are the same point; move one of them");
    return cylinder;
}

Torus read_torus(Fields& fields) {
    Torus torus;
    torus.centre = fields.point("centre");
    torus.axis = fields.direction("axis");
    torus.ring = fields.number("ring", kLength);
    torus.tube = fields.number("tube", kLength);
    return torus;
}

using Shape = decltype(Solid::shape);
using Reader = std::function<Shape(Fields&)>;

const std::vector<std::pair<std::string, Reader>>& solid_readers() {
    static const std::vector<std::pair<std::string, Reader>> readers{
        {"sphere",
         [](Fields& f) {
             return Sphere{f.point("centre"), f.number("radius", kLength)};
         }},
        {"ellipsoid",
         [](Fields& f) {
             return Ellipsoid{f.point("centre"), f.point("semi_axes", kLength), read_axes(f)};
         }},
        {"capsule", [](Fields& f) { return read_along<Capsule>(f, kLength); }},
        {"cylinder", [](Fields& f) { return read_cylinder(f); }},
        {"cone", [](Fields& f) { return read_cone(f); }},
        {"box",
         [](Fields& f) {
             return Cuboid{f.point("centre"), f.point("size", kLength), read_axes(f)};
         }},
        {"torus", [](Fields& f) { return read_torus(f); }},
        {"half_space",
         [](Fields& f) {
             return HalfSpace{f.point("point"), f.direction("outward")};
         }},
    };
    return readers;
}

std::vector<std::string> operand_words() {
    std::vector<std::string> words{"tissue", "surface"};
    for (const auto& reader : solid_readers()) words.push_back(reader.first);
    return words;
}

Solid read_solid(const Reader& read, const YamlTree& tree, const std::string& where) {
    Fields fields(tree, where);
    Solid solid;
    solid.relative_to = fields.word_or("relative_to", "");
    solid.shape = read(fields);
    fields.finish();
    return solid;
}

}  // namespace

Operand read_operand(Fields& step, const std::string& key) {
    const YamlTree& tree = step.require(key);
    if (tree.kind == YamlTree::Kind::scalar) return TissueName{step.word(key)};
    Fields fields(tree, step.where() + ", '" + key + "'");
    if (fields.has("tissue")) {
        TissueName tissue{fields.word("tissue")};
        fields.finish();
        return tissue;
    }
    if (fields.has("surface")) {
        SurfaceFile surface{fields.word("surface"), fields.flag_or("heal", false)};
        fields.finish();
        return surface;
    }
    for (const auto& [word, read] : solid_readers())
        if (const YamlTree* solid = fields.find(word)) {
            Solid made = read_solid(read, *solid, step.where() + ", '" + word + "'");
            fields.finish();
            return made;
        }
    const std::string found = tree.entries.empty() ? "" : tree.entries.front().first;
    fields.refuse("'" + found + "' is no tissue, surface or solid" +
                  remedy_for(found, operand_words()));
}

}  // namespace myotet::repair
