// SPDX-License-Identifier: Apache-2.0
#include "Muscle/ActivationDynamics.h"

#include <algorithm>
#include <cmath>

#include "Muscle/Require.h"

namespace myotet::muscle {
namespace {

// Time constants scale with kIdle + kActive a [Thelen 2003].
constexpr double kIdle = 0.5, kActive = 1.5;

// Newton's method below doubles its digits each time, from none at worst.
constexpr int kMostIterations = 60;

// The z in [0, 1) with z exp(-z) = y exp(-shift), y = z0 exp(-z0): the left side grows and
// its logarithm is concave, so that Newton's method from the left stays on the left.
double solve_rise(double z0, double shift) {
    const double goal = std::log(z0) - z0 - shift;
    double z = std::exp(goal);
    if (z == 0) return 0;
    for (int i = 0; i < kMostIterations; ++i) {
        const double next = z + z * (goal - std::log(z) + z) / (1 - z);
        if (!(next > z)) break;
        z = next;
    }
    return std::min(z, z0);
}

}  // namespace

void ActivationDynamics::validate() const {
    require(rise > 0, "rise", rise, "it must be a positive time in s (0.015 is usual)");
    require(fall > 0, "fall", fall, "it must be a positive time in s (0.05 is usual)");
}

double ActivationDynamics::rate(double activation, double excitation) const {
    const double slowness = kIdle + kActive * activation, away = excitation - activation;
    return away > 0 ? away / (rise * slowness) : away * slowness / fall;
}

double ActivationDynamics::after(double activation, double excitation, double seconds) const {
    // With d = |u - a|, c = 0.5 + 1.5 u and b = 1.5 / c:
    // rising,  (c - 1.5 d) d'(t) = -d / rise:  ln(b d) - b d falls by t / (c rise);
    // falling, d'(t) = -d (c + 1.5 d) / fall:  1/d + b grows by the factor exp(c t / fall).
    const double c = kIdle + kActive * excitation, b = kActive / c;
    const double d = std::abs(excitation - activation);
    if (d == 0 || !(seconds > 0)) return activation;
    if (excitation > activation) return excitation - solve_rise(b * d, seconds / (c * rise)) / b;
    const double decay = c * seconds / fall;
    return excitation + d * std::exp(-decay) / (1 - b * d * std::expm1(-decay));
}

}  // namespace myotet::muscle
