// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>

#include "Contraction/ReadParts.h"

namespace myotet::contraction {
namespace {

template <class Things>
std::vector<std::string> names_of(const Things& things) {
    std::vector<std::string> names;
    for (const auto& thing : things) names.push_back(thing.name);
    return names;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

void check_names(const Scene& scene) {
    const auto bodies = names_of(scene.bodies);
    const auto check = [&](const std::string& name, int line) {
        if (name == kFixed)
            refuse(scene, line,
                   "'fixed' is what attachments call space itself; choose another name");
    };
    for (const Body& body : scene.bodies) check(body.name, body.line);
    for (const Bone& bone : scene.bones) {
        check(bone.name, bone.line);
        if (!bone.body.name.empty() && scene.skeleton.model.empty())
            refuse(scene, bone.body.line,
                   "'" + bone.name + "' goes with '" + bone.body.name +
                       "', but the scene has no skeleton; add 'skeleton: {model: FILE, motion: "
                       "FILE}'");
        if (holds(bodies, bone.name))
            refuse(scene, bone.line,
                   "'" + bone.name + "' is a body already; give the bone another name");
    }
}

/// Every tissue of the label volume is one thing only, and the volume is there.
void check_tissues(const Scene& scene) {
    std::map<std::string, std::string> user_of;
    const auto use = [&](const Named& tissue, const std::string& user) {
        if (!scene.labels)
            refuse(scene, tissue.line,
                   "'" + tissue.name +
                       "' is a tissue of a label volume, but none is given; add "
                       "'labels: {file: FILE}', or name a 'mesh'");
        const auto [before, fresh] = user_of.try_emplace(tissue.name, user);
        if (!fresh)
            refuse(scene, tissue.line,
                   "the tissue '" + tissue.name + "' belongs to '" + before->second +
                       "' already; a tissue belongs to one body or bone");
    };
    for (const Body& body : scene.bodies)
        for (const Named& tissue : body.tissues) use(tissue, body.name);
    for (const Bone& bone : scene.bones)
        if (!bone.tissue.name.empty()) use(bone.tissue, bone.name);
    if (scene.labels && user_of.empty())
        refuse(scene, scene.labels->line,
               "'labels' is given, but no body and no bone is made of its tissues; name them by "
               "'tissues' and 'tissue', or leave 'labels' out");
}

void add_models(Scene& scene) {
    for (const Body& body : scene.bodies)
        for (const MaterialOf& use : body.materials)
            if (!holds(names_of(scene.materials), use.material.name))
                scene.materials.push_back({use.material.name, use.material});
}

void check_attachments(const Scene& scene) {
    const auto bodies = names_of(scene.bodies);
    std::vector<std::string> targets = names_of(scene.bones);
    targets.emplace_back(kFixed);
    for (const Attachment& attachment : scene.attachments) {
        if (!holds(bodies, attachment.body))
            refuse(
                scene, attachment.line,
                "there is no body '" + attachment.body + "'" + known_are(attachment.body, bodies));
        if (!attachment.bone.empty() && !holds(targets, attachment.bone))
            refuse(
                scene, attachment.line,
                "there is no bone '" + attachment.bone + "'" + known_are(attachment.bone, targets));
    }
}

/// What a body's attachments must offer.
void check_body(const Scene& scene, const Body& body) {
    bool any = false;
    std::set<End> ends;
    for (const Attachment& attachment : scene.attachments)
        if (attachment.body == body.name) {
            any = true;
            ends.insert(attachment.end);
        }
    if (!any && scene.time.scheme == Scheme::quasi_static)
        refuse(scene, body.line,
               "the body '" + body.name +
                   "' is attached nowhere, so that it has no rest to be found; add an attachment, "
                   "or choose a 'scheme' with inertia");
    const bool needs_ends = body.fibres.from == FibreSource::laplace ||
                            (body.fibres.from == FibreSource::bspline && body.fibres.file.empty());
    for (const auto& [end, name] :
         {std::pair{End::origin, "origin"}, {End::insertion, "insertion"}})
        if (needs_ends && !ends.contains(end))
            refuse(scene, body.line,
                   "the fibres of '" + body.name + "' run from its origin to its insertion, but " +
                       "no attachment of it says 'end: " + name + "'; add that to one");
}

void check_contacts(const Scene& scene) {
    const auto bodies = names_of(scene.bodies);
    std::vector<std::string> all = bodies;
    for (const Bone& bone : scene.bones) all.push_back(bone.name);
    std::set<std::set<std::string>> pairs;
    for (const Contact& contact : scene.contacts) {
        for (const std::string& name : {contact.a, contact.b})
            if (!holds(all, name))
                refuse(scene, contact.line,
                       "there is no body or bone '" + name + "'" + known_are(name, all));
        if (!holds(bodies, contact.a) && !holds(bodies, contact.b))
            refuse(scene, contact.line,
                   "'" + contact.a + "' and '" + contact.b +
                       "' are bones, which do not give way; name at least one body");
        if (!pairs.insert({contact.a, contact.b}).second)
            refuse(scene, contact.line,
                   "contact between '" + contact.a + "' and '" + contact.b +
                       "' stands twice; write it once");
    }
}

}  // namespace

void join_parts(Scene& scene) {
    check_names(scene);
    check_tissues(scene);
    add_models(scene);
    check_attachments(scene);
    for (const Body& body : scene.bodies) check_body(scene, body);
    check_contacts(scene);
}

}  // namespace myotet::contraction
