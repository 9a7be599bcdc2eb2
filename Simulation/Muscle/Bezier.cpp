// SPDX-License-Identifier: Apache-2.0
#include "Muscle/Bezier.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "Core/Errors.h"

namespace myotet::muscle {
namespace {

// Of a curve's parameter, from 0 to 1, before the last step, which squares it.
constexpr double kParameterTolerance = 1e-12;
// Bisection alone would need 50.
constexpr int kMostIterations = 60;
// Tangents that differ by less than this part of themselves are one straight line.
constexpr double kParallel = 1e-12;

struct Polynomial {
    double value, slope;  ///< by the parameter
};

// de Casteljau's construction: the last but one step holds the derivative.
Polynomial bezier(std::array<double, 6> p, double u) {
    for (int left = 5; left > 1; --left)
        for (int i = 0; i < left; ++i) p[i] += u * (p[i + 1] - p[i]);
    return {p[0] + u * (p[1] - p[0]), 5 * (p[1] - p[0])};
}

// The u with x(u) = x, x(u) never falling: Newton's method within a bracket.
double parameter_at(const std::array<double, 6>& control, double x) {
    double low = 0, high = 1;
    double u = (x - control[0]) / (control[5] - control[0]);
    for (int i = 0; i < kMostIterations; ++i) {
        const Polynomial at = bezier(control, u);
        (at.value < x ? low : high) = u;
        double next = u - (at.value - x) / at.slope;
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        if (std::abs(next - u) <= kParameterTolerance) return next;
        u = next;
    }
    return u;
}

// Where the tangents of two knots meet.
CurveKnot corner(const CurveKnot& a, const CurveKnot& b) {
    const double turn = a.slope - b.slope;
    const double steep = std::max(std::abs(a.slope), std::abs(b.slope));
    if (std::abs(turn) <= kParallel * steep || turn == 0)
        return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0};
    const double x = (b.y - a.y - b.x * b.slope + a.x * a.slope) / turn;
    return {x, a.y + (x - a.x) * a.slope, 0};
}

}  // namespace

BezierCurve::BezierCurve(const std::vector<CurveKnot>& knots, const std::vector<double>& curviness)
    : first_(knots.front()), last_(knots.back()) {
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const CurveKnot &a = knots[i], &b = knots[i + 1], meet = corner(a, b);
        const double curvy = curviness.size() > 1 ? curviness.at(i) : curviness.at(0);
        if (!(curvy >= 0 && curvy <= 1))
            throw InputError("curviness of a curve must lie between 0 and 1");
        if (!(a.x < b.x && meet.x >= a.x && meet.x <= b.x)) {
            std::ostringstream text;
            text << "a curve cannot bend from x = " << a.x << ", y = " << a.y << ", slope "
                 << a.slope << " to x = " << b.x << ", y = " << b.y << ", slope " << b.slope
                 << " in one bow: its tangents do not meet between";
            throw InputError(text.str());
        }
        // A curviness of 0 would leave no bow, one of 1 put all four points on the corner.
        const double c = 0.1 + 0.8 * curvy;
        const double ax = a.x + c * (meet.x - a.x), ay = a.y + c * (meet.y - a.y);
        const double bx = b.x + c * (meet.x - b.x), by = b.y + c * (meet.y - b.y);
        pieces_.push_back({{a.x, ax, ax, bx, bx, b.x}, {a.y, ay, ay, by, by, b.y}});
    }
}

CurvePoint BezierCurve::operator()(double x) const {
    if (pieces_.empty()) return {};
    if (x <= first_.x) return {first_.y + first_.slope * (x - first_.x), first_.slope};
    if (x >= last_.x) return {last_.y + last_.slope * (x - last_.x), last_.slope};
    const auto ends_before = [](const Piece& piece, double at) { return piece.x[5] <= at; };
    const Piece& piece = *std::lower_bound(pieces_.begin(), pieces_.end(), x, ends_before);
    const double u = parameter_at(piece.x, x);
    const Polynomial px = bezier(piece.x, u), py = bezier(piece.y, u);
    return {py.value, py.slope / px.slope};
}

}  // namespace myotet::muscle
