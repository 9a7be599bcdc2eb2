// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace myotet::meshfiles {

/// A number as files store it.
enum class NumberKind {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64
};

/// The numbers in bytes; a rest that is shorter than a number is left out.
[[nodiscard]] std::vector<double> reals_in(std::string_view bytes, NumberKind kind,
                                           bool big_endian);
/// As reals_in; `kind` is an integer's. Values beyond 2^63 become negative.
[[nodiscard]] std::vector<std::int64_t> integers_in(std::string_view bytes, NumberKind kind,
                                                    bool big_endian);

}  // namespace myotet::meshfiles
