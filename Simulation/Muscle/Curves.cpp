// SPDX-License-Identifier: Apache-2.0
#include "Muscle/Curves.h"

#include <cmath>

#include "Core/Errors.h"

namespace myotet::muscle {
namespace {

// |x - 1| where the parabola of the peak ends, and where nothing is left.
constexpr double kShoulder = 0.4, kFoot = 0.6;

constexpr double cube(double x) { return x * x * x; }

}  // namespace

double ActiveCurve::value(double x) const {
    const double e = std::abs(x - 1);
    if (e < kShoulder) return 1 - peak * e * e;
    return e < kFoot ? tail * (e - kFoot) * (e - kFoot) : 0;
}

double ActiveCurve::slope(double x) const {
    const double e = std::abs(x - 1), away = x < 1 ? -1 : 1;
    if (e < kShoulder) return -2 * peak * (x - 1);
    return e < kFoot ? 2 * tail * (e - kFoot) * away : 0;
}

double ActiveCurve::integral(double x) const {
    const double foot = tail * cube(kFoot - kShoulder) / 3;
    const double half = kShoulder - peak * cube(kShoulder) / 3;
    const double e = x - 1;
    if (e <= -kFoot) return 0;
    if (e < -kShoulder) return tail * cube(e + kFoot) / 3;
    if (e < kShoulder) return foot + half + e - peak * cube(e) / 3;
    if (e < kFoot) return 2 * (foot + half) - tail * cube(kFoot - e) / 3;
    return 2 * (foot + half);
}

ToeCurve::ToeCurve(double scale, double rate, double linear_from, ToeForm form)
    : scale_(scale), rate_(rate), linear_from_(linear_from), smooth_(form == ToeForm::smooth) {
    MYOTET_CHECK(scale > 0 && rate > 0 && linear_from >= 1, "a curve of no shape");
    const double e = linear_from - 1;
    value_ = toe(e);
    slope_ = toe_slope(e);
    integral_ = toe_integral(e);
    over_stretch_ = toe_over_stretch(e);
}

double ToeCurve::toe(double e) const {
    return scale_ * (std::expm1(rate_ * e) - (smooth_ ? rate_ * e : 0));
}

double ToeCurve::toe_slope(double e) const {
    return scale_ * rate_ * (smooth_ ? std::expm1(rate_ * e) : std::exp(rate_ * e));
}

double ToeCurve::toe_integral(double e) const {
    return scale_ * (std::expm1(rate_ * e) / rate_ - e - (smooth_ ? 0.5 * rate_ * e * e : 0));
}

double ToeCurve::toe_over_stretch(double e) const {
    // The integral of exp(rate (t - 1)) / t is exp(-rate) Ei(rate t).
    const double grown = std::exp(-rate_) * (std::expint(rate_ * (1 + e)) - std::expint(rate_));
    const double log_stretch = std::log1p(e);
    return scale_ * (grown - log_stretch - (smooth_ ? rate_ * (e - log_stretch) : 0));
}

double ToeCurve::value(double x) const {
    if (x <= 1) return 0;
    return x < linear_from_ ? toe(x - 1) : value_ + slope_ * (x - linear_from_);
}

double ToeCurve::slope(double x) const {
    if (x <= 1) return 0;
    return x < linear_from_ ? toe_slope(x - 1) : slope_;
}

double ToeCurve::integral(double x) const {
    if (x <= 1) return 0;
    if (x < linear_from_) return toe_integral(x - 1);
    const double beyond = x - linear_from_;
    return integral_ + (value_ + 0.5 * slope_ * beyond) * beyond;
}

double ToeCurve::integral_over_stretch(double x) const {
    if (x <= 1) return 0;
    if (x < linear_from_) return toe_over_stretch(x - 1);
    return over_stretch_ + (value_ - slope_ * linear_from_) * std::log(x / linear_from_) +
           slope_ * (x - linear_from_);
}

}  // namespace myotet::muscle
