// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "Skeleton/Geodesic.h"

namespace myotet::skeleton {

/// A guess of a taut path: where it meets the surface, its unit direction there and how
/// long it stays on it.
struct TautGuess {
    GeodesicPoint start;
    double length = 0;  ///< mm
};

/// A geodesic that straight pieces from and to two points outside continue.
struct TautCurve {
    GeodesicPoint start;
    double length = 0;  ///< of the geodesic, mm; negative: the string would have to push
    GeodesicEnd end;
};

/// Newton's method for the four numbers of a geodesic - its start moves along or aside, its
/// direction turns, its length changes - so that the straight pieces are tangent to the
/// surface and in line with it at both ends:
///     (x - p) . n = 0,   (x - p) . b = 0     (n normal, b sideways)
/// with derivatives from the Jacobi fields of the geodesic [Scholz, Sherman, Stavness, Delp,
/// Kecskemethy 2016]. To 1e-12 of the surface's size, or none. Ends outside the surface.
/// Cost: two or three geodesics from a guess of the pose before.
[[nodiscard]] std::optional<TautCurve> tighten(const WrapSurface& surface, const Vec3& from,
                                               const Vec3& to, const TautGuess& guess);

/// A bound below which a taut path is no longer the shortest of those beside it: how far
/// apart two of them that leave `from` 1 rad apart are when they reach the end of the
/// geodesic, and `to`, whichever is less, mm.
[[nodiscard]] double spread(const TautCurve& curve, const Vec3& from, const Vec3& to);

}  // namespace myotet::skeleton
