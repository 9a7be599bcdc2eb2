// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// Where three regions meet, no trilinear function can follow a wall that
/// turns from one neighbour to the next within a cell: interpolants of the
/// partitioned samples leave gaps there. Before the partition each region r has
/// samples f_r, and the point x belongs to the region with the smallest
/// interpolant f_r(x). Hence, exactly,
///   phi_a(x) = max over b of g_ab(x),   g_ab = (f_a - f_b) / 2,
/// which at samples, and in cells where one b gives the largest value at all
/// corners, is what the samples say. The g_ab that matter are a cell's pieces.
struct Seams {
    using Corners = std::array<float, 8>;  ///< of a cell, i fastest, mm

    std::vector<Index3> cell;          ///< first sample of each cell, in the region's band
    std::vector<std::uint32_t> first;  ///< of each cell: number of its first piece
    std::vector<Corners> piece;        ///< of one cell after the other
};

/// The pieces of region `own` in a cell, from the samples of all regions that
/// come near it; none where the partitioned samples say the same, or where phi
/// keeps one sign and its distance `margin` from zero. Replaces `pieces`.
void find_pieces(std::span<const Seams::Corners> regions, std::size_t own, float margin,
                 std::vector<Seams::Corners>& pieces);

/// Cells that a cell with pieces is cut into along each axis, for its volume:
/// the corner of a wall is rounded in one of them only.
inline constexpr int kSeamSplit = 3;

/// The part of a cell where all pieces are negative.
[[nodiscard]] double inside_fraction(std::span<const Seams::Corners> pieces);

/// Gives a level set its seams; its bricks are numbered anew so that those with
/// seams come last. Cells of bricks that are not stored are left out.
void attach_seams(LevelSet& phi, const Seams& seams);

}  // namespace myotet::levelset
