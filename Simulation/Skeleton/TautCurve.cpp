// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/TautCurve.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace myotet::skeleton {
namespace {

using Vec2 = Eigen::Vector2d;
using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

constexpr int kSteps = 25, kHalvings = 5;
// A step of Newton's method below this, of the surface's size, leaves an error of its square.
constexpr double kLastStep = 1e-8;
// Residuals below this, of the surface's size, are rounding.
constexpr double kRounding = 1e-14;
// Longest step: of the surface's size, and rad.
constexpr double kFarthest = 0.5;

/// A geodesic's end with the frame it carries.
struct End {
    Vec3 at, along, normal, aside;
    Vec3 lean_along, lean_aside;  ///< how the normal turns there when the point moves

    End(const WrapSurface& surface, const GeodesicPoint& point)
        : at(point.at), along(point.along), normal(surface.normal(at)), aside(along.cross(normal)) {
        lean_along = surface.normal_rate(at, along);
        lean_aside = surface.normal_rate(at, aside);
    }
    /// Off the straight line to p: out of the surface and sideways.
    [[nodiscard]] Vec2 error(const Vec3& p) const {
        return {(at - p).dot(normal), (at - p).dot(aside)};
    }
    /// How it changes when the point moves ahead and sideways and the direction turns.
    [[nodiscard]] Vec2 error_rate(const Vec3& p, double ahead, double sideways, double turn) const {
        const Vec3 offset = at - p, lean = ahead * lean_along + sideways * lean_aside;
        const Vec3 turned = turn * aside - along.dot(lean) * normal;
        const Vec3 aside_rate = turned.cross(normal) + along.cross(lean);
        return {offset.dot(lean), sideways + offset.dot(aside_rate)};
    }
};

struct Newton {
    Vec4 error;  ///< mm
    Mat4 rate;   ///< of the error with the start ahead, aside, turned, and the length
};

Newton newton_of(const WrapSurface& surface, const TautCurve& curve, const Vec3& from,
                 const Vec3& to) {
    const End start(surface, curve.start), end(surface, curve.end.point);
    const GeodesicEnd& e = curve.end;
    Newton newton;
    newton.error << start.error(from), end.error(to);
    newton.rate.col(0) << start.error_rate(from, 1, 0, 0), end.error_rate(to, 1, 0, 0);
    newton.rate.col(1) << start.error_rate(from, 0, 1, 0),
        end.error_rate(to, 0, e.shift, e.shift_rate);
    newton.rate.col(2) << start.error_rate(from, 0, 0, 1),
        end.error_rate(to, 0, e.turn, e.turn_rate);
    newton.rate.col(3) << 0, 0, end.error_rate(to, 1, 0, 0);
    return newton;
}

/// A point moved over the surface with its direction.
GeodesicPoint move(const WrapSurface& surface, const GeodesicPoint& point, double ahead,
                   double sideways, double turn) {
    const Vec3 aside = point.along.cross(surface.normal(point.at));
    GeodesicPoint moved;
    moved.at = surface.settle(point.at + ahead * point.along + sideways * aside);
    const Vec3 normal = surface.normal(moved.at);
    const Vec3 along = std::cos(turn) * point.along + std::sin(turn) * aside;
    moved.along = (along - along.dot(normal) * normal).normalized();
    return moved;
}

TautCurve shoot(const WrapSurface& surface, const GeodesicPoint& start, double length) {
    return {start, length, follow_geodesic(surface, start, length)};
}

TautCurve step_to(const WrapSurface& surface, const TautCurve& curve, const Vec4& step) {
    return shoot(surface, move(surface, curve.start, step[0], step[1], step[2]),
                 curve.length + step[3]);
}

/// The last, tiny step, without following the geodesic anew.
TautCurve finish(const WrapSurface& surface, TautCurve curve, const Vec4& step) {
    curve.start = move(surface, curve.start, step[0], step[1], step[2]);
    const GeodesicEnd& e = curve.end;
    curve.end.point =
        move(surface, e.point, step[0] + step[3], e.shift * step[1] + e.turn * step[2],
             e.shift_rate * step[1] + e.turn_rate * step[2]);
    curve.length += step[3];
    return curve;
}

/// Its length where a turn counts as a way of the surface's size.
double size_of(const Vec4& step, double size) {
    return std::max(
        {std::abs(step[0]), std::abs(step[1]), std::abs(step[2]) * size, std::abs(step[3])});
}

}  // namespace

std::optional<TautCurve> tighten(const WrapSurface& surface, const Vec3& from, const Vec3& to,
                                 const TautGuess& guess) {
    const double size = surface.size();
    const double longest = 2 * std::numbers::pi * (size + surface.core());  // around it once
    TautCurve curve = shoot(surface, guess.start, guess.length);
    Newton newton = newton_of(surface, curve, from, to);
    for (int n = 0; n < kSteps; ++n) {
        Vec4 step = -newton.rate.partialPivLu().solve(newton.error);
        const double far = size_of(step, size);
        if (!std::isfinite(far)) return std::nullopt;
        if (far < kLastStep * size || newton.error.norm() < kRounding * size)
            return finish(surface, curve, step);
        if (far > kFarthest * size) step *= kFarthest * size / far;
        if (!(std::abs(curve.length + step[3]) < longest)) return std::nullopt;
        TautCurve next;
        Newton next_newton;
        int half = 0;
        for (; half < kHalvings; ++half, step *= 0.5) {
            next = step_to(surface, curve, step);
            next_newton = newton_of(surface, next, from, to);
            if (next_newton.error.norm() < newton.error.norm()) break;
        }
        if (half == kHalvings) return std::nullopt;
        curve = next;
        newton = next_newton;
    }
    return std::nullopt;
}

double spread(const TautCurve& curve, const Vec3& from, const Vec3& to) {
    const double before = (curve.start.at - from).norm(), after = (to - curve.end.point.at).norm();
    const GeodesicEnd& e = curve.end;
    const double there = before * e.shift + e.turn;
    return std::min(there, there + after * (before * e.shift_rate + e.turn_rate));
}

}  // namespace myotet::skeleton
