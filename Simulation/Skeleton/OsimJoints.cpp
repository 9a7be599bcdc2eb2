// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "Core/Text.h"
#include "Skeleton/OsimFunctions.h"
#include "Skeleton/OsimModel.h"

namespace myotet::skeleton {
namespace {

/// The freedoms of joints without functions, in order of their coordinates: 0, 1, 2 turns
/// about x, y, z; 3, 4, 5 shifts along them.
const std::map<std::string_view, std::vector<int>> kPlainJoints{
    {"WeldJoint", {}},          {"PinJoint", {2}},
    {"SliderJoint", {3}},       {"UniversalJoint", {0, 1}},
    {"BallJoint", {0, 1, 2}},   {"GimbalJoint", {0, 1, 2}},
    {"PlanarJoint", {2, 3, 4}}, {"FreeJoint", {0, 1, 2, 3, 4, 5}},
};
constexpr std::array<const char*, 6> kAxisNames{"rotation1",    "rotation2",    "rotation3",
                                                "translation1", "translation2", "translation3"};

Freedom& freedom_of(Joint& joint, std::size_t i) {
    return i < 3 ? joint.rotations[i] : joint.translations[i - 3];
}

Function identity() {
    Function f;
    f.kind = FunctionKind::linear;
    f.coefficients = {1, 0};
    return f;
}

const std::string kJoints = "/jointset/";

/// A joint's own coordinates by name.
using Own = std::map<std::string, int>;

class JointReader {
public:
    JointReader(OsimModel& m, const XmlElement& element) : m_(m), file_(m.file), element_(element) {
        joint_.name = file_.name(element);
    }

    /// `body`: the one that the joint stands in, in files of version 3.
    Joint read(const XmlElement* body) {
        if (file_.flag(element_, "reverse", false))
            file_.refuse(element_,
                         "is a reversed joint, which is not read; swap its parent and its child");
        body ? read_frames_3(*body) : read_frames_4();
        if (joint_.child == 0)
            file_.refuse(element_, "moves the ground; swap its parent and its child");
        read_coordinates();
        if (element_.kind == "CustomJoint")
            read_functions();
        else
            read_plain();
        take_house_units();
        return std::move(joint_);
    }

private:
    void read_frames_4() {
        const std::string path = kJoints + joint_.name;
        const auto place = [&](const char* socket) {
            const XmlElement* at = OsimFile::child(element_, socket);
            if (!at) file_.refuse(element_, "has no <" + std::string(socket) + ">; add it");
            return m_.frames.find(*at, at->text, path);
        };
        const OsimPlace parent = place("socket_parent_frame");
        const OsimPlace child = place("socket_child_frame");
        joint_.parent = parent.body;
        joint_.in_parent = parent.in_body;
        joint_.child = child.body;
        joint_.in_child = child.in_body;
    }

    void read_frames_3(const XmlElement& body) {
        const auto place = [&](const char* location, const char* orientation) {
            return pose_of(file_.vector(element_, location, Vec3::Zero()),
                           file_.vector(element_, orientation, Vec3::Zero()));
        };
        joint_.parent = m_.frames.find(element_, file_.word(element_, "parent_body"), "").body;
        joint_.in_parent = place("location_in_parent", "orientation_in_parent");
        joint_.child = m_.frames.find(body, body.name, "").body;
        joint_.in_child = place("location", "orientation");
    }

    void read_coordinates() {
        auto elements = OsimFile::objects(element_, "coordinates");
        if (elements.empty()) elements = OsimFile::objects(element_, "CoordinateSet");
        for (const XmlElement* element : elements) {
            const std::string& name = file_.name(*element);
            const int index = static_cast<int>(m_.model.coordinates.size());
            if (!m_.coordinates.emplace(name, index).second)
                file_.refuse(*element, "there are two coordinates of this name; rename one");
            own_[name] = index;
            elements_.push_back(element);
            m_.model.coordinates.emplace_back().name = name;
        }
    }

