// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Core/Text.h"

namespace myotet::contraction {

// So that this room's own functions of these names stand beside them.
using myotet::list_of;
using myotet::read_whole;
using myotet::refuse;
using myotet::shown;
using myotet::to_number;

/// "; did you mean 'x'? Known are x, y, z": the remedy for a word that is none of these.
[[nodiscard]] std::string known_are(const std::string& word,
                                    const std::vector<std::string>& candidates);

}  // namespace myotet::contraction
