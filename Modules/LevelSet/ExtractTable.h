// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace myotet::levelset {

// A cell's corner c lies at (c & 1, c >> 1 & 1, c >> 2). Its edge along axis a
// from corner `low` (bit a clear) to the one across.
[[nodiscard]] constexpr int edge_of(int axis, int low) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return 4 * axis + (low >> u & 1) + 2 * (low >> v & 1);
}
[[nodiscard]] constexpr int edge_low(int edge) {
    const int axis = edge / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
    return (edge & 1) << u | (edge >> 1 & 1) << v;
}

/// How the surface crosses a cell with given corners inside.
struct CellCut {
    std::uint8_t loops = 0;                  ///< closed curves on the cell's surface, three at most
    std::array<std::uint8_t, 12> loop_of{};  ///< per cut edge: its curve; kUncut elsewhere
    std::uint8_t twice = 0;                  ///< bit f: one curve crosses face f twice
    static constexpr std::uint8_t kUncut = 255;
};

/// By the corners inside, bit c for corner c.
[[nodiscard]] const std::array<CellCut, 256>& cell_cuts();

}  // namespace myotet::levelset
