// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "Contraction/Scene.h"
#include "Contraction/Words.h"
#include "Repair/Fields.h"
#include "Repair/YamlTree.h"

namespace myotet::contraction {

using repair::Range;
using repair::YamlTree;

inline constexpr Range kSeconds{0, 1e6, false, "a time in s above 0"};
inline constexpr Range kSecondsOrZero{0, 1e6, true, "a time in s of at least 0"};

/// A map of a scene. Refusals are InputErrors "file:line: ..." at the value's line.
class Keys {
public:
    /// Refuses a tree that is no map and other keys than the known ones. `place`
    /// tells where the map stands, as in "'x' is not known in a body".
    Keys(const YamlTree& tree, const std::filesystem::path& file, std::string place,
         const std::vector<std::string>& known);

    /// Refuses other keys than these, now that the kind of thing is known.
    void only(const std::string& place, const std::vector<std::string>& known);

    [[nodiscard]] const YamlTree* find(const std::string& key) const;
    /// Refuses a missing key; `rule` says what it must be.
    [[nodiscard]] const YamlTree& require(const std::string& key, const std::string& rule) const;
    [[nodiscard]] bool has(const std::string& key) const { return find(key) != nullptr; }

    [[nodiscard]] Named word(const std::string& key, const std::string& rule) const;
    [[nodiscard]] double number(const std::string& key, const Range& range) const;
    [[nodiscard]] double number_or(const std::string& key, const Range& range,
                                   double otherwise) const;
    [[nodiscard]] Vec3 point(const std::string& key, const Range& range) const;
    /// Of a direction of any length, made unit; (0, 0, 0) is refused.
    [[nodiscard]] Vec3 direction(const std::string& key) const;
    /// One word or a list of at least one, each once.
    [[nodiscard]] std::vector<Named> words(const std::string& key, const std::string& rule) const;
    /// An existing file, relative to the scene's folder.
    [[nodiscard]] std::filesystem::path existing_file(const std::string& key) const;
    [[nodiscard]] std::filesystem::path existing_file_or_none(const std::string& key) const;
    /// One of these words.
    template <class Value>
    [[nodiscard]] Value choice_or(
        const std::string& key, Value otherwise,
        std::initializer_list<std::pair<const char*, Value>> choices) const;
    /// The only one of these keys that stands here.
    [[nodiscard]] std::string one_of(const std::vector<std::string>& keys) const;

    [[noreturn]] void refuse(const YamlTree& at, const std::string& why) const;
    [[noreturn]] void refuse(int line, const std::string& why) const;
    /// Refuses a value: "'key' is VALUE but must be RULE".
    [[noreturn]] void refuse_value(const YamlTree& value, const std::string& key,
                                   const std::string& rule) const;

    [[nodiscard]] const YamlTree& tree() const { return tree_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] double number_in(const YamlTree& scalar, const std::string& key,
                                   const Range& range) const;
    [[nodiscard]] Named word_in(const YamlTree& scalar, const std::string& key,
                                const std::string& rule) const;

private:
    const YamlTree& tree_;
    const std::filesystem::path& file_;
    std::string place_;
};

template <class Value>
Value Keys::choice_or(const std::string& key, Value otherwise,
                      std::initializer_list<std::pair<const char*, Value>> choices) const {
    const YamlTree* value = find(key);
    if (!value) return otherwise;
    std::vector<std::string> known;
    for (const auto& [name, chosen] : choices) {
        if (value->kind == YamlTree::Kind::scalar && value->text == name) return chosen;
        known.emplace_back(name);
    }
    refuse_value(*value, key, "one of " + list_of(known));
}

}  // namespace myotet::contraction
