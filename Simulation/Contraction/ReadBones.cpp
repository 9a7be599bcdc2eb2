// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "Contraction/ReadParts.h"
#include "MeshFiles/MeshFiles.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

using Kind = YamlTree::Kind;

constexpr Range kShift{-1e4, 1e4, true, "a length in mm"};
constexpr Range kAngle{-3600, 3600, true, "an angle in degrees"};

bool moves(const KeyFrame& key) { return key.angle_deg != 0 || !key.translation.isZero(0); }

/// Without a centre of its own a key turns about the one before's.
KeyFrame read_key(const YamlTree& tree, const fs::path& file, std::optional<Vec3>& centre) {
    const Keys keys(tree, file, "a key frame", {"time", "translation", "rotation"});
    KeyFrame key;
    key.time = keys.number("time", kSecondsOrZero);
    if (keys.has("translation")) key.translation = keys.point("translation", kShift);
    if (const YamlTree* rotation = keys.find("rotation")) {
        const Keys turn(*rotation, file, "a rotation", {"axis", "angle_deg", "centre"});
        key.axis = turn.direction("axis");
        key.angle_deg = turn.number("angle_deg", kAngle);
        if (turn.has("centre") || !centre) centre = turn.point("centre", repair::kCoordinate);
    }
    key.centre = centre.value_or(Vec3::Zero());
    return key;
}

void check_step(const KeyFrame& before, const KeyFrame& key, const YamlTree& at,
                const fs::path& file) {
    if (!(key.time > before.time))
        refuse(file, at.line,
               "the key at " + shown(key.time) + " s follows the one at " + shown(before.time) +
                   " s, but times must ascend; sort the keys");
    if (!(turn_between_deg(before, key) < kMostTurnDeg))
        refuse(file, at.line,
               "between the keys at " + shown(before.time) + " s and " + shown(key.time) +
                   " s the bone turns by " + shown(turn_between_deg(before, key)) +
                   " degrees, but it must be less than " + shown(kMostTurnDeg) +
                   "; put a key between them");
}

Motion read_motion(const YamlTree& tree, const fs::path& file) {
    if (tree.kind != Kind::list || tree.items.empty())
        refuse(file, tree.line,
               "'motion' must be a list of key frames, each begun with '- time:'; leave it out "
               "for a bone that stays");
    // At 0 s bones are where their meshes are, whether a key says so or not.
    Motion motion{{KeyFrame{}}};
    std::optional<Vec3> centre;
    for (std::size_t i = 0; i < tree.items.size(); ++i) {
        const YamlTree& item = tree.items[i];
        const KeyFrame key = read_key(item, file, centre);
        if (i == 0 && key.time == 0) {
            if (moves(key))
                refuse(file, item.line,
                       "the key at 0 s moves the bone, but at 0 s it is where its mesh is; begin "
                       "the motion at a later time");
            motion.keys.front() = key;
            continue;
        }
        check_step(motion.keys.back(), key, item, file);
        motion.keys.push_back(key);
    }
    return motion;
}

fs::path existing_surface(const Keys& keys) {
    const fs::path file = keys.existing_file("surface");
    if (!meshfiles::is_surface_file(file))
        keys.refuse_value(*keys.find("surface"), "surface",
                          "a file of a closed surface, such as .stl or .ply");
    return file;
}

Bone read_bone(const std::string& name, const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "the bone '" + name + "'",
                    {"mesh", "surface", "tissue", "motion", "body"});
    Bone bone;
    bone.name = name;
    bone.line = tree.key_line;
    const std::string source = keys.one_of({"mesh", "surface", "tissue"});
    if (source == "mesh")
        bone.mesh = existing_mesh(keys);
    else if (source == "surface")
        bone.surface = existing_surface(keys);
    else
        bone.tissue = keys.word("tissue", "a tissue's name or label value");
    if (const YamlTree* motion = keys.find("motion")) bone.motion = read_motion(*motion, file);
    if (keys.has("body")) {
        bone.body = keys.word("body", "the name of a body of the skeleton");
        if (keys.has("motion"))
            keys.refuse(*keys.find("motion"), "the bone '" + name +
                                                  "' goes with a body of the skeleton and has a "
                                                  "'motion' of its own; leave one out");
    }
    return bone;
}

Attachment read_attachment(const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "an attachment",
                    {"body", "to", "within", "node_set", "plane", "end"});
    Attachment attachment;
    attachment.line = tree.line;
    attachment.body = keys.word("body", "the name of a body").name;
    const std::string to = keys.word("to", "the name of a bone, or fixed").name;
    attachment.bone = to == kFixed ? "" : to;
    const std::string how = keys.one_of({"within", "node_set", "plane"});
    if (how == "within") {
        attachment.within = keys.number("within", repair::kLengthOrZero);
        if (to == kFixed)
            keys.refuse(*keys.find("within"),
                        "'within' is a distance from a bone, but the nodes are to be fixed; name "
                        "a bone, or choose them by 'node_set' or 'plane'");
    } else if (how == "node_set") {
        attachment.where = Where::node_set;
        attachment.node_set = keys.word("node_set", "the name of a node set of the mesh").name;
    } else {
        attachment.where = Where::plane;
        const Keys plane(*keys.find("plane"), file, "a plane", {"point", "normal", "within"});
        attachment.point = plane.point("point", repair::kCoordinate);
        attachment.normal = plane.direction("normal");
        attachment.within = plane.number("within", repair::kLengthOrZero);
    }
    attachment.end = keys.choice_or(
        "end", End::other,
        {{"origin", End::origin}, {"insertion", End::insertion}, {"other", End::other}});
    return attachment;
}

}  // namespace

std::vector<Bone> read_bones(const YamlTree& tree, const fs::path& file) {
    if (tree.kind != Kind::map)
        refuse(file, tree.line, "'bones' must be a map, 'radius: {surface: FILE}'");
    std::vector<Bone> bones;
    for (const auto& [name, bone] : tree.entries) bones.push_back(read_bone(name, bone, file));
    return bones;
}

std::vector<Attachment> read_attachments(const YamlTree& tree, const fs::path& file) {
    if (tree.kind != Kind::list)
        refuse(file, tree.line,
               "'attachments' must be a list, '- {body: biceps, to: radius, within: 2}'");
    std::vector<Attachment> attachments;
    for (const YamlTree& item : tree.items) attachments.push_back(read_attachment(item, file));
    return attachments;
}

}  // namespace myotet::contraction
