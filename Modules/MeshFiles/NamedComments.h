// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace myotet::meshfiles {

/// What Myotet's comments say in formats that have numbers but no names:
/// lines `label 7=biceps`, `faces 1007=biceps|exterior`, `nodes 1=...`.
struct NamedComments {
    std::map<std::int64_t, std::string> labels, faces, nodes;
    std::string space;
};

/// Looks at the lines that begin with `mark`.
[[nodiscard]] NamedComments read_comments(std::string_view content, char mark);

}  // namespace myotet::meshfiles
