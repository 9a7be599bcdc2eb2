// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string_view>

#include "Core/Errors.h"

namespace myotet::muscle {

/// Throws InputError with the name, its value and the rule unless that holds.
inline void require(bool holds, std::string_view name, double value, std::string_view rule) {
    if (holds) return;
    std::ostringstream text;
    text << name << " is " << value << ", but " << rule;
    throw InputError(text.str());
}

}  // namespace myotet::muscle
