// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/Numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "Core/Errors.h"

namespace myotet::meshfiles {
namespace {

template <class Stored, class Number>
std::vector<Number> copied(std::string_view bytes, bool big_endian) {
    const bool turn = big_endian != (std::endian::native == std::endian::big);
    std::vector<Number> numbers(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::array<char, sizeof(Stored)> raw;
        std::memcpy(raw.data(), bytes.data() + i * sizeof(Stored), sizeof(Stored));
        if (turn) std::ranges::reverse(raw);
        numbers[i] = static_cast<Number>(std::bit_cast<Stored>(raw));
    }
    return numbers;
}

template <class Number>
std::vector<Number> integers_as(std::string_view bytes, NumberKind kind, bool big_endian) {
    switch (kind) {
        case NumberKind::int8:
            return copied<std::int8_t, Number>(bytes, big_endian);
        case NumberKind::uint8:
            return copied<std::uint8_t, Number>(bytes, big_endian);
        case NumberKind::int16:
            return copied<std::int16_t, Number>(bytes, big_endian);
        case NumberKind::uint16:
            return copied<std::uint16_t, Number>(bytes, big_endian);
        case NumberKind::int32:
            return copied<std::int32_t, Number>(bytes, big_endian);
        case NumberKind::uint32:
            return copied<std::uint32_t, Number>(bytes, big_endian);
        case NumberKind::int64:
            return copied<std::int64_t, Number>(bytes, big_endian);
        case NumberKind::uint64:
            return copied<std::uint64_t, Number>(bytes, big_endian);
        default:
            throw LogicError("an integer array holds integers");
    }
}

}  // namespace

std::vector<double> reals_in(std::string_view bytes, NumberKind kind, bool big_endian) {
    if (kind == NumberKind::float32) return copied<float, double>(bytes, big_endian);
    if (kind == NumberKind::float64) return copied<double, double>(bytes, big_endian);
    return integers_as<double>(bytes, kind, big_endian);
}

std::vector<std::int64_t> integers_in(std::string_view bytes, NumberKind kind, bool big_endian) {
    return integers_as<std::int64_t>(bytes, kind, big_endian);
}

}  // namespace myotet::meshfiles
