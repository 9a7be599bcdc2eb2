// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Function.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "Core/Errors.h"
#include "Core/Text.h"

namespace myotet::skeleton {
namespace {

/// Horner's rule, with the derivatives.
FunctionValue polynomial(const std::vector<double>& coefficients, double x) {
    FunctionValue p;
    for (const double c : coefficients) {
        p.bend = p.bend * x + 2 * p.slope;
        p.slope = p.slope * x + p.value;
        p.value = p.value * x + c;
    }
    return p;
}

FunctionValue sine(const std::vector<double>& c, double x) {
    const double phase = c[1] * x + c[2];
    return {c[0] * std::sin(phase) + c[3], c[0] * c[1] * std::cos(phase),
            -c[0] * c[1] * c[1] * std::sin(phase)};
}

/// The piece of the knots that x is in, the first or last one beyond them.
std::size_t piece_of(const std::vector<double>& knots, double x) {
    const auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, x);
    return static_cast<std::size_t>(after - knots.begin()) - 1;
}

FunctionValue through_knots(const Function& f, double x) {
    const std::size_t i = piece_of(f.x, x);
    const double h = f.x[i + 1] - f.x[i], slope = (f.y[i + 1] - f.y[i]) / h;
    if (f.kind == FunctionKind::piecewise_linear) return {f.y[i] + slope * (x - f.x[i]), slope, 0};
    // y = A y0 + B y1 + ((A^3 - A) m0 + (B^3 - B) m1) h^2 / 6,  A = (x1 - x) / h, B = 1 - A
    const double m0 = f.bend[i], m1 = f.bend[i + 1];
    const double inside = std::clamp(x, f.x.front(), f.x.back());
    const double a = (f.x[i + 1] - inside) / h, b = 1 - a;
    FunctionValue s;
    s.value =
        a * f.y[i] + b * f.y[i + 1] + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * h * h / 6;
    s.slope = slope + ((3 * b * b - 1) * m1 - (3 * a * a - 1) * m0) * h / 6;
    s.bend = a * m0 + b * m1;
    if (x != inside) {
        s.value += s.slope * (x - inside);
        s.bend = 0;
    }
    return s;
}

/// An end's equation for the bends of a cubic spline: m_end + next m_next = right.
struct End {
    double next = 0, right = 0;
};

void check_knots(const std::vector<double>& x, const std::vector<double>& y) {
    if (x.size() < 2 || y.size() != x.size())
        throw InputError("a function through points needs at least two x and as many y, but has " +
                         std::to_string(x.size()) + " and " + std::to_string(y.size()));
    for (std::size_t i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1]))
            throw InputError("x of a function's points must ascend, but " + shown(x[i]) +
                             " follows " + shown(x[i - 1]));
}

/// h_i-1 m_i-1 + 2 (h_i-1 + h_i) m_i + h_i m_i+1 = 6 (s_i - s_i-1), s the slopes between
/// points, by elimination of a tridiagonal matrix.
Function cubic_spline(std::vector<double> x, std::vector<double> y, End first, End last) {
    const std::size_t n = x.size();
    std::vector<double> m(n), upper(n);
    upper[0] = first.next;
    m[0] = first.right;
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
        const double pivot = 2 * (before + after) - before * upper[i - 1];
        const double right = 6 * ((y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before);
        upper[i] = after / pivot;
        m[i] = (right - before * m[i - 1]) / pivot;
    }
    m[n - 1] = (last.right - last.next * m[n - 2]) / (1 - last.next * upper[n - 2]);
    for (std::size_t i = n - 1; i-- > 0;) m[i] -= upper[i] * m[i + 1];
    Function f;
    f.kind = FunctionKind::cubic_spline;
    f.x = std::move(x);
    f.y = std::move(y);
    f.bend = std::move(m);
    return f;
}

/// The third derivative of the cubic through four points from i on.
double third_derivative(const std::vector<double>& x, const std::vector<double>& y, std::size_t i) {
    const auto slope = [&](std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); };
    const double before = (slope(i + 1) - slope(i)) / (x[i + 2] - x[i]);
    const double after = (slope(i + 2) - slope(i + 1)) / (x[i + 3] - x[i + 1]);
    return 6 * (after - before) / (x[i + 3] - x[i]);
}

}  // namespace

Function constant_function(double value) {
    Function f;
    f.coefficients = {value};
    return f;
}

Function natural_spline(std::vector<double> x, std::vector<double> y) {
    check_knots(x, y);
    return cubic_spline(std::move(x), std::move(y), {}, {});
}

Function simm_spline(std::vector<double> x, std::vector<double> y) {
    check_knots(x, y);
    const std::size_t n = x.size();
    if (n == 2) return natural_spline(std::move(x), std::move(y));
    End first{-1, 0}, last{-1, 0};
    if (n > 3) {
        first.right = -(x[1] - x[0]) * third_derivative(x, y, 0);
        last.right = (x[n - 1] - x[n - 2]) * third_derivative(x, y, n - 4);
    }
    return cubic_spline(std::move(x), std::move(y), first, last);
}

Function piecewise_linear(std::vector<double> x, std::vector<double> y) {
    check_knots(x, y);
    Function f;
    f.kind = FunctionKind::piecewise_linear;
    f.x = std::move(x);
    f.y = std::move(y);
    return f;
}

Function with_input_unit(Function f, double factor) {
    const std::size_t n = f.coefficients.size();
    if (f.kind == FunctionKind::linear || f.kind == FunctionKind::polynomial)
        for (std::size_t i = 0; i < n; ++i)
            f.coefficients[i] /= std::pow(factor, static_cast<double>(n - 1 - i));
    if (f.kind == FunctionKind::sine) f.coefficients[1] /= factor;
    for (double& x : f.x) x *= factor;
    for (double& bend : f.bend) bend /= factor * factor;
    return f;
}

FunctionValue evaluate(const Function& f, double x) {
    FunctionValue v;
    switch (f.kind) {
        case FunctionKind::constant:
            v.value = f.coefficients[0];
            break;
        case FunctionKind::linear:
        case FunctionKind::polynomial:
            v = polynomial(f.coefficients, x);
            break;
        case FunctionKind::sine:
            v = sine(f.coefficients, x);
            break;
        case FunctionKind::cubic_spline:
        case FunctionKind::piecewise_linear:
            v = through_knots(f, x);
            break;
    }
    return {f.scale * v.value, f.scale * v.slope, f.scale * v.bend};
}

}  // namespace myotet::skeleton
