// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "Core/Errors.h"

namespace myotet::dynamics {

/// Throws InputError with the field, its value and the rule unless that holds.
template <class Value>
void require(bool holds, const char* field, Value value, const char* rule) {
    if (!holds)
        throw InputError(std::string(field) + " is " + std::to_string(value) + ", but " + rule);
}

}  // namespace myotet::dynamics
