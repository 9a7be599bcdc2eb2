// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "LevelSetStage.h"
#include "Scan.h"

namespace myotet::app {

/// What a file is by its extension.
enum class InputKind { labels, surface, tetrahedra, level_set, unknown };
[[nodiscard]] InputKind kind_of(const std::filesystem::path& file);

/// Options that were given and that only a label file has a meaning for:
/// --labels, --names, --orientation, --one-hot, --close-gaps.
[[nodiscard]] std::vector<std::string> label_options_given(const ScanOptions& options);

/// Throws UsageError that names the options, if there are any: they mean
/// nothing for `file`, which is `what`.
void refuse_options(const std::vector<std::string>& options, const std::filesystem::path& file,
                    const std::string& what);

}  // namespace myotet::app
