// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "Cage/Predicates.h"

namespace myotet::cage {

/// How the largest angle and the aspect ratio are weighed against the smallest angle.
struct Scale {
    double large = 0.7;        ///< degrees a degree that the largest angle leaves to 180
    double slenderness = 105;  ///< degrees of an aspect ratio of 1
};

/// A score of shapes in degrees, of which a tetrahedron has the least of three: its smallest
/// dihedral angle; `large` times what the largest leaves to 180; `slenderness` over its aspect
/// ratio, the longest edge by the shortest altitude. At 30 degrees that is by default 30, 137
/// and 3.5. 0 when it is not positive. A regular one has 70.5, one of the lattice 60.
[[nodiscard]] double score_deg(const Corners4& t, const Scale& scale = {});

/// What a score allows: cosines of the smallest and the largest angle, and the aspect ratio.
struct Level {
    double low = 0, high = 0, aspect = 0;
};
[[nodiscard]] Level level_of(double score_deg, const Scale& scale);

/// Sum over dihedral angles of exp((c - low) / w) + exp((high - c) / w), c their cosines, and
/// exp((r / aspect - 1) / (3 w)) of the aspect ratio r: one for what is at the level, e times
/// that where a cosine is w beyond. Infinite when not positive.
[[nodiscard]] double badness(const Corners4& t, const Level& level);
inline constexpr double kWidth = 0.03;

/// Circumcentre of a tetrahedron.
[[nodiscard]] Vec3 circumcentre(const Corners4& t);

}  // namespace myotet::cage
