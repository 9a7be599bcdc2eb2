// SPDX-License-Identifier: Apache-2.0
#include "Phantoms/Fusiform.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myotet::phantoms {
namespace {

using std::numbers::pi;

constexpr double kBegin = kFusiformTendon, kEnd = kFusiformLength - kFusiformTendon;
constexpr double kSwell = kFusiformThick - kFusiformThin;
// Intervals of the outline among which the nearest point is sought: finer than its bends.
constexpr int kIntervals = 120;
// Each keeps 0.618 of a bracket of 1 mm: below 1e-9 mm, where the distance no longer changes.
constexpr int kGoldenSteps = 44;

/// Distance in the half-plane (r, z) to the segment r in [0, thin] at height `z0`.
double distance_to_end(double r, double z, double z0) {
    return std::hypot(std::max(r - kFusiformThin, 0.0), z - z0);
}

double distance_to_outline(double r, double z) {
    const auto to = [&](double t) { return std::hypot(fusiform_radius(t) - r, t - z); };
    constexpr double kStep = kFusiformBelly / kIntervals;
    int best = 0;
    for (int n = 1; n <= kIntervals; ++n)
        if (to(kBegin + n * kStep) < to(kBegin + best * kStep)) best = n;
    double low = std::max(kBegin, kBegin + (best - 1) * kStep);
    double high = std::min(kEnd, kBegin + (best + 1) * kStep);
    constexpr double kGolden = 1 / std::numbers::phi;
    for (int n = 0; n < kGoldenSteps; ++n) {
        const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
        (to(a) < to(b) ? high : low) = to(a) < to(b) ? b : a;
    }
    return std::min(to(low), to(high));
}

double capped_cylinder_distance(double r, double z, double middle, double half) {
    const double across = r - kFusiformThin, along = std::abs(z - middle) - half;
    return std::hypot(std::max(across, 0.0), std::max(along, 0.0)) +
           std::min(std::max(across, along), 0.0);
}

}  // namespace

double fusiform_radius(double z) {
    if (z <= kBegin || z >= kEnd) return kFusiformThin;
    const double sine = std::sin(pi * (z - kBegin) / kFusiformBelly);
    return kFusiformThin + kSwell * sine * sine;
}

double fusiform_slope(double z) {
    if (z <= kBegin || z >= kEnd) return 0;
    return kSwell * pi / kFusiformBelly * std::sin(2 * pi * (z - kBegin) / kFusiformBelly);
}

Vec3 fusiform_fibre(const Vec3& point) {
    const double widening = fusiform_slope(point.z()) / fusiform_radius(point.z());
    return Vec3(point.x() * widening, point.y() * widening, 1).normalized();
}

double fusiform_belly_distance(const Vec3& point) {
    const double r = point.head<2>().norm(), z = point.z();
    const double distance = std::min(
        {distance_to_outline(r, z), distance_to_end(r, z, kBegin), distance_to_end(r, z, kEnd)});
    const bool inside = z > kBegin && z < kEnd && r < fusiform_radius(z);
    return inside ? -distance : distance;
}

double fusiform_tendon_distance(const Vec3& point) {
    const double r = point.head<2>().norm();
    constexpr double kHalf = kFusiformTendon / 2;
    return std::min(capped_cylinder_distance(r, point.z(), kHalf, kHalf),
                    capped_cylinder_distance(r, point.z(), kFusiformLength - kHalf, kHalf));
}

double fusiform_belly_volume() {
    // The means of sin^2 and sin^4 over the belly are 1/2 and 3/8.
    return pi * kFusiformBelly *
           (kFusiformThin * kFusiformThin + kFusiformThin * kSwell + 3.0 / 8 * kSwell * kSwell);
}

double fusiform_tendon_volume() { return 2 * pi * kFusiformThin * kFusiformThin * kFusiformTendon; }

}  // namespace myotet::phantoms
