// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/SafeStep.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace myotet::dynamics {
namespace {

// a + b s + c s^2 + d s^3
struct Cubic {
    double a, b, c, d;
    [[nodiscard]] double operator()(double s) const { return a + s * (b + s * (c + s * d)); }

    // Where the derivative b + 2 c s + 3 d s^2 vanishes, in order; 0 and 1 where it does
    // not vanish between them.
    [[nodiscard]] std::array<double, 2> stationary() const {
        std::array<double, 2> at{0, 1};
        const double root = c * c - 3 * d * b;
        if (!(root > 0)) return at;
        // Without cancellation: the product of the two is b / (3 d).
        const double q = -(c + std::copysign(std::sqrt(root), c));
        const double one = q / (3 * d), other = b / q;
        at = {std::isfinite(one) ? std::clamp(one, 0.0, 1.0) : 1,
              std::isfinite(other) ? std::clamp(other, 0.0, 1.0) : 1};
        if (at[0] > at[1]) std::swap(at[0], at[1]);
        return at;
    }
};

// The root between a positive and a negative value, from the positive side.
double bisect(const Cubic& volume, double positive, double negative) {
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (positive + negative);
        (volume(middle) > 0 ? positive : negative) = middle;
    }
    return positive;
}

// det(E + s D), column by column.
Cubic volume_along(const Mat3& E, const Mat3& D) {
    const auto det = [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); };
    const Vec3 e0 = E.col(0), e1 = E.col(1), e2 = E.col(2);
    const Vec3 d0 = D.col(0), d1 = D.col(1), d2 = D.col(2);
    return {det(e0, e1, e2), det(d0, e1, e2) + det(e0, d1, e2) + det(e0, e1, d2),
            det(e0, d1, d2) + det(d0, e1, d2) + det(d0, d1, e2), det(d0, d1, d2)};
}

}  // namespace

double first_flat(const Mat3& F, const Mat3& by) {
    const Cubic volume = volume_along(F, by);
    // Most steps are small.
    if (std::abs(volume.b) + std::abs(volume.c) + std::abs(volume.d) < volume.a) return 1;
    double low = 0;
    const auto [first, second] = volume.stationary();
    for (const double high : {first, second, 1.0}) {
        if (!(volume(high) > 0)) return bisect(volume, low, high);
        low = high;
    }
    return 1;
}

}  // namespace myotet::dynamics
