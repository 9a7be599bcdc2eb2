// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "Core/Geometry.h"
#include "Repair/YamlTree.h"

namespace myotet::repair {

/// The candidate that is written most like `word`, or empty when none is near.
[[nodiscard]] std::string nearest_word(const std::string& word,
                                       const std::vector<std::string>& candidates);
/// "; did you mean 'x'?" or "; known are a, b, c".
[[nodiscard]] std::string remedy_for(const std::string& word,
                                     const std::vector<std::string>& candidates);

/// What a number must be.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_itself = true;  ///< `low` is allowed too
    const char* rule = "a number";
};
inline constexpr Range kLength{0, 1e4, false, "a length in mm above 0 and at most 10000"};
inline constexpr Range kLengthOrZero{0, 1e4, true, "a length in mm from 0 to 10000"};
inline constexpr Range kVolume{0, 1e12, false, "a volume in mm^3 above 0"};
inline constexpr Range kArea{0, 1e9, true, "an area in mm^2 of at least 0"};
inline constexpr Range kCoordinate{-1e6, 1e6, true, "a coordinate in mm"};

/// A map of a recipe, read key by key; what was not asked for is refused at
/// the end. Every refusal is an InputError that begins with `where`.
class Fields {
public:
    /// Refuses a tree that is no map.
    Fields(const YamlTree& tree, std::string where);

    [[nodiscard]] const YamlTree* find(const std::string& key);
    [[nodiscard]] const YamlTree& require(const std::string& key);
    [[nodiscard]] bool has(const std::string& key) { return find(key) != nullptr; }

    [[nodiscard]] std::string word(const std::string& key);
    [[nodiscard]] std::string word_or(const std::string& key, const std::string& otherwise);
    [[nodiscard]] double number(const std::string& key, const Range& range);
    [[nodiscard]] double number_or(const std::string& key, const Range& range, double otherwise);
    [[nodiscard]] int count_or(const std::string& key, int low, int high, int otherwise);
    [[nodiscard]] bool flag_or(const std::string& key, bool otherwise);
    [[nodiscard]] Vec3 point(const std::string& key, const Range& range = kCoordinate);
    [[nodiscard]] std::optional<Vec3> point_if(const std::string& key);
    /// Of a direction of any length; (0, 0, 0) is refused.
    [[nodiscard]] Vec3 direction(const std::string& key);
    /// One number, or a list of two.
    [[nodiscard]] std::array<double, 2> pair(const std::string& key, const Range& range);
    /// One name or a list of at least one, each once.
    [[nodiscard]] std::vector<std::string> names(const std::string& key);
    [[nodiscard]] std::vector<std::string> names_or_none(const std::string& key);

    /// Refuses keys that nobody asked for.
    void finish() const;
    [[noreturn]] void refuse(const std::string& why) const;
    [[nodiscard]] const std::string& where() const { return where_; }
    [[nodiscard]] const YamlTree& tree() const { return tree_; }

private:
    [[nodiscard]] double parse(const YamlTree& scalar, const std::string& key,
                               const Range& range) const;
    [[nodiscard]] std::string text(const YamlTree& scalar, const std::string& key) const;

    const YamlTree& tree_;
    std::string where_;
    std::vector<std::string> asked_;
};

}  // namespace myotet::repair
