// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "Core/Geometry.h"

namespace myotet::levelset {

/// phi and its gradient at a point.
struct Sample {
    double value = 0;              ///< mm, negative inside
    Vec3 gradient = Vec3::Zero();  ///< of the interpolant, dimensionless
};

/// A signed distance in local coordinates (mm): negative inside, positive
/// outside. Exact samples in a narrow band of bricks around the surface, and
/// a coarse dense field everywhere else, so that values deep inside are right
/// too and memory grows with surface area.
///
/// Fine sample (i, j, k) sits at origin + spacing * (i, j, k); a brick holds 8
/// cells a side, that is 9 x 9 x 9 samples (the last layer is the next brick's
/// first), so that interpolation never leaves a brick. Where a brick reaches
/// past the band, its samples come from the coarse field.
struct LevelSet {
    static constexpr int kBrickCells = 8;
    static constexpr int kBrickSamples = 9;
    static constexpr int kBrickSize = kBrickSamples * kBrickSamples * kBrickSamples;

    Vec3 origin = Vec3::Zero();          ///< position of fine sample (0, 0, 0), mm
    double spacing = 0;                  ///< fine sample distance, mm
    double band = 0;                     ///< |phi| up to here comes from fine samples, mm
    Index3 bricks{0, 0, 0};              ///< bricks along each axis
    std::vector<std::int32_t> brick_of;  ///< per brick, i fastest: number of its samples, or -1
    std::vector<float> values;           ///< kBrickSize samples a stored brick, i fastest, mm

    double coarse_spacing = 0;         ///< coarse sample distance, mm; same origin
    Index3 coarse_size{0, 0, 0};       ///< coarse samples along each axis; covers all bricks
    std::vector<float> coarse_values;  ///< i fastest, mm

    /// Cells of a brick, one bit each, a word per plane k, bit 8 j + i.
    struct Seamed {
        std::array<std::uint64_t, kBrickCells> cells{};
        std::array<std::uint32_t, kBrickCells> first{};  ///< of a plane, in pieces_of
    };
    /// Where a wall turns from one neighbour to the next within a cell, phi is the
    /// largest of several trilinear functions, the cell's pieces; see Seams. At
    /// samples they agree with `values`, but for cells that the surface does not cut.
    std::int32_t first_seamed = std::numeric_limits<std::int32_t>::max();  ///< brick
    std::vector<Seamed> seamed;                ///< of the bricks from first_seamed on
    std::vector<std::uint32_t> pieces_of;      ///< per such cell its first piece, and an end
    std::vector<std::array<float, 8>> pieces;  ///< at the cell's corners, i fastest, mm

    /// The pieces of cell (i, j, k) of a stored brick; none for most.
    [[nodiscard]] std::span<const std::array<float, 8>> pieces_at(std::int32_t brick, int i, int j,
                                                                  int k) const {
        if (brick < first_seamed) return {};
        const Seamed& s = seamed[brick - first_seamed];
        const std::uint64_t bit = std::uint64_t{1} << (8 * j + i);
        if (!(s.cells[k] & bit)) return {};
        const std::size_t cell = s.first[k] + std::popcount(s.cells[k] & (bit - 1));
        return std::span(pieces).subspan(pieces_of[cell], pieces_of[cell + 1] - pieces_of[cell]);
    }

    /// Trilinear interpolation; outside the stored box, the value at the nearest
    /// point of the box plus the distance to it (a bound on the true distance).
    [[nodiscard]] double value(const Vec3& point) const;
    /// The same with the gradient of the interpolant, in one pass.
    [[nodiscard]] Sample sample(const Vec3& point) const;
    /// The box that the samples cover.
    [[nodiscard]] Box box() const;
    /// Bytes held.
    [[nodiscard]] std::size_t memory() const;
};

/// Principal curvatures (k1, k2) of the isosurface through `point`, 1/mm, for
/// the outward normal: a sphere of radius R has k1 = k2 = 1/R. By central
/// differences over `step` mm, projected on the tangent plane
/// [Teran05, sec. 5]. |k1| + |k2| is the measure that refinement uses.
[[nodiscard]] std::array<double, 2> principal_curvatures(const LevelSet& phi, const Vec3& point,
                                                         double step);

}  // namespace myotet::levelset
