// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "Core/Errors.h"

namespace myotet::activation {

/// Throws InputError "name is value, but rule" unless that holds.
inline void require(bool holds, std::string_view name, double value, std::string_view rule) {
    if (holds) return;
    std::ostringstream text;
    text << name << " is " << value << ", but " << rule;
    throw InputError(text.str());
}

/// Throws InputError unless there are so many numbers, each of which passes.
template <class Rule>
void require_each(const std::vector<double>& numbers, std::size_t count, std::string_view name,
                  std::string_view rule, Rule&& passes) {
    require(numbers.size() == count, std::string(name) + ".size()",
            static_cast<double>(numbers.size()), "it must be " + std::to_string(count));
    for (std::size_t i = 0; i < count; ++i)
        require(passes(numbers[i]), std::string(name) + "[" + std::to_string(i) + "]", numbers[i],
                rule);
}

}  // namespace myotet::activation
