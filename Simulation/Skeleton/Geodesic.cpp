// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Geodesic.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace myotet::skeleton {
namespace {

/// Position, direction, the sideways shifts and their rates.
using State = Eigen::Matrix<double, 10, 1>;

// Columns of the extrapolation: 2, 4, ... substeps, an error of order 2 columns.
constexpr int kColumns = 8;
// Of positions beside the surface's size and of directions; how sideways shifts need only
// lead Newton's method.
constexpr double kPrecision = 1e-13, kShiftPrecision = 1e-9;
// A step of this many radii of curvature to begin with.
constexpr double kFirstStep = 1.2;
// A step shorter than this part of the way has lost the surface: the guess was no use.
constexpr double kShortest = 1e-4;

State rate_of(const WrapSurface& surface, const State& y) {
    const Vec3 x = y.head<3>(), along = y.segment<3>(3);
    const Vec3 g = surface.gradient(x);
    const double curvature = surface.gauss_curvature(x, g);
    State rate;
    rate.head<3>() = along;
    rate.segment<3>(3) = -(along.dot(surface.bend(x, along)) / g.squaredNorm()) * g;
    rate[6] = y[7];
    rate[7] = -curvature * y[6];
    rate[8] = y[9];
    rate[9] = -curvature * y[8];
    return rate;
}

/// `count` substeps of the midpoint rule, smoothed at the end.
State midpoint(const WrapSurface& surface, const State& from, const State& rate, double step,
               int count) {
    const double h = step / count;
    State before = from, now = from + h * rate;
    for (int i = 1; i < count; ++i) {
        const State next = before + 2 * h * rate_of(surface, now);
        before = now;
        now = next;
    }
    return 0.5 * (now + before + h * rate_of(surface, now));
}

bool agree(const State& a, const State& b, double size) {
    const State change = a - b;
    const Eigen::Vector4d shifts{change[6], change[7] * size, change[8] / size, change[9]};
    const double far = std::max(1.0, std::max(std::abs(a[6]), std::abs(a[9])));
    return change.head<3>().norm() < kPrecision * size &&
           change.segment<3>(3).norm() < kPrecision && shifts.norm() < kShiftPrecision * far;
}

/// One step, or none when it was too long to be precise; the number of columns it took.
int extrapolate(const WrapSurface& surface, State& y, double step, double size) {
    const State rate = rate_of(surface, y);
    std::array<State, kColumns> table;
    for (int k = 0; k < kColumns; ++k) {
        State last = midpoint(surface, y, rate, step, 2 * (k + 1)), older;
        // Neville's scheme in h^2 towards zero; table[j] holds the row before.
        for (int j = 0; j < k; ++j) {
            const double ratio = (k + 1.0) / (k - j), factor = 1 / (ratio * ratio - 1);
            older = last + factor * (last - table[j]);
            table[j] = last;
            last = older;
        }
        if (k > 1) {
            if (agree(last, table[k - 1], size)) {
                y = last;
                return k + 1;
            }
        }
        table[k] = last;
    }
    return 0;
}

/// Back onto the surface and to a unit tangent, from which rounding leads.
void settle(const WrapSurface& surface, State& y) {
    const Vec3 x = surface.settle(y.head<3>());
    const Vec3 normal = surface.normal(x), along = y.segment<3>(3);
    y.head<3>() = x;
    y.segment<3>(3) = (along - along.dot(normal) * normal).normalized();
}

}  // namespace

GeodesicEnd follow_geodesic(const WrapSurface& surface, const GeodesicPoint& start, double length) {
    State y;
    y << start.at, start.along, 1, 0, 0, 1;
    const double direction = length < 0 ? -1 : 1;
    double left = std::abs(length);
    const Vec3 g = surface.gradient(start.at);
    const double bend = std::abs(start.along.dot(surface.bend(start.at, start.along))) / g.norm();
    double step = left * bend > kFirstStep ? kFirstStep / bend : left;
    while (left > 0) {
        const double now = std::min(step, left);
        const int columns = extrapolate(surface, y, direction * now, surface.size());
        if (columns == 0) {
            step = 0.5 * now;
            if (step > kShortest * std::abs(length)) continue;
            y.fill(std::nan(""));
            break;
        }
        left -= now;
        if (columns < kColumns - 1) step = 1.5 * now;
        settle(surface, y);
    }
    GeodesicEnd end;
    end.point = {y.head<3>(), y.segment<3>(3)};
    end.shift = y[6];
    end.shift_rate = y[7];
    end.turn = y[8];
    end.turn_rate = y[9];
    return end;
}

}  // namespace myotet::skeleton