    void read_plain() {
        const auto kind = kPlainJoints.find(element_.kind);
        if (kind == kPlainJoints.end())
            file_.refuse(element_,
                         "is a joint of a kind that is not read; use PinJoint, SliderJoint, "
                         "WeldJoint, UniversalJoint, BallJoint, GimbalJoint, PlanarJoint, "
                         "FreeJoint or CustomJoint");
        const auto& slots = kind->second;
        if (elements_.size() != slots.size())
            file_.refuse(element_, "has " + std::to_string(elements_.size()) +
                                       " coordinates where a " + element_.kind + " has " +
                                       std::to_string(slots.size()) + "; correct their list");
        for (std::size_t i = 0; i < slots.size(); ++i) {
            Freedom& freedom = freedom_of(joint_, static_cast<std::size_t>(slots[i]));
            freedom.function = identity();
            freedom.coordinate = own_.at(elements_[i]->name);
        }
    }

    void read_functions() {
        const auto axes = OsimFile::objects(element_, "SpatialTransform");
        if (axes.size() != 6)
            file_.refuse(element_, "has " + std::to_string(axes.size()) +
                                       " axes in its <SpatialTransform> where six belong");
        for (std::size_t i = 0; i < 6; ++i) {
            const auto named = std::ranges::find(axes, kAxisNames[i], &XmlElement::name);
            if (named == axes.end())
                file_.refuse(element_,
                             "has no TransformAxis '" + std::string(kAxisNames[i]) + "'; add it");
            read_axis(**named, freedom_of(joint_, i));
        }
        for (std::size_t first : {0, 3})
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 a = freedom_of(joint_, first + i).axis;
                const Vec3 b = freedom_of(joint_, first + (i + 1) % 3).axis;
                constexpr double kParallel = 1e-5;  // sine of the angle, as OpenSim takes it
                if (!(a.cross(b).norm() > kParallel))
                    file_.refuse(element_, "has parallel axes, " +
                                               std::string(kAxisNames[first + i]) + " and " +
                                               kAxisNames[first + (i + 1) % 3] +
                                               "; let them span three directions");
            }
    }

    void read_axis(const XmlElement& element, Freedom& freedom) {
        const Vec3 axis = file_.vector(element, "axis", freedom.axis);
        if (!(axis.norm() > 0)) file_.refuse(element, "has an axis of length 0; correct it");
        freedom.axis = axis.normalized();
        const auto names = words_of(file_.word(element, "coordinates"));
        if (names.size() > 1)
            file_.refuse(element, "depends on " + std::to_string(names.size()) +
                                      " coordinates, but only one is read; let it depend on one");
        const XmlElement* function = find_function(element, "function");
        if (!function && names.empty()) return;
        freedom.function = function ? read_function(file_, *function) : identity();
        if (freedom.function.kind == FunctionKind::constant) return;
        const auto own = names.empty() ? own_.end() : own_.find(last_part(names[0]));
        if (own == own_.end())
            file_.refuse(element, names.empty()
                                      ? "depends on no coordinate; write one in <coordinates>"
                                      : "depends on '" + names[0] +
                                            "', which is no coordinate of this joint; correct it");
        freedom.coordinate = own->second;
    }

    /// A coordinate is a length where it is a shift itself, not by another function, and no
    /// turn; or where its file says so, if it is neither.
    bool is_rotational(int coordinate, const XmlElement& element) const {
        bool turns = false, shift = false;
        for (const Freedom& f : joint_.rotations) {
            turns |= f.coordinate == coordinate;
            if (f.coordinate == coordinate && f.function.kind == FunctionKind::linear) return true;
        }
        for (const Freedom& f : joint_.translations)
            shift |= f.coordinate == coordinate && f.function.kind == FunctionKind::linear;
        if (shift) return false;
        const std::string said = file_.word(element, "motion_type");
        return said == "rotational" || (said != "translational" && turns);
    }

    void take_house_units() {
        for (const XmlElement* element : elements_) {
            const int index = own_.at(element->name);
            Coordinate& coordinate = m_.model.coordinates[static_cast<std::size_t>(index)];
            coordinate.rotational = is_rotational(index, *element);
            const double unit = coordinate.rotational ? 1 : kMillimetres;
            read_coordinate(*element, unit, coordinate);
            for (std::size_t i = 0; i < 6; ++i) {
                Freedom& f = freedom_of(joint_, i);
                if (f.coordinate == index)
                    f.function = with_input_unit(std::move(f.function), unit);
            }
        }
        for (Freedom& shift : joint_.translations) shift.function.scale *= kMillimetres;
    }

