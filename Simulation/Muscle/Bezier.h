// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace myotet::muscle {

/// A curve and its first derivative at one place.
struct CurvePoint {
    double value = 0, slope = 0;
};

/// A point that a curve passes and its slope there.
struct CurveKnot {
    double x = 0, y = 0, slope = 0;
};

/// A smooth curve y(x) through knots with their slopes: between two of them a quintic Bezier
/// curve whose inner control points lie on the two tangents, doubled, so that the second
/// derivative is zero at each knot; beyond the first and the last straight on [Millard 2013,
/// appendix].
class BezierCurve {
public:
    BezierCurve() = default;  ///< nothing anywhere
    /// knots: x ascending, at least two, no three neighbours such that two tangents that meet
    /// between knots are parallel but apart; curviness of a piece from 0, almost straight, to
    /// 1, close to the corner of its tangents: one a piece, or one for all. Throws InputError
    /// when tangents do not meet between their knots.
    BezierCurve(const std::vector<CurveKnot>& knots, const std::vector<double>& curviness);

    /// Cost: some five steps of Newton's method.
    [[nodiscard]] CurvePoint operator()(double x) const;

private:
    struct Piece {
        std::array<double, 6> x, y;  ///< control points
    };
    std::vector<Piece> pieces_;
    CurveKnot first_, last_;
};

}  // namespace myotet::muscle
