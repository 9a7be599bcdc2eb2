// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Keys.h"

#include <algorithm>

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

using Kind = YamlTree::Kind;

/// Of the key that names the map: the map itself begins a line later.
int line_of(const YamlTree& map) { return map.key_line > 0 ? map.key_line : map.line; }

}  // namespace

Keys::Keys(const YamlTree& tree, const fs::path& file, std::string place,
           const std::vector<std::string>& known)
    : tree_(tree), file_(file) {
    if (tree.kind != Kind::map)
        refuse(line_of(tree), place + " is " + shown(tree) +
                                  " but must be keys with values; known are " + list_of(known));
    only(place, known);
}

void Keys::only(const std::string& place, const std::vector<std::string>& known) {
    place_ = place;
    for (const auto& [name, value] : tree_.entries)
        if (std::ranges::find(known, name) == known.end())
            refuse(value.key_line,
                   "'" + name + "' is not known in " + place + known_are(name, known));
}

void Keys::refuse(int line, const std::string& why) const { contraction::refuse(file_, line, why); }

void Keys::refuse(const YamlTree& at, const std::string& why) const { refuse(at.line, why); }

void Keys::refuse_value(const YamlTree& value, const std::string& key,
                        const std::string& rule) const {
    refuse(value, "'" + key + "' is " + shown(value) + " but must be " + rule);
}

const YamlTree* Keys::find(const std::string& key) const {
    const auto found =
        std::ranges::find(tree_.entries, key, &std::pair<std::string, YamlTree>::first);
    return found == tree_.entries.end() ? nullptr : &found->second;
}

const YamlTree& Keys::require(const std::string& key, const std::string& rule) const {
    if (const YamlTree* value = find(key)) return *value;
    refuse(line_of(tree_), "'" + key + "' is missing in " + place_ + "; add it: " + rule);
}

Named Keys::word_in(const YamlTree& scalar, const std::string& key, const std::string& rule) const {
    if (scalar.kind != Kind::scalar || scalar.text.empty()) refuse_value(scalar, key, rule);
    return {scalar.text, scalar.line};
}

double Keys::number_in(const YamlTree& scalar, const std::string& key, const Range& range) const {
    const auto value = scalar.kind == Kind::scalar ? to_number(scalar.text) : std::nullopt;
    const bool good = value && *value <= range.high &&
                      (range.low_itself ? *value >= range.low : *value > range.low);
    if (!good) refuse_value(scalar, key, range.rule);
    return *value;
}

Named Keys::word(const std::string& key, const std::string& rule) const {
    return word_in(require(key, rule), key, rule);
}

double Keys::number(const std::string& key, const Range& range) const {
    return number_in(require(key, range.rule), key, range);
}

double Keys::number_or(const std::string& key, const Range& range, double otherwise) const {
    const YamlTree* value = find(key);
    return value ? number_in(*value, key, range) : otherwise;
}

Vec3 Keys::point(const std::string& key, const Range& range) const {
    const std::string rule = "three numbers, [x, y, z], each " + std::string(range.rule);
    const YamlTree& value = require(key, rule);
    if (value.kind != Kind::list || value.items.size() != 3) refuse_value(value, key, rule);
    Vec3 point;
    for (int a = 0; a < 3; ++a) point[a] = number_in(value.items[a], key, range);
    return point;
}

Vec3 Keys::direction(const std::string& key) const {
    constexpr Range kPart{-1e6, 1e6, true, "a part of a direction"};
    const Vec3 direction = point(key, kPart);
    if (!(direction.norm() > 0))
        refuse(require(key, ""), "'" + key + "' is [0, 0, 0] but must point somewhere");
    return direction.normalized();
}

std::vector<Named> Keys::words(const std::string& key, const std::string& rule) const {
    const YamlTree& value = require(key, rule);
    if (value.kind != Kind::list) return {word_in(value, key, rule)};
    std::vector<Named> words;
    for (const YamlTree& item : value.items) {
        const Named word = word_in(item, key, rule);
        if (std::ranges::count(words, word.name, &Named::name) > 0)
            refuse(item, "'" + word.name + "' stands twice in '" + key + "'; write it once");
        words.push_back(word);
    }
    if (words.empty()) refuse_value(value, key, rule);
    return words;
}

fs::path Keys::existing_file(const std::string& key) const {
    const Named name = word(key, "the name of a file");
    const fs::path path = (file_.parent_path() / name.name).lexically_normal();
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored))
        refuse(name.line, "'" + key + "' is '" + name.name + "', but there is no file " +
                              path.string() + "; names are relative to the scene's folder");
    return path;
}

fs::path Keys::existing_file_or_none(const std::string& key) const {
    return has(key) ? existing_file(key) : fs::path{};
}

std::string Keys::one_of(const std::vector<std::string>& keys) const {
    std::string found;
    for (const std::string& key : keys) {
        const YamlTree* value = find(key);
        if (!value) continue;
        if (!found.empty())
            refuse(value->key_line, "'" + found + "' and '" + key + "' both stand in " + place_ +
                                        ", but only one of them may; leave the other out");
        found = key;
    }
    if (!found.empty()) return found;
    refuse(line_of(tree_), "one of " + list_of(keys) + " is missing in " + place_ + "; add it");
}

}  // namespace myotet::contraction
