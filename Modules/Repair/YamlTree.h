// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace myotet::repair {

/// A YAML document as plain data, with the lines it came from.
struct YamlTree {
    enum class Kind { nothing, scalar, list, map };
    Kind kind = Kind::nothing;
    int line = 0;                                           ///< from 1
    std::string text;                                       ///< of a scalar
    std::vector<YamlTree> items;                            ///< of a list
    std::vector<std::pair<std::string, YamlTree>> entries;  ///< of a map, in the file's order
    int key_line = 0;                                       ///< of the key it is the value of
};

/// Throws IoError when the file cannot be read, InputError with the line when
/// it is no YAML, is nested deeper or larger than recipes and scenes are, or names a
/// key twice.
[[nodiscard]] YamlTree read_yaml(const std::filesystem::path& file);

/// What stands there, for a sentence: "'word'", "a list of 3", "a map of keys" or "empty".
[[nodiscard]] std::string shown(const YamlTree& tree);

}  // namespace myotet::repair
