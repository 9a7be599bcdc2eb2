// SPDX-License-Identifier: Apache-2.0
#include "Surface/Field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Surface/Tangent.h"

namespace myotet::surface {
namespace {

constexpr int kSteps = 12;
constexpr double kFarthest = 2;  // in reaches, from where it began
// Of the reach, which is about an edge: far below the hundredth that is promised.
constexpr double kClose = 1e-4;
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

/// Steps until `evaluate(x)`, a pair of error and step, has a small error.
template <class Evaluate>
Vec3 iterate(const Vec3& from, double reach, const Evaluate& evaluate) {
    Vec3 at = from, best = from;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kSteps; ++i) {
        const auto [error, step] = evaluate(at);
        if (error < least) {
            least = error;
            best = at;
        }
        if (error <= kClose * reach) break;
        at += no_longer_than(step, reach);
        // Beyond, it is on its way to another part of the surface.
        if (!((at - from).norm() <= kFarthest * reach)) break;
    }
    return best;
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

Vec3 project(const Field& phi, const Vec3& from, double reach) {
    return iterate(from, reach, [&](const Vec3& at) {
        const FieldSample s = phi(at);
        return std::pair(std::abs(s.value), newton_step(s));
    });
}

Vec3 project(const Field& phi, const Field& psi, const Vec3& from, double reach) {
    return iterate(from, reach, [&](const Vec3& at) {
        const FieldSample s = phi(at), t = psi(at);
        return std::pair(std::max(std::abs(s.value), std::abs(t.value)), newton_step(s, t));
    });
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

}  // namespace myotet::surface
