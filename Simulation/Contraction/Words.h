// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Core/Text.h"

namespace myotet::contraction {

using myotet::refuse;  // beside the scene's own

/// "; did you mean 'x'? Known are x, y, z": the remedy for a word that is none of these.
[[nodiscard]] std::string known_are(const std::string& word,
                                    const std::vector<std::string>& candidates);

}  // namespace myotet::contraction
