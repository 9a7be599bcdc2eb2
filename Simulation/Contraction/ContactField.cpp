// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ContactField.h"

#include <cmath>

namespace myotet::contraction {
namespace {

using levelset::LevelSet;

// Samples that a value is the mean of lie within 1.5 spacings along each axis: 2.6 in
// space, over which an interpolated distance falls by sqrt(3) times that at most.
constexpr double kSupport = 2.6, kFall = 4.5;
// What the coarse field may be wrong by, in its spacings: a cell's diagonal.
constexpr double kCoarse = 1.8;

// The quadratic B-spline around the three samples next to t, which is within half a
// spacing of the middle one, and its derivatives.
struct Weights {
    Vec3 value, slope, bend;
    explicit Weights(double t)
        : value(0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)),
          slope(t - 0.5, -2 * t, t + 0.5),
          bend(1, -2, 1) {}
};

FieldSample sample_local(const LevelSet& phi, const Vec3& point) {
    const double h = phi.spacing;
    const Vec3 g = (point - phi.origin) / h;
    const Vec3 middle = (g.array() + 0.5).floor();
    const Weights x(g.x() - middle.x()), y(g.y() - middle.y()), z(g.z() - middle.z());
    FieldSample s;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                const Vec3 at = middle + Vec3(i - 1, j - 1, k - 1);
                const double v = phi.value(phi.origin + h * at);
                s.value += v * x.value[i] * y.value[j] * z.value[k];
                s.gradient += v * Vec3(x.slope[i] * y.value[j] * z.value[k],
                                       x.value[i] * y.slope[j] * z.value[k],
                                       x.value[i] * y.value[j] * z.slope[k]);
                s.curvature(0, 0) += v * x.bend[i] * y.value[j] * z.value[k];
                s.curvature(1, 1) += v * x.value[i] * y.bend[j] * z.value[k];
                s.curvature(2, 2) += v * x.value[i] * y.value[j] * z.bend[k];
                s.curvature(1, 0) += v * x.slope[i] * y.slope[j] * z.value[k];
                s.curvature(2, 0) += v * x.slope[i] * y.value[j] * z.slope[k];
                s.curvature(2, 1) += v * x.value[i] * y.slope[j] * z.slope[k];
            }
    s.gradient /= h;
    s.curvature /= h * h;
    s.curvature(0, 1) = s.curvature(1, 0);
    s.curvature(0, 2) = s.curvature(2, 0);
    s.curvature(1, 2) = s.curvature(2, 1);
    return s;
}

}  // namespace

FieldSample ContactField::sample(const Vec3& point) const {
    FieldSample s = sample_local(*phi, frame.to_local(point));
    s.gradient = frame.rotation * s.gradient;
    s.curvature = frame.rotation * s.curvature * frame.rotation.transpose();
    return s;
}

std::optional<FieldSample> ContactField::sample_below(double bound, const Vec3& point) const {
    // Where the bound lies inside the band, so do all points whose mean could be below it.
    double reach = bound + kFall * phi->spacing;
    if (!(bound + kSupport * phi->spacing <= phi->band)) reach += kCoarse * phi->coarse_spacing;
    if (phi->value(frame.to_local(point)) >= reach) return {};
    const FieldSample s = sample(point);
    if (s.value >= bound) return {};
    return s;
}

}  // namespace myotet::contraction
