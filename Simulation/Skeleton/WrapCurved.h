// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Skeleton/TautCurve.h"
#include "Skeleton/Wrap.h"

namespace myotet::skeleton {

/// A side on which a path may pass an ellipsoid or a torus, near a taut path.
struct WrapGuess {
    TautGuess curve;
    double length = 0;          ///< of the whole path, mm
    Vec3 side = Vec3::UnitX();  ///< from the object's middle to that of the contact
};

/// Paths in planes through both ends, all around the line between them: those that are
/// shorter than their neighbours, then those that are longer, each in order of length. None
/// where the straight piece passes clear.
[[nodiscard]] std::vector<WrapGuess> ellipsoid_guesses(const WrapSurface& surface, const Vec3& from,
                                                       const Vec3& to);

/// Which way a path goes past a ring.
enum class RingWay {
    through_hole,  ///< when its ends lie on both sides of the ring's plane
    nearest,
};
/// Paths over the cylinder that is tangent to the tube where the straight piece is most in
/// the way, or misses the hole, then over those beside it; none where it passes clear.
[[nodiscard]] std::vector<WrapGuess> torus_guesses(const WrapSurface& surface, const Vec3& from,
                                                   const Vec3& to, RingWay way);

/// As find_wrap; ends outside.
[[nodiscard]] Wrap wrap_curved(const WrapObject& object, const WrapSurface& surface,
                               const Vec3& from, const Vec3& to, const WrapMemory& before);

}  // namespace myotet::skeleton
