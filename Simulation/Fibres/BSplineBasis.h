// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace myotet::fibres {

inline constexpr int kMostDegree = 3;

/// The basis functions of a clamped uniform B-spline on [0, 1] that are not zero at t:
/// value[0] to value[degree] belong to the control points `first` and following.
struct Basis {
    int first = 0;
    std::array<double, kMostDegree + 1> value{}, slope{};  ///< slope: d/dt
};

/// `count` control points, more than `degree`, which is 1 to kMostDegree; t is clamped.
/// Knots: 0 and 1 `degree` + 1 times, between them every 1 / (count - degree).
/// Source: [Piegl97, algorithms A2.2, A2.3].
[[nodiscard]] Basis basis_at(int degree, int count, double t);

/// The parameter at which a control point sits in a function that is linear in t: the
/// mean of `degree` knots [Piegl97, sec. 9.2].
[[nodiscard]] double greville(int degree, int count, int control);

}  // namespace myotet::fibres
