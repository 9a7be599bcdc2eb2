// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Repair/Fields.h"
#include "Repair/Recipe.h"

namespace myotet::repair {

/// A tissue's name, a solid or a surface file, under `key` of a step.
[[nodiscard]] Operand read_operand(Fields& step, const std::string& key);

}  // namespace myotet::repair
