// SPDX-License-Identifier: Apache-2.0
#include "Surface/Field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Surface/Tangent.h"

namespace myotet::surface {
namespace {

constexpr int kSteps = 16;
constexpr double kFarthest = 2;  // in reaches, from where it began
// Of the reach, which is about an edge: far below the hundredth that is promised.
constexpr double kClose = 1e-4;
// A signed distance is never farther from its surface than |phi|; where an
// interpolated one is flatter, steps stay short of a neighbouring sheet.
constexpr double kLongestStep = 1.25;
// Squared sine of the angle between two gradients below which a step along both
// surfaces would be longer than what it corrects by a factor of about 30.
constexpr double kParallel = 1e-3;

Vec3 no_longer_than(const Vec3& step, double reach) {
    const double length = step.norm();
    return length > reach ? Vec3(step * (reach / length)) : step;
}

Vec3 newton_step(const FieldSample& s) {
    return -s.value / std::max(s.gradient.squaredNorm(), 1e-12) * s.gradient;
}

Vec3 newton_step(const FieldSample& s, const FieldSample& t) {
    const double a = s.gradient.squaredNorm(), b = s.gradient.dot(t.gradient),
                 c = t.gradient.squaredNorm();
    const double determinant = a * c - b * b;
    if (!(determinant > kParallel * a * c)) return newton_step(s);
    const double y = (-s.value * c + t.value * b) / determinant;
    const double z = (-t.value * a + s.value * b) / determinant;
    return y * s.gradient + z * t.gradient;
}

/// A zero of phi between two points where its signs differ, by false position
/// with the kept end's value halved (the Illinois rule).
Vec3 zero_between(const Field& phi, Vec3 a, double at_a, Vec3 b, double at_b, double close) {
    Vec3 middle = a;
    for (int i = 0; i < 2 * kSteps; ++i) {
        middle = a + (b - a) * (at_a / (at_a - at_b));
        const double value = phi(middle).value;
        if (std::abs(value) <= close) break;
        if ((value > 0) == (at_b > 0))
            at_a /= 2;
        else {
            a = b;
            at_a = at_b;
        }
        b = middle;
        at_b = value;
    }
    return middle;
}

/// Onto one and the other by turns, for kinks about which Newton's method goes to
/// and fro: where the surfaces cross at an angle a the error shrinks by cos^2 a.
std::optional<Vec3> in_turn(const Field& phi, const Field& psi, const Vec3& from, double reach) {
    std::optional<Vec3> at = from;
    for (int i = 0; i < kSteps && at; ++i) {
        at = project(psi, *at, reach);
        if (at) at = project(phi, *at, reach);
        if (at && std::abs(psi(*at).value) <= kClose * reach) break;
    }
    if (!at || !(std::abs(psi(*at).value) <= kClose * reach) ||
        !((*at - from).norm() <= kFarthest * reach))
        return std::nullopt;
    return at;
}

Vec3 unit_normal(const Field& phi, const Vec3& at) { return phi(at).gradient.normalized(); }

}  // namespace

Field half_space(const Vec3& on, const Vec3& outward) {
    const Vec3 n = outward.normalized();
    return [on, n](const Vec3& p) { return FieldSample{n.dot(p - on), n}; };
}

Field offset(Field field, double distance) {
    return [field = std::move(field), distance](const Vec3& p) {
        FieldSample s = field(p);
        s.value -= distance;
        return s;
    };
}

std::optional<Vec3> project(const Field& phi, const Vec3& from, double reach) {
    Vec3 at = from, before = from;
    double value_before = 0;
    for (int i = 0; i < kSteps; ++i) {
        const FieldSample s = phi(at);
        if (std::abs(s.value) <= kClose * reach) return at;
        if (s.value * value_before < 0) {
            const Vec3 zero = zero_between(phi, before, value_before, at, s.value, kClose * reach);
            return (zero - from).norm() <= kFarthest * reach ? std::optional(zero) : std::nullopt;
        }
        before = at;
        value_before = s.value;
        at += no_longer_than(newton_step(s), kLongestStep * std::abs(s.value));
        if (!((at - from).norm() <= kFarthest * reach)) return std::nullopt;
    }
    return std::nullopt;
}

std::optional<Vec3> project(const Field& phi, const Field& psi, const Vec3& from, double reach) {
    Vec3 at = from;
    for (int i = 0; i < kSteps; ++i) {
        const FieldSample s = phi(at), t = psi(at);
        if (std::max(std::abs(s.value), std::abs(t.value)) <= kClose * reach) return at;
        at += no_longer_than(newton_step(s, t), reach);
        if (!((at - from).norm() <= kFarthest * reach)) break;
    }
    return in_turn(phi, psi, from, reach);
}

double largest_curvature(const Field& phi, const Vec3& point, double step) {
    const auto [u, v] = tangents(unit_normal(phi, point));
    const auto turn = [&](const Vec3& t) {
        return Vec3((unit_normal(phi, point + step * t) - unit_normal(phi, point - step * t)) /
                    (2 * step));
    };
    // Eigenvalues of the shape operator's symmetric part in the basis (u, v).
    const Vec3 du = turn(u), dv = turn(v);
    const double a = du.dot(u), b = 0.5 * (du.dot(v) + dv.dot(u)), c = dv.dot(v);
    return 0.5 * std::abs(a + c) + std::hypot(0.5 * (a - c), b);
}

double thickness(const Field& phi, const Vec3& point, double limit) {
    const Vec3 n = unit_normal(phi, point);
    // Half way to the limit a slab that thick has phi = limit / 2 on both sides.
    const auto way = [&](double side) {
        double along = 0;
        for (int i = 0; i < kSteps && along < limit; ++i) {
            const double ahead = side * phi(point + side * along * n).value;
            if (i > 0 && ahead <= 0) return along;
            along += std::max(ahead, limit / kSteps);
        }
        return limit;
    };
    return std::min(way(-1), way(1));
}

}  // namespace myotet::surface
