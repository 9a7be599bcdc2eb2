// SPDX-License-Identifier: Apache-2.0
#include "Repair/YamlTree.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "Core/Errors.h"
#include "Core/Text.h"

namespace myotet::repair {
namespace {

// A recipe of a thousand steps has a tenth of this.
constexpr std::size_t kMostBytes = std::size_t{1} << 20;
// Document, steps, step, operand, primitive, point: with room to spare.
constexpr int kDeepest = 12;
// Anchors and aliases can make a small file large.
constexpr int kMostNodes = 200'000;

struct Converter {
    const std::filesystem::path& file;
    int nodes = 0;

    YamlTree convert(const YAML::Node& node, int depth) {
        YamlTree tree;
        tree.line = std::max(node.Mark().line, 0) + 1;
        if (depth > kDeepest)
            refuse(file, tree.line,
                   "is nested too deep; a recipe or a scene needs " + std::to_string(kDeepest) +
                       " levels at most");
        if (++nodes > kMostNodes)
            refuse(file, tree.line,
                   "is too large for a recipe or a scene; keep tables in files of their own");
        if (node.IsScalar()) {
            tree.kind = YamlTree::Kind::scalar;
            tree.text = node.Scalar();
        } else if (node.IsSequence()) {
            tree.kind = YamlTree::Kind::list;
            for (const YAML::Node& item : node) tree.items.push_back(convert(item, depth + 1));
        } else if (node.IsMap()) {
            tree.kind = YamlTree::Kind::map;
            for (const auto& entry : node) add(entry.first, entry.second, depth, tree);
        }
        return tree;
    }

    void add(const YAML::Node& key, const YAML::Node& value, int depth, YamlTree& map) {
        const int line = key.Mark().line + 1;
        if (!key.IsScalar()) refuse(file, line, "a key must be a word");
        const std::string name = key.Scalar();
        if (std::any_of(map.entries.begin(), map.entries.end(),
                        [&](const auto& entry) { return entry.first == name; }))
            refuse(file, line, "'" + name + "' stands twice; write it once");
        YamlTree tree = convert(value, depth + 1);
        tree.key_line = line;
        if (tree.kind == YamlTree::Kind::nothing) tree.line = line;
        map.entries.emplace_back(name, std::move(tree));
    }
};

std::string read_text(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw IoError(file.string() + ": cannot be opened; check its name and rights");
    std::string text(kMostBytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (in.bad()) throw IoError(file.string() + ": cannot be read");
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMostBytes)
        throw InputError(file.string() +
                         ": is larger than 1 MB; recipes and scenes are short texts, is this one?");
    return text;
}

}  // namespace

YamlTree read_yaml(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    try {
        return Converter{file}.convert(YAML::Load(text), 0);
    } catch (const YAML::Exception& e) {
        refuse(file, std::max(e.mark.line, 0) + 1, "is no YAML: " + e.msg);
    }
}

std::string shown(const YamlTree& tree) {
    switch (tree.kind) {
        case YamlTree::Kind::scalar:
            return "'" + tree.text.substr(0, 60) + "'";
        case YamlTree::Kind::list:
            return "a list of " + std::to_string(tree.items.size());
        case YamlTree::Kind::map:
            return "a map of keys";
        case YamlTree::Kind::nothing:
            break;
    }
    return "empty";
}

}  // namespace myotet::repair
