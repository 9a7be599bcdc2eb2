// SPDX-License-Identifier: Apache-2.0
#include "Muscle/HillCurves.h"

#include <algorithm>
#include <cmath>

#include "Muscle/Curves.h"
#include "Muscle/ForceVelocity.h"
#include "Muscle/Require.h"

namespace myotet::muscle {
namespace {

// Of Thelen's tendon: the pull where its toe ends, and how curved the toe is.
constexpr double kToeForce = 0.33, kToeRate = 3;

CurvePoint thelen_active(const ThelenShape& shape, double length) {
    const double e = length - 1, value = std::exp(-e * e / shape.KshapeActive);
    return {value, -2 * e / shape.KshapeActive * value};
}

CurvePoint thelen_passive(const ThelenShape& shape, double length) {
    if (shape.passive_form == ThelenPassive::everywhere) {
        const double k = shape.KshapePassive, e = (length - 1) / shape.FmaxMuscleStrain;
        const double slope = k / shape.FmaxMuscleStrain;
        if (e > 1) return {1 + k * (e - 1), slope};
        return {std::exp(k * (e - 1)), slope * std::exp(k * (e - 1))};
    }
    if (!(length > 1)) return {};
    const double rate = shape.KshapePassive / shape.FmaxMuscleStrain;
    const double whole = std::expm1(shape.KshapePassive), e = length - 1;
    return {std::expm1(rate * e) / whole, rate * std::exp(rate * e) / whole};
}

// The toe's slope at its end is end / toe; straight on it shall reach 1 at `strain`:
//     end / toe = (1 - kToeForce) / (strain - toe).
CurvePoint thelen_tendon(double strain, double length) {
    const double grown = std::expm1(kToeRate);
    const double end = kToeForce * kToeRate * (grown + 1) / grown;
    const double toe = end * strain / (end + 1 - kToeForce), e = length - 1;
    if (!(e > 0)) return {};
    if (e > toe) return {kToeForce + end / toe * (e - toe), end / toe};
    return {kToeForce * std::expm1(kToeRate * e / toe) / grown,
            kToeForce * kToeRate / toe * std::exp(kToeRate * e / toe) / grown};
}

CurvePoint thelen_velocity(const ThelenShape& shape, double speed) {
    if (speed <= -1) return {};
    if (speed <= 0) {
        const double below = 1 - speed / shape.Af;
        return {(1 + speed) / below, (1 + 1 / shape.Af) / (below * below)};
    }
    const double m = shape.Flen, k = 2 + 2 / shape.Af;
    const auto hyperbola = [&](double v) -> CurvePoint {
        const double below = m - 1 + k * v;
        return {(m - 1 + k * m * v) / below, k * (m - 1) * (m - 1) / (below * below)};
    };
    // Where the value is the threshold times m, more than 1.
    const double most = std::max(shape.fv_linear_extrap_threshold * m, 1.0);
    const double last = (most - 1) * (m - 1) / (k * (m - most));
    if (speed <= last) return hyperbola(speed);
    const CurvePoint end = hyperbola(last);
    return {end.value + end.slope * (speed - last), end.slope};
}

// The ascending limb from two sides, the plateau, the descending limb. Near the optimum the
// curve is flat over half a sarcomere's bare zone, 0.0259 of the optimal length.
BezierCurve millard_active(const MillardShape& s) {
    constexpr double kPlateau = 0.0259;
    const double x0 = s.min_norm_active_fiber_length, x1 = s.transition_norm_fiber_length;
    const double x3 = s.max_norm_active_fiber_length, shallow = s.shallow_ascending_slope;
    const double shoulder = 1 - kPlateau, y1 = 1 - shallow * (shoulder - x1);
    const double steep_from = x0 + kPlateau, fall_from = 1 + kPlateau, fall_to = x3 - kPlateau;
    const double low = s.minimum_value;
    return BezierCurve({{x0, low, 0},
                        {0.5 * (steep_from + x1), 0.5 * y1, y1 / (x1 - steep_from)},
                        {0.5 * (x1 + shoulder), 0.5 * (y1 + 1), shallow},
                        {1, 1, 0},
                        {0.5 * (fall_from + fall_to), 0.5, -1 / (fall_to - fall_from)},
                        {x3, low, 0}},
                       {1});
}

BezierCurve millard_passive(const MillardShape& s) {
    const double x0 = 1 + s.strain_at_zero_force, x1 = 1 + s.strain_at_one_norm_force;
    const double low = std::min(0.1 / s.stiffness_at_one_norm_force, 0.1 * (x1 - x0));
    return BezierCurve({{x0, 0, 0},
                        {x0 + low, s.stiffness_at_low_force * 0.5 * low, s.stiffness_at_low_force},
                        {x1, 1, s.stiffness_at_one_norm_force}},
                       {s.passive_curviness});
}

// The toe bends around a corner in two bows, then goes straight on.
BezierCurve millard_tendon(const MillardShape& s) {
    const double slope = s.tendon_stiffness_at_one_norm_force;
    const auto line = [&](double y) {
        return 1 + s.tendon_strain_at_one_norm_force + (y - 1) / slope;
    };
    const double toe = s.norm_force_at_toe_end, foot = 1 + (line(toe) - 1) / 10;
    const double middle = line(toe / 2), mean_slope = toe / 2 / (middle - foot);
    const double between = 0.5 * (foot + middle);
    return BezierCurve(
        {{1, 0, 0}, {between, mean_slope * (between - foot), mean_slope}, {line(toe), toe, slope}},
        {s.tendon_curviness});
}

BezierCurve millard_velocity(const MillardShape& s) {
    constexpr double kNear = 0.9;  // of max_speed
    const double most = s.max_eccentric_velocity_force_multiplier;
    const double bent_c = 0.5 * (s.concentric_slope_at_vmax + s.concentric_slope_near_vmax);
    const double bent_e = 0.5 * (s.eccentric_slope_at_vmax + s.eccentric_slope_near_vmax);
    return BezierCurve({{-1, 0, s.concentric_slope_at_vmax},
                        {-kNear, bent_c * (1 - kNear), s.concentric_slope_near_vmax},
                        {0, 1, s.isometric_slope},
                        {kNear, most - bent_e * (1 - kNear), s.eccentric_slope_near_vmax},
                        {1, most, s.eccentric_slope_at_vmax}},
                       {s.concentric_curviness, s.concentric_curviness, s.eccentric_curviness,
                        s.eccentric_curviness});
}

// Pulls only.
HillCurves::Curve pulling(BezierCurve curve) {
    return [curve = std::move(curve)](double x) {
        const CurvePoint at = curve(x);
        return at.value > 0 ? at : CurvePoint{};
    };
}

}  // namespace

void ThelenShape::validate() const {
    require(KshapeActive > 0, "KshapeActive", KshapeActive, "it must be positive");
    require(KshapePassive > 0, "KshapePassive", KshapePassive, "it must be positive");
    require(FmaxMuscleStrain > 0, "FmaxMuscleStrain", FmaxMuscleStrain, "it must be positive");
    require(FmaxTendonStrain > 0, "FmaxTendonStrain", FmaxTendonStrain, "it must be positive");
    require(Af > 0, "Af", Af, "it must be positive");
    require(Flen > 1, "Flen", Flen, "it must be more than 1");
    require(fv_linear_extrap_threshold * Flen > 1 && fv_linear_extrap_threshold < 1,
            "fv_linear_extrap_threshold", fv_linear_extrap_threshold,
            "it must lie between 1 / Flen and 1");
}

HillCurves thelen2003_curves(const ThelenShape& shape) {
    shape.validate();
    const double strain = shape.FmaxTendonStrain;
    return {.active = [shape](double l) { return thelen_active(shape, l); },
            .passive = [shape](double l) { return thelen_passive(shape, l); },
            .velocity = [shape](double v) { return thelen_velocity(shape, v); },
            .tendon = [strain](double l) { return thelen_tendon(strain, l); }};
}

HillCurves millard2012_curves(const MillardShape& shape) {
    require(shape.fiber_damping >= 0, "fiber_damping", shape.fiber_damping,
            "it must not be negative");
    return {.active = pulling(millard_active(shape)),
            .passive = pulling(millard_passive(shape)),
            .velocity = pulling(millard_velocity(shape)),
            .tendon = pulling(millard_tendon(shape)),
            .damping = shape.fiber_damping};
}

HillCurves generic_curves() {
    const ToeCurve passive(0.05, 6.6, 1.4, ToeForm::smooth);
    const ForceVelocity hill{.max_speed = 1};
    const double strain = ThelenShape{}.FmaxTendonStrain;
    return {.active = [](double l) -> CurvePoint {
                return {kTeranActive.value(l), kTeranActive.slope(l)};
            },
            .passive = [passive](double l) -> CurvePoint {
                return {passive.value(l), passive.slope(l)};
            },
            .velocity = [hill](double v) -> CurvePoint {
                return {hill.value(v), hill.slope(v)};
            },
            .tendon = [strain](double l) { return thelen_tendon(strain, l); }};
}

}  // namespace myotet::muscle
