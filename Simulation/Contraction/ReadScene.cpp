// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ReadParts.h"
#include "Repair/Recipe.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

using Kind = YamlTree::Kind;

constexpr Range kAcceleration{-1e8, 1e8, true, "an acceleration in mm/s^2"};
constexpr Range kPerDepth{0, 1e6, false, "a pressure a depth in MPa/mm above 0"};
constexpr Range kRate{0, 1e6, true, "a rate in 1/s of at least 0"};
constexpr Range kPart{0, 1, true, "a number from 0 to 1"};

Labels read_labels(const YamlTree& tree, const fs::path& file) {
    using levelset::Smoothing;
    using meshing::Compression;
    const Keys keys(
        tree, file, "'labels'",
        {"file", "names", "edge_length", "smoothing", "compression", "close_gaps", "repair"});
    Labels labels;
    labels.line = tree.key_line;
    labels.file = keys.existing_file("file");
    labels.names = keys.existing_file_or_none("names");
    labels.repair = keys.existing_file_or_none("repair");
    // A recipe's mistakes are told before the scan is read.
    if (!labels.repair.empty()) (void)repair::read_recipe(labels.repair);
    if (keys.has("edge_length")) labels.edge_length = keys.number("edge_length", repair::kLength);
    labels.close_gaps = keys.number_or("close_gaps", repair::kLengthOrZero, 0);
    labels.smoothing = keys.choice_or("smoothing", labels.smoothing,
                                      {{"curvature", Smoothing::curvature},
                                       {"constrained", Smoothing::constrained},
                                       {"none", Smoothing::none}});
    labels.compression = keys.choice_or("compression", labels.compression,
                                        {{"springs", Compression::springs},
                                         {"fem", Compression::fem},
                                         {"optimization", Compression::optimization}});
    return labels;
}

Contact read_contact(const YamlTree& tree, const fs::path& file) {
    constexpr const char* kRule = "two names, [a, b]";
    const Keys keys(tree, file, "a contact", {"between", "gap", "stiffness"});
    const std::vector<Named> pair = keys.words("between", kRule);
    if (pair.size() != 2) keys.refuse_value(keys.require("between", kRule), "between", kRule);
    Contact contact{.a = pair[0].name, .b = pair[1].name, .line = tree.line};
    contact.gap = keys.number_or("gap", repair::kLengthOrZero, contact.gap);
    contact.stiffness = keys.number_or("stiffness", kPerDepth, contact.stiffness);
    return contact;
}

std::vector<Contact> read_contacts(const YamlTree& tree, const fs::path& file) {
    if (tree.kind != Kind::list)
        refuse(file, tree.line, "'contact' must be a list, '- between: [biceps, brachialis]'");
    std::vector<Contact> contacts;
    for (const YamlTree& item : tree.items) contacts.push_back(read_contact(item, file));
    return contacts;
}

Time read_time(const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "'time'", {"end", "step", "scheme", "damping", "rho_infinity"});
    Time time;
    time.end = keys.number("end", kSeconds);
    time.step = keys.number("step", kSeconds);
    if (!(time.step <= time.end))
        keys.refuse(*keys.find("step"), "'step' is " + shown(time.step) +
                                            " s, but the time ends at " + shown(time.end) +
                                            " s; make the step shorter");
    time.scheme = keys.choice_or("scheme", time.scheme,
                                 {{"quasi-static", Scheme::quasi_static},
                                  {"backward-euler", Scheme::backward_euler},
                                  {"generalized-alpha", Scheme::generalized_alpha}});
    time.damping = keys.number_or("damping", kRate, 0);
    if (time.damping > 0 && time.scheme == Scheme::quasi_static)
        keys.refuse(*keys.find("damping"),
                    "'damping' slows motion, of which quasi-static knows none; leave it out, or "
                    "choose a 'scheme' with inertia");
    if (const YamlTree* rho = keys.find("rho_infinity")) {
        time.rho_infinity = keys.number("rho_infinity", kPart);
        if (time.scheme != Scheme::generalized_alpha)
            keys.refuse(*rho,
                        "'rho_infinity' is of the scheme generalized-alpha alone; leave it out, or "
                        "choose that 'scheme'");
    }
    return time;
}

Output read_output(const YamlTree* tree, const fs::path& file, const Time& time) {
    Output output{time.step};
    if (!tree) return output;
    const Keys keys(*tree, file, "'output'", {"every"});
    output.every = keys.number_or("every", kSeconds, output.every);
    if (!(output.every >= time.step))
        keys.refuse(*keys.find("every"), "'every' is " + shown(output.every) +
                                             " s, but a step takes " + shown(time.step) +
                                             " s; write 'every' at least as long");
    return output;
}

}  // namespace

void refuse(const Scene& scene, int line, const std::string& why) { refuse(scene.file, line, why); }

Scene read_scene(const fs::path& file) {
    const YamlTree tree = repair::read_yaml(file);
    const Keys keys(tree, file, "the scene",
                    {"title", "labels", "bodies", "materials", "bones", "skeleton", "attachments",
                     "contact", "gravity", "time", "output"});
    Scene scene;
    scene.file = file;
    if (keys.has("title")) scene.title = keys.word("title", "a line of text").name;
    if (const YamlTree* labels = keys.find("labels")) scene.labels = read_labels(*labels, file);
    const YamlTree& bodies = keys.require("bodies", "what deforms, by name");
    // The time decides what bodies and materials may say.
    scene.time = read_time(keys.require("time", "{end: s, step: s}"), file);
    scene.bodies = read_bodies(bodies, file, scene.time);
    if (const YamlTree* part = keys.find("materials"))
        scene.materials = read_materials(*part, file, scene.time);
    if (const YamlTree* part = keys.find("bones")) scene.bones = read_bones(*part, file);
    if (const YamlTree* part = keys.find("skeleton")) move_bones(*part, file, scene);
    if (const YamlTree* part = keys.find("attachments"))
        scene.attachments = read_attachments(*part, file);
    if (const YamlTree* part = keys.find("contact")) scene.contacts = read_contacts(*part, file);
    if (keys.has("gravity")) scene.gravity = keys.point("gravity", kAcceleration);
    scene.output = read_output(keys.find("output"), file, scene.time);
    join_parts(scene);
    return scene;
}

}  // namespace myotet::contraction
