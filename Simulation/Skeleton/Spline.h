// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Skeleton/Function.h"

namespace myotet::skeleton {

/// How a spline through points ends.
enum class SplineEnds {
    natural,  ///< nothing pulls at it: derivatives from order (degree + 1) / 2 on are 0
    at_rest,  ///< without slope, and without bend where the degree is 5
};

/// A piecewise polynomial of degree 5 or 3, by value, slope and bend at its knots.
struct Spline {
    std::vector<double> x;  ///< ascending
    std::vector<double> y, slope, bend;
};

/// The spline of degree 3 or 5 through points: of all functions through them the one with
/// the least integral of the square of its second (third) derivative [de Boor 1978, ch. V].
/// x ascending; natural ends need at least 2 points (degree 5: 3). Cost: O(n).
/// Throws InputError.
[[nodiscard]] Spline spline_through(std::span<const double> x, std::span<const double> y,
                                    int degree, SplineEnds ends);

/// Value and derivatives; beyond the ends its first or last piece goes on. Cost: O(log n).
[[nodiscard]] FunctionValue evaluate(const Spline& spline, double x);

}  // namespace myotet::skeleton
