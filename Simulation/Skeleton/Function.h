// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace myotet::skeleton {

/// How a quantity depends on one number, such as a coordinate of a joint.
enum class FunctionKind {
    constant,          ///< coefficients[0]
    linear,            ///< coefficients[0] x + coefficients[1]
    polynomial,        ///< coefficients[0] x^n + ... + coefficients[n]
    sine,              ///< coefficients: amplitude, omega, phase, offset
    cubic_spline,      ///< through (x, y), straight on beyond its ends
    piecewise_linear,  ///< through (x, y), straight on beyond its ends
};

/// `scale` times the function of its kind.
struct Function {
    FunctionKind kind = FunctionKind::constant;
    std::vector<double> coefficients;
    std::vector<double> x, y;  ///< knots, x ascending
    std::vector<double> bend;  ///< second derivatives at the knots of a cubic spline
    double scale = 1;
};

[[nodiscard]] Function constant_function(double value);
/// Without bend at its ends. x ascending, at least two. Throws InputError.
[[nodiscard]] Function natural_spline(std::vector<double> x, std::vector<double> y);
/// As SIMM and OpenSim fit it: the third derivatives at its ends are those of the cubics
/// through the first and the last four points [Forsythe 1977, sec. 4.4]; a parabola through
/// three points. Throws InputError.
[[nodiscard]] Function simm_spline(std::vector<double> x, std::vector<double> y);
/// Straight between points and beyond them. Throws InputError.
[[nodiscard]] Function piecewise_linear(std::vector<double> x, std::vector<double> y);

/// g with g(factor x) = f(x): the function of the same quantity in another unit.
[[nodiscard]] Function with_input_unit(Function f, double factor);

/// The function and its first and second derivative.
struct FunctionValue {
    double value = 0, slope = 0, bend = 0;
};
/// Cost: O(log n).
[[nodiscard]] FunctionValue evaluate(const Function& function, double x);

}  // namespace myotet::skeleton
