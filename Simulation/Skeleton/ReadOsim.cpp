// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/ReadOsim.h"

#include <set>
#include <string_view>

#include "Core/Text.h"
#include "Skeleton/OsimModel.h"

namespace myotet::skeleton {
namespace {

/// Things that only show or mark something.
const std::set<std::string_view> kSilent{"PhysicalOffsetFrame", "Marker", "Station"};

bool is_off(const OsimFile& file, const XmlElement& thing) {
    return file.flag(thing, "isDisabled", false) || !file.flag(thing, "isEnforced", true) ||
           !file.flag(thing, "appliesForce", true) || !file.flag(thing, "enabled", true);
}

/// Forces, constraints and the like that are there and act.
void find_ignored(OsimModel& m) {
    for (const char* set : {"ForceSet", "ConstraintSet", "ControllerSet", "ContactGeometrySet",
                            "ProbeSet", "ComponentSet", "components"})
        for (const XmlElement* thing : OsimFile::objects(m.file.model(), set)) {
            const bool muscle = thing->kind.find("Muscle") != std::string::npos;
            if ((muscle && set == std::string_view("ForceSet")) || kSilent.contains(thing->kind) ||
                is_off(m.file, *thing))
                continue;
            m.ignored[thing->kind].push_back(thing->name.empty() ? "without a name" : thing->name);
        }
}

}  // namespace

Model read_osim(const std::filesystem::path& path) {
    const OsimFile file(path);
    OsimModel m(file);
    m.model.name = file.model().name;
    m.model.gravity = kMillimetres * file.vector(file.model(), "gravity", Vec3(0, -9.80665, 0));
    read_osim_bodies(m);
    read_osim_joints(m);
    read_osim_wraps(m);
    read_osim_muscles(m);
    find_ignored(m);
    for (const auto& [kind, names] : m.ignored)
        m.model.notes.push_back(std::to_string(names.size()) + " " + kind +
                                (names.size() == 1 ? " is" : " are") +
                                " not taken into account: " + list_of(names));
    return std::move(m.model);
}

}  // namespace myotet::skeleton
