// SPDX-License-Identifier: Apache-2.0
#include "Repair/Fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "Core/Errors.h"

namespace myotet::repair {
namespace {

using Kind = YamlTree::Kind;

// Insertions, deletions and replacements that turn one word into the other.
std::size_t edits(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
        }
    }
    return row.back();
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
    std::string best;
    std::size_t fewest = std::max<std::size_t>(word.size() / 2, 1) + 1;
    for (const std::string& candidate : candidates)
        if (const std::size_t n = edits(word, candidate); n < fewest) {
            fewest = n;
            best = candidate;
        }
    return best;
}

std::string remedy_for(const std::string& word, const std::vector<std::string>& candidates) {
    const std::string near = nearest_word(word, candidates);
    if (!near.empty()) return "; did you mean '" + near + "'?";
    constexpr std::size_t kMostShown = 40;
    std::string text = "; known are ";
    for (std::size_t i = 0; i < std::min(candidates.size(), kMostShown); ++i)
        text += (i ? ", " : "") + candidates[i];
    return candidates.size() > kMostShown ? text + " and more" : text;
}

Fields::Fields(const YamlTree& tree, std::string where) : tree_(tree), where_(std::move(where)) {
    if (tree.kind != Kind::map)
        refuse("this is " + shown(tree) + " but must be keys with values, such as 'radius: 3'");
}

void Fields::refuse(const std::string& why) const { throw InputError(where_ + ": " + why); }

const YamlTree* Fields::find(const std::string& key) {
    asked_.push_back(key);
    for (const auto& [name, value] : tree_.entries)
        if (name == key) return &value;
    return nullptr;
}

const YamlTree& Fields::require(const std::string& key) {
    const YamlTree* value = find(key);
    // A misspelt key is the likelier mistake than a missing one.
    if (!value) {
        for (const auto& entry : tree_.entries)
            if (std::find(asked_.begin(), asked_.end(), entry.first) == asked_.end() &&
                nearest_word(entry.first, {key}) == key)
                refuse("'" + entry.first + "' is not known here; did you mean '" + key + "'?");
        refuse("'" + key + "' is missing; add it");
    }
    return *value;
}

std::string Fields::text(const YamlTree& scalar, const std::string& key) const {
    if (scalar.kind != Kind::scalar || scalar.text.empty())
        refuse("'" + key + "' is " + shown(scalar) + " but must be a word");
    return scalar.text;
}

double Fields::parse(const YamlTree& scalar, const std::string& key, const Range& range) const {
    double value = std::nan("");
    const std::string& t = scalar.text;
    const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), value);
    const bool good = scalar.kind == Kind::scalar && error == std::errc() &&
                      end == t.data() + t.size() && value <= range.high &&
                      (range.low_itself ? value >= range.low : value > range.low);
    if (!good) refuse("'" + key + "' is " + shown(scalar) + " but must be " + range.rule);
    return value;
}

std::string Fields::word(const std::string& key) { return text(require(key), key); }

std::string Fields::word_or(const std::string& key, const std::string& otherwise) {
    const YamlTree* value = find(key);
    return value ? text(*value, key) : otherwise;
}

double Fields::number(const std::string& key, const Range& range) {
    return parse(require(key), key, range);
}

double Fields::number_or(const std::string& key, const Range& range, double otherwise) {
    const YamlTree* value = find(key);
    return value ? parse(*value, key, range) : otherwise;
}

int Fields::count_or(const std::string& key, int low, int high, int otherwise) {
    const YamlTree* value = find(key);
    if (!value) return otherwise;
    const std::string rule =
        "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    const double number = parse(*value, key, {double(low), double(high), true, rule.c_str()});
    if (number != std::floor(number))
        refuse("'" + key + "' is " + shown(*value) + " but must be " + rule);
    return static_cast<int>(number);
}

bool Fields::flag_or(const std::string& key, bool otherwise) {
    const YamlTree* value = find(key);
    if (!value) return otherwise;
    if (value->text == "true" || value->text == "yes") return true;
    if (value->text == "false" || value->text == "no") return false;
    refuse("'" + key + "' is " + shown(*value) + " but must be true or false");
}

Vec3 Fields::point(const std::string& key, const Range& range) {
    const YamlTree& value = require(key);
    if (value.kind != Kind::list || value.items.size() != 3)
        refuse("'" + key + "' is " + shown(value) + " but must be three numbers in mm, [x, y, z]");
    Vec3 point;
    for (int a = 0; a < 3; ++a) point[a] = parse(value.items[a], key, range);
    return point;
}

std::optional<Vec3> Fields::point_if(const std::string& key) {
    if (!has(key)) return {};
    return point(key);
}

Vec3 Fields::direction(const std::string& key) {
    const Vec3 p = point(key);
    if (!(p.norm() > 0)) refuse("'" + key + "' is [0, 0, 0] but must be a direction");
    return p.normalized();
}

std::array<double, 2> Fields::pair(const std::string& key, const Range& range) {
    const YamlTree& value = require(key);
    if (value.kind != Kind::list) {
        const double both = parse(value, key, range);
        return {both, both};
    }
    if (value.items.size() != 2)
        refuse("'" + key + "' is " + shown(value) + " but must be one number or two, [from, to]");
    return {parse(value.items[0], key, range), parse(value.items[1], key, range)};
}

std::vector<std::string> Fields::names(const std::string& key) {
    const YamlTree& value = require(key);
    if (value.kind != Kind::list) return {text(value, key)};
    std::vector<std::string> names;
    for (const YamlTree& item : value.items) {
        names.push_back(text(item, key));
        if (std::count(names.begin(), names.end(), names.back()) > 1)
            refuse("'" + names.back() + "' stands twice in '" + key + "'; write it once");
    }
    if (names.empty()) refuse("'" + key + "' is an empty list; name a tissue");
    return names;
}

std::vector<std::string> Fields::names_or_none(const std::string& key) {
    if (!has(key)) return {};
    return names(key);
}

void Fields::finish() const {
    for (const auto& entry : tree_.entries)
        if (std::find(asked_.begin(), asked_.end(), entry.first) == asked_.end())
            refuse("'" + entry.first + "' is not known here" + remedy_for(entry.first, asked_));
}

}  // namespace myotet::repair
