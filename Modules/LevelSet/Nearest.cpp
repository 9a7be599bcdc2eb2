// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "LevelSet/Redistance.h"

namespace myotet::levelset {

bool pull(const Band& band, Vec3& point) {
    // x <- x - phi grad phi / |grad phi|^2. A point short of the interface would
    // make distances too small, so that arriving is checked.
    constexpr int kSteps = 6;
    constexpr double kClose = 0.004;  // spacings; slopes err by about as much
    for (int step = 0; step < kSteps; ++step) {
        const Sample s = sample(band, point);
        if (std::abs(s.value) < kClose * band.spacing) return true;
        const double length = s.gradient.norm();
        if (!(length > 0.1)) return false;
        // At the band's edge clamped values make the gradient too short.
        point -= s.value / (std::max(length, 0.8) * length) * s.gradient;
    }
    return false;
}

void slide(const Band& band, const Vec3& point, int steps, Vec3& foot) {
    // Towards the point in the tangent plane, then back to the interface; the
    // pull stays well inside the band for steps of up to three spacings.
    double longest = 3 * band.spacing;
    double nearest = (point - foot).squaredNorm();
    for (int step = 0; step < steps; ++step) {
        const Vec3 gradient = sample(band, foot).gradient;
        const double slope = gradient.squaredNorm();
        if (!(slope > 0.01)) return;
        const Vec3 away = point - foot;
        Vec3 tangent = away - away.dot(gradient) / slope * gradient;
        const double reach = tangent.norm();
        if (!(reach > 0.02 * band.spacing)) return;
        if (reach > longest) tangent *= longest / reach;
        Vec3 moved = foot + tangent;
        if (pull(band, moved) && (point - moved).squaredNorm() < nearest) {
            foot = moved;
            nearest = (point - foot).squaredNorm();
        } else {
            longest = 0.3 * std::min(longest, reach);
        }
    }
}

}  // namespace myotet::levelset
