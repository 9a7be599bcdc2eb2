// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Muscle/Bezier.h"

namespace myotet::muscle {

/// The four curves of a muscle with its tendon, without units, each with its derivative. Only
/// the pulls count: none is negative.
struct HillCurves {
    using Curve = std::function<CurvePoint(double)>;
    Curve active;    ///< pull of active fibres at rest by length / optimal length; at most 1
    Curve passive;   ///< pull of relaxed fibres by length / optimal length
    Curve velocity;  ///< factor of `active` by speed / max_speed, positive lengthening; 1 at 0
    Curve tendon;    ///< pull of the tendon by length / slack length
    /// Pull of relaxed fibres that lengthen at max_speed, in parts of the strength: viscous.
    double damping = 0;
};

/// How passive fibres resist, e being (l - 1) / FmaxMuscleStrain and k KshapePassive.
enum class ThelenPassive {
    from_optimum,  ///< (exp(k e) - 1) / (exp(k) - 1) beyond the optimum [Thelen 2003]
    everywhere,    ///< exp(k e) / exp(k), straight beyond e = 1, as in OpenSim 2
};

/// Numbers of Thelen's curves, named as OpenSim's files name them.
struct ThelenShape {
    double KshapeActive = 0.45;      ///< the wider the larger
    double KshapePassive = 5;        ///< how suddenly passive fibres stiffen
    double FmaxMuscleStrain = 0.6;   ///< at which passive fibres pull as the strength
    double FmaxTendonStrain = 0.04;  ///< at which the tendon pulls as the strength
    double Af = 0.25;                ///< of Hill's hyperbola, the smaller the more curved
    double Flen = 1.4;               ///< of lengthening at great speed
    /// Part of Flen beyond which the force-velocity curve goes straight on.
    double fv_linear_extrap_threshold = 0.95;
    ThelenPassive passive_form = ThelenPassive::from_optimum;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// [Thelen 2003, eq. 3-8], at full activation. With e the strain beyond rest:
///     active    exp(-(l - 1)^2 / KshapeActive)
///     passive   as ThelenPassive says
///     velocity  (1 + v) / (1 - v / Af)                          v <= 0; 0 below -1
///               (m - 1 + k m v) / (m - 1 + k v)                 m = Flen, k = 2 + 2 / Af
///     tendon    0.33 (exp(3 e / toe) - 1) / (exp(3) - 1)        e <= toe, straight beyond
/// where toe is such that the tendon's slope does not jump. Its published value, 0.609
/// FmaxTendonStrain, is rounded. The slope of `velocity` doubles where lengthening begins.
[[nodiscard]] HillCurves thelen2003_curves(const ThelenShape& shape);

/// Numbers of Millard's curves, in the order and with the meaning of OpenSim's files.
struct MillardShape {
    double min_norm_active_fiber_length = 0.4441, transition_norm_fiber_length = 0.73;
    double max_norm_active_fiber_length = 1.8123, shallow_ascending_slope = 0.8616;
    double minimum_value = 0;  ///< of `active`; more than 0 is for models without damping

    double strain_at_zero_force = 0, strain_at_one_norm_force = 0.7;  ///< of passive fibres
    double stiffness_at_low_force = 0.2;
    double stiffness_at_one_norm_force = 2 / 0.7;
    double passive_curviness = 0.75;

    double tendon_strain_at_one_norm_force = 0.049;
    double tendon_stiffness_at_one_norm_force = 1.375 / 0.049;
    double norm_force_at_toe_end = 2.0 / 3;
    double tendon_curviness = 0.5;

    double concentric_slope_at_vmax = 0, concentric_slope_near_vmax = 0.25;
    double isometric_slope = 5;
    double eccentric_slope_at_vmax = 0, eccentric_slope_near_vmax = 0.15;
    double max_eccentric_velocity_force_multiplier = 1.4;
    double concentric_curviness = 0.6, eccentric_curviness = 0.9;

    double fiber_damping = 0.1;
};

/// Bezier curves fitted to measurements [Millard 2013], through knots as OpenSim places them.
/// Throws InputError when the numbers make no curve.
[[nodiscard]] HillCurves millard2012_curves(const MillardShape& shape);

/// Of muscles of which nothing else is known: fibres that pull as kTeranActive, resist as
/// ToeCurve(0.05, 6.6, 1.4), have the force-velocity curve ForceVelocity, and Thelen's tendon.
[[nodiscard]] HillCurves generic_curves();

}  // namespace myotet::muscle
