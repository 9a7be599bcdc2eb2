// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "Contraction/ReadParts.h"
#include "Muscle/ActivationDynamics.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

using Kind = YamlTree::Kind;

constexpr const char* kCurve =
    "a number from 0 to 1, a list of [time, value], or {file: FILE, muscle: NAME}";

/// Both go by a curve; messages name the key and its value.
struct Word {
    const char* key;    ///< "activation"
    const char* place;  ///< "an activation"
};

Curve read_table(const YamlTree& tree, const fs::path& file, const Word& word) {
    const std::string key = word.key;
    Curve curve;
    for (const YamlTree& row : tree.items) {
        const auto number = [&](std::size_t i) {
            const bool pair = row.kind == Kind::list && row.items.size() == 2;
            const auto value = pair ? to_number(row.items[i].text) : std::nullopt;
            if (!value)
                refuse(file, row.line,
                       "'" + key +
                           "' has a row that is not two numbers, [time in s, value]; write both");
            return *value;
        };
        const std::string wrong = add_activation(curve, number(0), number(1));
        if (!wrong.empty()) refuse(file, row.line, "in '" + key + "' " + wrong);
    }
    if (curve.times.empty())
        refuse(file, tree.line, "'" + key + "' is an empty list but must be " + kCurve);
    return curve;
}

/// The curve that stands at a key, and notes the file that it is read from.
Curve read_curve(const YamlTree& tree, const fs::path& file, const Word& word, Body& body) {
    if (tree.kind == Kind::list) return read_table(tree, file, word);
    if (tree.kind == Kind::map) {
        const Keys keys(tree, file, word.place, {"file", "muscle", "column"});
        body.activation_file = keys.existing_file("file");
        std::string column = body.name;
        if (keys.has("muscle") || keys.has("column")) {
            const std::string how = keys.one_of({"muscle", "column"});
            column = keys.word(how, "a column's name or number").name;
        }
        return read_activation(body.activation_file, column);
    }
    const auto value = to_number(tree.text);
    Curve curve;
    if (!value || !add_activation(curve, 0, *value).empty())
        refuse(file, tree.line,
               "'" + std::string(word.key) + "' is '" + tree.text + "' but must be " + kCurve);
    return curve;
}

/// Activation that follows the excitation.
Curve read_excitation(const Keys& keys, const Time& time, Body& body) {
    const YamlTree& tree = *keys.find("excitation");
    const Curve excitation = read_curve(tree, keys.file(), {"excitation", "an excitation"}, body);
    muscle::ActivationDynamics dynamics;
    dynamics.rise = keys.number_or("rise", kSeconds, dynamics.rise);
    dynamics.fall = keys.number_or("fall", kSeconds, dynamics.fall);
    const double seconds = time.end - std::min(0.0, excitation.times.front());
    if (!(seconds <= kLongestExcitation))
        keys.refuse(tree, "'excitation' lasts " + shown(seconds) + " s, but " +
                              shown(kLongestExcitation) +
                              " s at most are followed; give an 'activation'");
    return follow(excitation, dynamics, time.end);
}

muscle::ForceVelocity read_force_velocity(const YamlTree& tree, const fs::path& file) {
    constexpr Range kSpeed{0, 1e6, false, "a speed in optimal lengths/s above 0"};
    constexpr Range kShape{0, 1e6, false, "a number above 0"};
    constexpr Range kMost{1, 1e6, false, "a number above 1"};
    muscle::ForceVelocity curve;
    if (tree.kind == Kind::scalar && tree.text == "hill") return curve;
    if (tree.kind != Kind::map)
        refuse(file, tree.line,
               "'force_velocity' is '" + tree.text.substr(0, 60) +
                   "' but must be hill or {max_speed: 10, shape: 0.25, most: 1.4}");
    const Keys keys(tree, file, "a force-velocity curve", {"max_speed", "shape", "most"});
    curve.max_speed = keys.number_or("max_speed", kSpeed, curve.max_speed);
    curve.shape = keys.number_or("shape", kShape, curve.shape);
    curve.most = keys.number_or("most", kMost, curve.most);
    return curve;
}

}  // namespace

void read_drive(const Keys& keys, const Time& time, Body& body) {
    for (const char* key : {"activation", "excitation", "force_velocity"})
        if (const YamlTree* found = keys.find(key); found && body.fibres.from == FibreSource::none)
            keys.refuse(found->key_line, "the body '" + body.name + "' has '" + key +
                                             "' but no fibres to pull along; add 'fibres', or "
                                             "leave '" +
                                             key + "' out");
    for (const char* key : {"rise", "fall"})
        if (const YamlTree* found = keys.find(key); found && !keys.has("excitation"))
            keys.refuse(found->key_line,
                        "'" + std::string(key) +
                            "' says how activation follows an excitation, but none is given; "
                            "leave it out, or write 'excitation' instead of 'activation'");
    if (keys.has("activation") || keys.has("excitation")) {
        if (keys.one_of({"activation", "excitation"}) == "activation")
            body.activation = read_curve(*keys.find("activation"), keys.file(),
                                         {"activation", "an activation"}, body);
        else
            body.activation = read_excitation(keys, time, body);
    }
    const YamlTree* force_velocity = keys.find("force_velocity");
    if (!force_velocity) return;
    body.force_velocity = read_force_velocity(*force_velocity, keys.file());
    if (time.scheme == Scheme::quasi_static)
        keys.refuse(*force_velocity,
                    "'force_velocity' is of motion, of which quasi-static knows none; leave it "
                    "out, or choose a 'scheme' with inertia");
}

}  // namespace myotet::contraction
