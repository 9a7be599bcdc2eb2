// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "LevelSet/LevelSet.h"

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
    std::int32_t beyond = kOutside;      ///< what lies around the table: kOutside or kInside
    std::vector<std::int32_t> block_of;  ///< per block, i fastest: its number, kOutside or kInside
    std::vector<Index3> position;        ///< per stored block: its place among the blocks
    std::vector<float> values;           ///< kSize a stored block, i fastest, mm

    [[nodiscard]] std::size_t slot(const Index3& b) const {
        return (static_cast<std::size_t>(b[2]) * blocks[1] + b[1]) * blocks[0] + b[0];
    }
    /// Number of the block, kOutside or kInside.
    [[nodiscard]] std::int32_t find(const Index3& b) const {
        for (int a = 0; a < 3; ++a)
            if (b[a] < 0 || b[a] >= blocks[a]) return beyond;
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
/// layers of its upper neighbours, i fastest, into (low + 8 + high)^3 places.
/// `empty` names what an unstored block, by its number, holds everywhere; the
/// block itself need not be stored. `samples` are kSize a stored block.
template <class T, class Empty>
void gather(const Band& band, const T* samples, const Index3& b, int low, int high, Empty&& empty,
            T* out) {
    constexpr int n = Band::kSide;
    const int side = low + n + high;
    // Of each axis: where the lower neighbour, the block and the upper one
    // begin and end in `out`, and the source's first sample there.
    const int begin[3] = {0, low, low + n}, end[3] = {low, low + n, side},
              first[3] = {n - low, 0, 0};
    for (int z = low ? 0 : 1; z <= (high ? 2 : 1); ++z)
        for (int y = low ? 0 : 1; y <= (high ? 2 : 1); ++y)
            for (int x = low ? 0 : 1; x <= (high ? 2 : 1); ++x) {
                const std::int32_t number = band.find({b[0] + x - 1, b[1] + y - 1, b[2] + z - 1});
                const T* source = number >= 0
                                      ? samples + static_cast<std::size_t>(number) * Band::kSize
                                      : nullptr;
                for (int k = begin[z]; k < end[z]; ++k)
                    for (int j = begin[y]; j < end[y]; ++j) {
                        T* row = out + (k * side + j) * side;
                        if (!source) {
                            std::fill(row + begin[x], row + end[x], empty(number));
                            continue;
                        }
                        const T* from =
                            source + ((k - begin[z] + first[z]) * n + j - begin[y] + first[y]) * n +
                            first[x];
                        std::copy(from, from + (end[x] - begin[x]), row + begin[x]);
                    }
            }
}

/// The same for the band's own values.
void gather(const Band& band, const Index3& b, int low, int high, float* out);

/// Marks every unstored block as inside or outside from the stored ones. The
/// outermost blocks must be stored or agree with `beyond`, and no interface may
/// run between a stored and an unstored block.
void mark_unstored_blocks(Band& band);

/// Trilinear value and gradient at a point, clamped to the band's lattice;
/// beyond the band the value is the clamped one.
[[nodiscard]] Sample sample(const Band& band, const Vec3& point);

/// Turns a band into the form that meshing samples: bricks with aprons, and a
/// coarse field of distances to the nearest point of the interface.
/// Cost: O(stored blocks + all coarse samples).
[[nodiscard]] LevelSet assemble(const Band& band);

}  // namespace myotet::levelset
