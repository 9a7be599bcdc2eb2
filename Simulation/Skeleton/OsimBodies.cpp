// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "Core/Text.h"
#include "Skeleton/OsimModel.h"

namespace myotet::skeleton {
namespace {

/// xx, yy, zz, xy, xz, yz: in one property, or one each in older files.
std::array<double, 6> moments(const OsimFile& file, const XmlElement& body) {
    std::array<double, 6> m{};
    if (const XmlElement* all = file.property(body, "inertia")) {
        const auto six = file.numbers(*all, 6);
        std::copy(six.begin(), six.end(), m.begin());
        return m;
    }
    constexpr std::array<const char*, 6> kNames{"inertia_xx", "inertia_yy", "inertia_zz",
                                                "inertia_xy", "inertia_xz", "inertia_yz"};
    for (std::size_t i = 0; i < 6; ++i) m[i] = file.number(body, kNames[i], 0);
    return m;
}

Body read_body(const OsimFile& file, const XmlElement& element) {
    Body body;
    body.name = file.name(element);
    const double mass = file.number(element, "mass", 0);
    if (mass < 0)
        file.refuse(element, "has mass " + shown(mass) + " kg, but none can be less than 0");
    body.mass = kTonnes * mass;
    body.mass_center = kMillimetres * file.vector(element, "mass_center", Vec3::Zero());
    const auto [xx, yy, zz, xy, xz, yz] = moments(file, element);
    if (xx < 0 || yy < 0 || zz < 0)
        file.refuse(element,
                    "has a moment of inertia less than 0; write those about its mass center");
    body.inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    body.inertia *= kTonnes * kMillimetres * kMillimetres;
    return body;
}

}  // namespace

void read_osim_bodies(OsimModel& m) {
    const XmlElement& root = m.file.model();
    m.model.bodies.resize(1);
    m.model.bodies[0].name = "ground";
    const auto bodies = OsimFile::objects(root, "BodySet");
    const XmlElement* ground = OsimFile::child(root, "Ground");
    for (const XmlElement* element : bodies)
        if (!ground && element->name == "ground") ground = element;
    if (ground) m.frames.add("/ground", *ground, 0);
    for (const XmlElement* element : bodies) {
        if (element->name == "ground") continue;
        if (element->kind != "Body")
            m.file.refuse(*element, "is a body of a kind that is not read; use <Body>");
        m.frames.add("/bodyset/" + m.file.name(*element), *element,
                     static_cast<int>(m.model.bodies.size()));
        m.model.bodies.push_back(read_body(m.file, *element));
    }
    for (const char* list : {"components", "ComponentSet"})
        for (const XmlElement* part : OsimFile::objects(root, list))
            if (part->kind == "PhysicalOffsetFrame")
                m.frames.add("/" + m.file.name(*part), *part, -1);
}

}  // namespace myotet::skeleton
