// SPDX-License-Identifier: Apache-2.0
#include "Core/Text.h"
#include "Skeleton/OsimModel.h"

namespace myotet::skeleton {
namespace {

Quadrant read_quadrant(const OsimFile& file, const XmlElement& element) {
    const XmlElement* property = file.property(element, "quadrant");
    const std::string said = property ? lower(property->text) : "all";
    if (said == "all" || said.empty()) return {};
    const std::string axis = said.front() == '-' || said.front() == '+' ? said.substr(1) : said;
    if (axis != "x" && axis != "y" && axis != "z")
        file.refuse(*property,
                    "is '" + property->text.substr(0, 40) + "'; write all, x, -x, y, -y, z or -z");
    return {axis[0] - 'x', said.front() == '-' ? -1 : 1};
}

double positive(const OsimFile& file, const XmlElement& element, const char* property) {
    const double metres = file.number(element, property);
    if (!(metres > 0))
        file.refuse(element, "has " + std::string(property) + " " + shown(metres) +
                                 " m, but must be more than 0");
    return kMillimetres * metres;
}

void read_size(const OsimFile& file, const XmlElement& element, WrapObject& object) {
    if (element.kind == "WrapSphere") {
        object.shape = WrapShape::sphere;
        object.size = {positive(file, element, "radius")};
    } else if (element.kind == "WrapCylinder") {
        object.shape = WrapShape::cylinder;
        object.size = {positive(file, element, "radius"), positive(file, element, "length")};
    } else if (element.kind == "WrapEllipsoid") {
        object.shape = WrapShape::ellipsoid;
        const Vec3 axes = kMillimetres * file.vector(element, "dimensions");
        if (!(axes.minCoeff() > 0))
            file.refuse(element, "has a half axis that is not more than 0; correct <dimensions>");
        object.size = {axes.x(), axes.y(), axes.z()};
    } else if (element.kind == "WrapTorus") {
        // OpenSim's inner radius is that of the ring's own thickness, its outer one that of
        // the ring's middle: so it wraps, whatever they are called.
        object.shape = WrapShape::torus;
        const double thick = positive(file, element, "inner_radius");
        const double middle = positive(file, element, "outer_radius");
        if (!(middle > thick))
            file.refuse(element, "has an outer radius that is not more than the inner one");
        object.size = {middle - thick, middle + thick};
    } else {
        file.refuse(element,
                    "is a wrap object of a kind that is not read; use WrapSphere, WrapCylinder, "
                    "WrapEllipsoid or WrapTorus");
    }
}

}  // namespace

void read_osim_wraps(OsimModel& m) {
    for (const OsimFrames::Frame& frame : m.frames.all()) {
        const auto elements = OsimFile::objects(*frame.element, "WrapObjectSet");
        if (elements.empty()) continue;
        const OsimPlace place = m.frames.place(frame);
        for (const XmlElement* element : elements) {
            WrapObject object;
            object.name = m.file.name(*element);
            object.body = place.body;
            read_size(m.file, *element, object);
            object.in_body =
                place.in_body * pose_of(m.file.vector(*element, "translation", Vec3::Zero()),
                                        m.file.vector(*element, "xyz_body_rotation", Vec3::Zero()));
            object.quadrant = read_quadrant(m.file, *element);
            object.active = m.file.flag(*element, "active", true);
            m.model.wrap_objects.push_back(std::move(object));
        }
    }
}

}  // namespace myotet::skeleton
