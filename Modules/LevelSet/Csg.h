// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "LevelSet/Band.h"

namespace myotet::levelset {

/// Constructive solid geometry on bands. All bands of one operation lie on one
/// lattice: same spacing, origins whole blocks apart. Every function returns
/// a band of kCsgWidth samples whose values are distances again; the interface
/// stays where the operation put it, to the last bit of the samples around it,
/// so that walls which two solids shared before are shared after.
inline constexpr double kCsgWidth = 3;

/// Where the lattice lies: blocks begin at anchor + 8 * spacing * (i, j, k).
struct CsgLattice {
    Vec3 anchor = Vec3::Zero();  ///< mm
    double spacing = 0;          ///< mm
};

/// Signed distance of a solid, mm; may be called from several threads.
using Distance = std::function<double(const Vec3&)>;

/// The working form of a level set: its fine samples. Values are kept bit for bit.
[[nodiscard]] Band to_band(const LevelSet& phi);

/// Samples a solid that lies inside `box`. Only blocks near the surface are
/// kept; `distance` must not change faster than a distance does.
[[nodiscard]] Band sample_solid(const Distance& distance, const Box& box,
                                const CsgLattice& lattice);

/// Distances again after the samples were changed: blocks wherever |phi| may be
/// below width samples, and a table with empty blocks all around.
[[nodiscard]] Band settle(const Band& band, double width = kCsgWidth);

/// Which blocks the result covers.
enum class Extent { first, all };

/// op of the values of all bands, sample by sample; where no band has a block,
/// op of their clamped values decides the sign. The result is not settled.
[[nodiscard]] Band merge(std::vector<const Band*> bands, Extent extent,
                         const std::function<float(const float*)>& op);

/// min(a, b). With a blend, the seam is filled by a circle's arc of that
/// radius r where both a < r and b < r: in the plane of the two distances,
///   phi = max(r, min(a, b)) - |(max(r - a, 0), max(r - b, 0))|,
/// exact where the surfaces meet at right angles; nothing changes farther than
/// r from either surface. Cost: O(blocks of both).
[[nodiscard]] Band unite(const Band& a, const Band& b, double blend = 0);
/// max(a, b), the seam rounded likewise.
[[nodiscard]] Band intersect(const Band& a, const Band& b, double blend = 0);
/// max(a, -b), the seam rounded likewise.
[[nodiscard]] Band subtract(const Band& a, const Band& b, double blend = 0);

/// The solid grown by `distance` mm, or shrunk where that is negative.
[[nodiscard]] Band offset(const Band& band, double distance);
/// Shrunk and grown back: what is thinner than twice the distance goes. The
/// rest of the surface stays as it was, sample by sample.
[[nodiscard]] Band opened(const Band& band, double distance);
/// Grown and shrunk back: gaps narrower than twice the distance fill.
[[nodiscard]] Band closed(const Band& band, double distance);

/// `changed` as far as `others` allow: what it has beyond `before` and lies in
/// one of them is taken away again, so that they share a wall.
[[nodiscard]] Band yielding(const Band& changed, const Band& before,
                            const std::vector<const Band*>& others);

/// True when no sample is inside.
[[nodiscard]] bool is_empty(const Band& band);
/// Of the part that is inside, mm; empty when nothing is.
[[nodiscard]] Box inside_box(const Band& band);

}  // namespace myotet::levelset
