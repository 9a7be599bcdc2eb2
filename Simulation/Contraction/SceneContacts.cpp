// SPDX-License-Identifier: Apache-2.0
#include "Contraction/SceneContacts.h"

#include <algorithm>

namespace myotet::contraction {
namespace {

// Beyond the gap, nodes are watched that come so near in a step, mm.
constexpr double kReach = 5;

// What both sides of a contact feel together; two bodies press each other both ways, over
// one area.
void add(ContactReport side, bool both_ways, ContactReport& to) {
    if (both_ways) {
        side.area /= 2;
        side.max_pressure *= 2;
    }
    const double area = to.area + side.area;
    if (area > 0) to.mean_depth = (to.mean_depth * to.area + side.mean_depth * side.area) / area;
    to.area = area;
    to.nodes += side.nodes;
    to.max_depth = std::max(to.max_depth, side.max_depth);
    to.max_pressure = std::max(to.max_pressure, side.max_pressure);
    to.total += side.total;
    to.force += side.force;
}

}  // namespace

SceneContacts::SceneContacts(const Scene& scene, const std::vector<ContactSide>& sides,
                             const std::vector<Vec3>& rest)
    : scene_(scene) {
    for (const ContactSide& side : sides) {
        const Contact& contact = scene.contacts[side.contact];
        const PenaltyLaw law{side.bone >= 0 ? contact.stiffness : contact.stiffness / 2,
                             contact.gap};
        Side made{side.contact, side.bone, nullptr, nullptr};
        if (side.bone >= 0)
            made.with_bone = std::make_unique<BoneContact>(side.nodes, rest, side.other, law);
        else
            made.with_body =
                std::make_unique<BodyContact>(side.nodes, rest, ContactBody{side.tets, side.other},
                                              BodyContactOptions{law, contact.gap + kReach});
        sides_.push_back(std::move(made));
    }
}

std::vector<dynamics::Potential*> SceneContacts::potentials() const {
    std::vector<dynamics::Potential*> all;
    for (const Side& side : sides_) {
        if (side.with_bone) all.push_back(side.with_bone.get());
        if (side.with_body) all.push_back(side.with_body.get());
    }
    return all;
}

void SceneContacts::set_time(double time) {
    for (const Side& side : sides_)
        if (side.with_bone) {
            const Pose pose = pose_at(scene_.bones[side.bone].motion, time);
            side.with_bone->set_pose({pose.rotation, pose.translation});
        }
}

bool SceneContacts::update_pairs(const std::vector<Vec3>& x) {
    bool changed = false;
    for (const Side& side : sides_)
        if (side.with_body && side.with_body->update_pairs(x)) changed = true;
    return changed;
}

void SceneContacts::forget() {
    for (const Side& side : sides_) {
        if (side.with_bone) side.with_bone->forget();
        if (side.with_body) side.with_body->forget();
    }
}

std::vector<ContactReport> SceneContacts::reports() const {
    std::vector<ContactReport> all(scene_.contacts.size());
    for (const Side& side : sides_)
        add(side.with_bone ? side.with_bone->report() : side.with_body->report(), !side.with_bone,
            all[side.contact]);
    return all;
}

}  // namespace myotet::contraction
