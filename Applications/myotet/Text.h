// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "Core/Text.h"

namespace myotet::app {

/// A number as people read it: three digits.
[[nodiscard]] inline std::string readable(double number) { return formatted("%.3g", number); }

/// "1 voxel", "2 voxels".
[[nodiscard]] inline std::string counted(std::int64_t count, const std::string& thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

}  // namespace myotet::app
