// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "Core/Text.h"
#include "Skeleton/OsimFunctions.h"
#include "Skeleton/OsimModel.h"

namespace myotet::skeleton {
namespace {

/// What a property names, under its name of version 4 or that of version 3.
const XmlElement* named(const OsimFile& file, const XmlElement& of, const std::string& what) {
    return file.property(of, {"socket_" + what, what});
}

std::optional<PathPoint::Condition> read_condition(const OsimModel& m, const XmlElement& element) {
    const XmlElement* coordinate = named(m.file, element, "coordinate");
    const XmlElement* range = m.file.property(element, "range");
    if (!coordinate || !range) m.file.refuse(element, "has no coordinate or no <range>; add both");
    PathPoint::Condition condition;
    condition.coordinate = find_coordinate(m, *coordinate, coordinate->text);
    const auto ends = m.file.bounds(*range);
    if (ends.size() != 2 || !(ends[0] <= ends[1]))
        m.file.refuse(*range, "must hold two numbers, the lower one first; correct it");
    const auto index = static_cast<std::size_t>(condition.coordinate);
    const double unit = m.model.coordinates[index].rotational ? 1 : kMillimetres;
    condition.lowest = unit * ends[0];
    condition.highest = unit * ends[1];
    return condition;
}

PathPoint::Moving read_axis(const OsimModel& m, const XmlElement& element,
                            const std::string& axis) {
    PathPoint::Moving moving;
    const XmlElement* function = find_function(element, axis + "_location");
    if (!function) m.file.refuse(element, "has no <" + axis + "_location>; add a function");
    moving.location = read_function(m.file, *function);
    moving.location.scale *= kMillimetres;
    if (moving.location.kind == FunctionKind::constant) return moving;
    const XmlElement* coordinate = named(m.file, element, axis + "_coordinate");
    if (!coordinate) m.file.refuse(element, "has no <" + axis + "_coordinate>; add it");
    moving.coordinate = find_coordinate(m, *coordinate, coordinate->text);
    const auto index = static_cast<std::size_t>(moving.coordinate);
    if (!m.model.coordinates[index].rotational)
        moving.location = with_input_unit(std::move(moving.location), kMillimetres);
    return moving;
}

PathPoint read_point(const OsimModel& m, const XmlElement& element) {
    constexpr std::array<std::string_view, 6> kKinds{
        "PathPoint",      "MusclePoint",     "ConditionalPathPoint",
        "MuscleViaPoint", "MovingPathPoint", "MovingMusclePoint"};
    const auto kind = std::ranges::find(kKinds, element.kind) - kKinds.begin();
    if (kind == 6)
        m.file.refuse(element,
                      "is a point of a kind that is not read; use PathPoint, "
                      "ConditionalPathPoint or MovingPathPoint");
    const XmlElement* body = m.file.property(element, {"socket_parent_frame", "body"});
    if (!body) m.file.refuse(element, "is in no body; add <socket_parent_frame>");
    const OsimPlace place = m.frames.find(*body, body->text, "");
    PathPoint point;
    point.name = element.name;
    point.body = place.body;
    if (kind < 4) {
        point.location = place.in_body(kMillimetres * m.file.vector(element, "location"));
        if (kind >= 2) point.condition = read_condition(m, element);
        return point;
    }
    if (!place.in_body.rotation.isIdentity(0) || !place.in_body.translation.isZero(0))
        m.file.refuse(element,
                      "moves in a frame that is offset from its body, which is not read; let its "
                      "functions tell the place in the body");
    point.moving = {read_axis(m, element, "x"), read_axis(m, element, "y"),
                    read_axis(m, element, "z")};
    return point;
}

PathWrap read_path_wrap(const OsimModel& m, const XmlElement& element, std::size_t points) {
    PathWrap wrap;
    const std::string name = m.file.word(element, "wrap_object");
    const auto& objects = m.model.wrap_objects;
    const auto found = std::ranges::find(objects, last_part(name), &WrapObject::name);
    if (found == objects.end())
        m.file.refuse(element, "names the wrap object '" + name +
                                   "', but the model has none of this name; correct it");
    wrap.object = static_cast<int>(found - objects.begin());
    const XmlElement* range = m.file.property(element, "range");
    if (!range) return wrap;
    const auto ends = m.file.numbers(*range, 2);
    const auto count = static_cast<double>(points);
    const double first = ends[0] == -1 ? 1 : ends[0], last = ends[1] == -1 ? count : ends[1];
    if (first != std::floor(first) || last != std::floor(last) || !(first >= 1) ||
        !(last <= count) || !(first < last))
        m.file.refuse(*range, "is '" + range->text + "', but the muscle has points 1 to " +
                                  std::to_string(points) +
                                  "; write the first and the last of some, or -1 -1");
    if (ends[0] != -1) wrap.first = static_cast<int>(first) - 1;
    if (ends[1] != -1) wrap.last = static_cast<int>(last) - 1;
    return wrap;
}

/// The element that holds a muscle's points and wraps: its path, or itself in old files;
/// nullptr: it runs as no file of ours tells.
const XmlElement* path_of(const XmlElement& muscle) {
    if (const XmlElement* wrapped = OsimFile::child(muscle, "path"))
        return OsimFile::child(*wrapped, "GeometryPath");
    if (const XmlElement* path = OsimFile::child(muscle, "GeometryPath")) return path;
    return OsimFile::child(muscle, "MusclePointSet") ? &muscle : nullptr;
}

void read_path(const OsimModel& m, const XmlElement& path, Muscle& muscle) {
    for (const char* set : {"PathPointSet", "MusclePointSet"})
        for (const XmlElement* point : OsimFile::objects(path, set))
            muscle.points.push_back(read_point(m, *point));
    if (muscle.points.size() < 2)
        m.file.refuse(path, "has " + std::to_string(muscle.points.size()) +
                                " points, but a muscle needs at least two; add them");
    for (const char* set : {"PathWrapSet", "MuscleWrapSet"})
        for (const XmlElement* wrap : OsimFile::objects(path, set))
            muscle.wraps.push_back(read_path_wrap(m, *wrap, muscle.points.size()));
}

/// What OpenSim takes for a muscle that does not say, by its type.
void set_time_constants(const std::string& type, Muscle& muscle) {
    if (type.starts_with("Millard2012")) {
        muscle.rise = 0.010;
        muscle.fall = 0.040;
    } else if (type.starts_with("DeGrooteFregly")) {
        muscle.rise = 0.015;
        muscle.fall = 0.060;
    }
}

void read_numbers(const OsimFile& file, const XmlElement& element, Muscle& muscle) {
    const auto number = [&](std::initializer_list<std::string_view> names, double otherwise,
                            double lowest) {
        const XmlElement* property = file.property(element, names);
        const double value = property ? file.number_in(*property) : otherwise;
        if (!(value >= lowest))
            file.refuse(
                property ? *property : element,
                "is " + shown(value) + ", but must be at least " + shown(lowest) + "; correct it");
        return value;
    };
    constexpr double kLeast = 1e-9;  // of what must be more than 0
    muscle.max_isometric_force = number({"max_isometric_force"}, 1000, 0);
    muscle.optimal_fibre_length = kMillimetres * number({"optimal_fiber_length"}, 0.1, kLeast);
    muscle.tendon_slack_length = kMillimetres * number({"tendon_slack_length"}, 0.2, 0);
    muscle.pennation = number({"pennation_angle_at_optimal", "pennation_angle"}, 0, 0);
    muscle.max_speed = number({"max_contraction_velocity", "Vmax"}, 10, kLeast);
    set_time_constants(muscle.type, muscle);
    muscle.rise = number({"activation_time_constant"}, muscle.rise, kLeast);
    muscle.fall = number({"deactivation_time_constant"}, muscle.fall, kLeast);
    muscle.lowest_activation =
        std::max(number({"min_control"}, 0, 0), number({"minimum_activation"}, 0.01, 0));
    muscle.highest_activation = number({"max_control"}, 1, muscle.lowest_activation);
    muscle.rigid_tendon = element.kind.starts_with("RigidTendon") ||
                          file.flag(element, "ignore_tendon_compliance", false);
    muscle.disabled =
        file.flag(element, "isDisabled", false) || !file.flag(element, "appliesForce", true);
}

/// The numbers of an element that are not among those every muscle has.
void read_shape(const XmlElement& element, const std::string& before, Muscle& muscle) {
    static const std::set<std::string_view> kCommon{"max_isometric_force",
                                                    "optimal_fiber_length",
                                                    "tendon_slack_length",
                                                    "pennation_angle",
                                                    "pennation_angle_at_optimal",
                                                    "max_contraction_velocity",
                                                    "Vmax",
                                                    "activation_time_constant",
                                                    "deactivation_time_constant",
                                                    "min_control",
                                                    "minimum_activation",
                                                    "max_control",
                                                    "default_fiber_length",
                                                    "optimal_force"};
    for (const XmlElement& property : element.children) {
        if (kCommon.contains(property.kind)) continue;
        const auto value = to_number(property.text);
        if (property.children.empty() && value && std::isfinite(*value))
            muscle.shape[before + property.kind] = *value;
        else if (before.empty() && property.kind.ends_with("Curve"))
            read_shape(property, property.kind + "/", muscle);
    }
}

}  // namespace

void read_osim_muscles(OsimModel& m) {
    std::set<std::string> names;
    for (const XmlElement* element : OsimFile::objects(m.file.model(), "ForceSet")) {
        if (element->kind.find("Muscle") == std::string::npos) continue;
        Muscle muscle;
        muscle.name = m.file.name(*element);
        muscle.type = element->kind;
        if (!names.insert(muscle.name).second)
            m.file.refuse(*element, "there are two muscles of this name; rename one");
        const XmlElement* path = path_of(*element);
        if (!path) {
            m.ignored[element->kind + " without a GeometryPath"].push_back(muscle.name);
            continue;
        }
        read_path(m, *path, muscle);
        read_numbers(m.file, *element, muscle);
        if (const XmlElement* all = m.file.defaults(*element)) read_shape(*all, "", muscle);
        read_shape(*element, "", muscle);
        m.model.muscles.push_back(std::move(muscle));
    }
}

}  // namespace myotet::skeleton
