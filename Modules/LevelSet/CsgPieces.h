// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "LevelSet/Band.h"

namespace myotet::levelset {

/// Which side of the interface falls into pieces.
enum class Side { inside, outside };

/// The pieces of one side: samples connected along the lattice's axes.
struct Pieces {
    Side side = Side::inside;
    std::vector<std::int32_t> of_sample;  ///< kSize a stored block: its piece, or -1
    std::vector<std::int32_t> of_slot;    ///< per place in the table: an unstored block's, or -1
    /// mm^3, largest first; equal ones by their first sample. Of the outside, the
    /// piece that reaches beyond the table comes first, its volume infinite.
    std::vector<double> volume;
};

/// Cost: O(samples). The table's outermost blocks must not be stored.
[[nodiscard]] Pieces find_pieces(const Band& band, Side side);

/// Per piece, of the inside: whether it shares a sample with the other solid.
[[nodiscard]] std::vector<char> pieces_meeting(const Band& band, const Pieces& pieces,
                                               const Band& other);

/// Gives the pieces that are marked to the other side: inside ones vanish,
/// outside ones fill.
[[nodiscard]] Band flip_pieces(const Band& band, const Pieces& pieces,
                               const std::vector<char>& marked);

}  // namespace myotet::levelset
