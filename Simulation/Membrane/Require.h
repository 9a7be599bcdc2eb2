// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <string>

#include "Core/Errors.h"

namespace myotet::membrane {

/// Throws InputError with the field, its value and the rule unless that holds.
inline void require(bool holds, const char* field, double value, const char* rule) {
    if (holds) return;
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    throw InputError(std::string(field) + " is " + std::string(text, end) + ", but " + rule);
}

}  // namespace myotet::membrane
