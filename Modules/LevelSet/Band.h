// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/LevelSet.h"

#include <cstdint>
#include <vector>

namespace myotet::levelset {

/// The working form of a level set while it is made: samples of an isotropic
/// lattice in blocks of 8 x 8 x 8 wherever |phi| < width, and a table of all
/// blocks that finds neighbours in one look-up. Blocks that are not stored lie
/// wholly inside or wholly outside.
///
/// Sample (i, j, k) sits at origin + spacing * (i, j, k). Values are clamped
/// to [-width, width] and right in sign everywhere.
struct Band {
    static constexpr int kSide = 8;
    static constexpr int kSize = kSide * kSide * kSide;
    static constexpr std::int32_t kOutside = -1, kInside = -2;

    Vec3 origin = Vec3::Zero();          ///< position of sample (0, 0, 0), mm
    double spacing = 0;                  ///< mm
    float width = 0;                     ///< samples with |phi| < width are distances, mm
    Index3 blocks{0, 0, 0};              ///< blocks along each axis
    std::vector<std::int32_t> block_of;  ///< per block, i fastest: its number, kOutside or kInside
    std::vector<Index3> position;        ///< per stored block: its place among the blocks
    std::vector<float> values;           ///< kSize a stored block, i fastest, mm

    [[nodiscard]] std::size_t slot(const Index3& b) const {
        return (static_cast<std::size_t>(b[2]) * blocks[1] + b[1]) * blocks[0] + b[0];
    }
    /// Number of the block, or kOutside beyond the table.
    [[nodiscard]] std::int32_t find(const Index3& b) const {
        for (int a = 0; a < 3; ++a)
            if (b[a] < 0 || b[a] >= blocks[a]) return kOutside;
        return block_of[slot(b)];
    }
    [[nodiscard]] float* block(std::int32_t number) {
        return values.data() + static_cast<std::size_t>(number) * kSize;
    }
    [[nodiscard]] const float* block(std::int32_t number) const {
        return values.data() + static_cast<std::size_t>(number) * kSize;
    }
    /// What an unstored block holds everywhere.
    [[nodiscard]] float empty_value(std::int32_t number) const {
        return number == kInside ? -width : width;
    }
};

/// Copies the samples of block `b` with `low` layers of its lower and `high`
/// layers of its upper neighbours, i fastest, into (low + 8 + high)^3 floats.
/// The block need not be stored.
void gather(const Band& band, const Index3& b, int low, int high, float* out);

/// Marks every unstored block as inside or outside from the stored ones. The
/// outermost blocks must lie outside or be stored, and no interface may run
/// between a stored and an unstored block.
void mark_unstored_blocks(Band& band);

/// Trilinear value and gradient at a point, clamped to the band's lattice;
/// beyond the band the value is the clamped one.
[[nodiscard]] Sample sample(const Band& band, const Vec3& point);

/// Turns a band into the form that meshing samples: bricks with aprons, and a
/// coarse field of distances to the nearest point of the interface.
/// Cost: O(stored blocks + all coarse samples).
[[nodiscard]] LevelSet assemble(const Band& band);

}  // namespace myotet::levelset
