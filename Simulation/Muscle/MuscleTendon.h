// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Muscle/HillCurves.h"

namespace myotet::muscle {

/// A muscle and its tendon in a row, as one line that pulls: Hill's three elements
/// [Zajac 1989]. Fibres keep their width: their angle alpha to the tendon changes with their
/// length l so that l sin(alpha) stays.
struct MuscleTendon {
    double strength = 0;       ///< of active fibres at their optimal length, at rest, N
    double fibre_length = 0;   ///< optimal, mm
    double tendon_length = 0;  ///< slack, mm
    double pennation = 0;      ///< alpha at optimal fibre length, rad
    double max_speed = 10;     ///< of shortening without load, optimal fibre lengths / s
    HillCurves curves = generic_curves();

    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Shortest fibres that the model speaks of, as a part of their optimal length, and the
/// largest angle, by its cosine: what would be shorter stays so long [Millard 2013].
inline constexpr double kShortestFibre = 0.01, kLeastCosine = 0.1;

/// A unit whose tendon does not stretch. It pulls passive + gain activation.
struct RigidPull {
    double gain = 0;     ///< along the tendon, N: strength active velocity cos(alpha)
    double passive = 0;  ///< along the tendon, N: viscous too, and never less than nothing
    double cos_pennation = 1;
    double fibre_length = 0;  ///< mm
    double fibre_speed = 0;   ///< mm/s, positive when it lengthens
    bool slack = false;       ///< shorter than its tendon and shortest fibre: it pulls nothing
};

/// Of a unit by its whole length, mm, and how fast that grows, mm/s. The gain is what
/// static optimisation calls the force of a fibre behind an inextensible tendon.
[[nodiscard]] RigidPull rigid_pull(const MuscleTendon& unit, double length, double speed);

/// Pull at full activation as OpenSim 2 took it for static optimisation, of which reference
/// results remain: in static equilibrium with the stretched tendon, passive pull included,
/// times a generic force-velocity curve,
///     1.8 - 1.8 / (1 + exp((0.04 + v) / 0.18)),  v = speed cos(pennation) / (max_speed
///     fibre_length),
/// N, of a length, mm, and a speed, mm/s, of the unit.
[[nodiscard]] double isokinetic_gain(const MuscleTendon& unit, double length, double speed);

/// A unit whose tendon stretches: fibres and tendon pull alike,
///     tendon(l_t) = cos(alpha) (a active(l) velocity(v) + passive(l) + damping v).
struct ElasticPull {
    double force = 0;                ///< N
    double force_by_activation = 0;  ///< at the same speed of fibres, N
    double fibre_length = 0;         ///< mm
    double cos_pennation = 1;
    double length_by_unit_length = 0;  ///< d fibre_length / d length of the unit
    double length_by_activation = 0;   ///< d fibre_length / d activation, mm
    bool slack = false;                ///< no length of the fibres tightens the tendon
    bool converged = true;
    double residual = 0;  ///< of the equilibrium, in parts of the strength
    int iterations = 0;
};

/// In equilibrium at a length, mm, and an activation while the fibres lengthen with
/// `fibre_speed`, mm/s; 0 is the static equilibrium. Found by Newton's method in a bracket,
/// to rounding. Where active fibres pull less the longer they are, and the tendon is soft,
/// there may be several; the one found is between fibres as short as may be and a slack
/// tendon. Cost: 1 us, with Millard's curves some 12.
[[nodiscard]] ElasticPull elastic_pull(const MuscleTendon& unit, double length, double activation,
                                       double fibre_speed);

/// As a muscle moves: fibres lengthen as the static equilibrium at this activation does when
/// the unit's length changes with `speed`, mm/s, and the activation with `rate`, 1/s. The
/// speed of the fibres is one of the first order: their own inertia is none, and what their
/// speed does to it is left out.
struct UnitMotion {
    double length = 0;  ///< mm
    double speed = 0;   ///< mm/s
    double activation = 0;
    double activation_rate = 0;  ///< 1/s
};
[[nodiscard]] ElasticPull elastic_pull(const MuscleTendon& unit, const UnitMotion& motion);

}  // namespace myotet::muscle