    void read_coordinate(const XmlElement& element, double unit, Coordinate& coordinate) const {
        coordinate.at_rest = unit * file_.number(element, "default_value", 0);
        coordinate.locked = file_.flag(element, "locked", false);
        if (const XmlElement* range = file_.property(element, "range")) {
            const auto ends = file_.bounds(*range);
            if (ends.size() != 2 || !(ends[0] <= ends[1]))
                file_.refuse(*range, "must hold two numbers, the lower one first; correct it");
            coordinate.lowest = unit * ends[0];
            coordinate.highest = unit * ends[1];
        }
        const XmlElement* function = find_function(element, "prescribed_function");
        if (!function || !file_.flag(element, "prescribed", false)) return;
        coordinate.prescribed = read_function(file_, *function);
        coordinate.prescribed->scale *= unit;
    }

    OsimModel& m_;
    const OsimFile& file_;
    const XmlElement& element_;
    Joint joint_;
    Own own_;
    std::vector<const XmlElement*> elements_;
};

/// A joint and the line where it stands.
struct Found {
    Joint joint;
    const XmlElement* element = nullptr;
};

std::vector<Found> joints_of(OsimModel& m) {
    std::vector<Found> found;
    const auto joints = OsimFile::objects(m.file.model(), "JointSet");
    for (const XmlElement* joint : joints)
        for (const XmlElement* frame : OsimFile::objects(*joint, "frames"))
            m.frames.add(kJoints + m.file.name(*joint) + "/" + m.file.name(*frame), *frame, -1);
    for (const XmlElement* element : joints)
        found.push_back({JointReader(m, *element).read(nullptr), element});
    for (const XmlElement* body : OsimFile::objects(m.file.model(), "BodySet"))
        for (const XmlElement* element : OsimFile::objects(*body, "Joint"))
            found.push_back({JointReader(m, *element).read(body), element});
    return found;
}

/// From the ground outwards, otherwise in order of the file.
void sort_joints(OsimModel& m, std::vector<Found> found) {
    const auto& bodies = m.model.bodies;
    std::vector<const XmlElement*> moved(bodies.size(), nullptr);
    for (const Found& f : found) {
        auto& mover = moved[static_cast<std::size_t>(f.joint.child)];
        if (mover)
            m.file.refuse(*f.element,
                          "moves '" + bodies[static_cast<std::size_t>(f.joint.child)].name +
                              "', which the joint in line " + std::to_string(mover->line) +
                              " moves too; closed chains are not read, take one away");
        mover = f.element;
    }
    for (std::size_t b = 1; b < bodies.size(); ++b)
        if (!moved[b])
            m.file.refuse(m.file.model(), "has no joint that moves the body '" + bodies[b].name +
                                              "'; join it to the ground by a FreeJoint");
    std::vector<bool> stands(bodies.size(), false);
    stands[0] = true;
    for (bool more = true; more;) {
        more = false;
        for (Found& f : found) {
            const auto child = static_cast<std::size_t>(f.joint.child);
            if (stands[child] || !stands[static_cast<std::size_t>(f.joint.parent)]) continue;
            stands[child] = more = true;
            m.model.joints.push_back(std::move(f.joint));
        }
    }
    for (const Found& f : found)
        if (!stands[static_cast<std::size_t>(f.joint.child)])
            m.file.refuse(*f.element,
                          "hangs on bodies that hang on it, in a circle; join one of them to the "
                          "ground");
}

}  // namespace

void read_osim_joints(OsimModel& m) { sort_joints(m, joints_of(m)); }

int find_coordinate(const OsimModel& m, const XmlElement& at, const std::string& named) {
    const auto found = m.coordinates.find(last_part(named));
    if (found != m.coordinates.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [name, index] : m.coordinates) known.push_back(name);
    m.file.refuse(at, "names the coordinate '" + named + "', which is not there; known are " +
                          list_of(known));
}

}  // namespace myotet::skeleton
