// SPDX-License-Identifier: Apache-2.0
#include "Muscle/MuscleTendon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "Muscle/Require.h"

namespace myotet::muscle {
namespace {

// Parts of the strength. The tendon's stiffness is some 40 strengths a strain, so that
// rounding of lengths alone is 1e-14.
constexpr double kEquilibrium = 1e-13;
// Bisection alone would need 60.
constexpr int kMostIterations = 100;

// Fibres seen along the tendon: `along` = l cos(alpha), width = l sin(alpha), constant.
struct Geometry {
    double width, shortest;  ///< mm; shortest: least `along`

    explicit Geometry(const MuscleTendon& unit)
        : width(unit.fibre_length * std::sin(unit.pennation)) {
        const double steepest = kLeastCosine / std::sqrt(1 - kLeastCosine * kLeastCosine);
        const double least = kShortestFibre * unit.fibre_length;
        shortest = std::max(width * steepest,
                            least > width ? std::sqrt(least * least - width * width) : 0);
    }
    [[nodiscard]] double length(double along) const { return std::hypot(along, width); }
};

// Pull of fibres along the tendon in parts of the strength, and what it depends on.
struct FibrePull {
    double value, by_along, by_activation;  ///< -, 1/mm, -
};
FibrePull fibre_pull(const MuscleTendon& unit, const Geometry& geometry, double along,
                     double activation, double fibre_speed) {
    const double length = geometry.length(along), cosine = along / length;
    const double speed = fibre_speed / (unit.max_speed * unit.fibre_length);
    const CurvePoint active = unit.curves.active(length / unit.fibre_length);
    const CurvePoint passive = unit.curves.passive(length / unit.fibre_length);
    const double fast = unit.curves.velocity(speed).value;
    const double pull =
        activation * active.value * fast + passive.value + unit.curves.damping * speed;
    const double by_length = (activation * active.slope * fast + passive.slope) / unit.fibre_length;
    // d length / d along = cosine, d cosine / d along = sin^2 / length.
    return {cosine * pull, cosine * cosine * by_length + pull * (1 - cosine * cosine) / length,
            cosine * active.value * fast};
}

// What the tendon pulls more than the fibres, in parts of the strength.
struct Excess {
    double value;
    FibrePull fibres;
    CurvePoint tendon;
};
Excess excess(const MuscleTendon& unit, const Geometry& geometry, double length, double along,
              double activation, double fibre_speed) {
    const CurvePoint tendon = unit.curves.tendon((length - along) / unit.tendon_length);
    const FibrePull fibres = fibre_pull(unit, geometry, along, activation, fibre_speed);
    return {tendon.value - fibres.value, fibres, tendon};
}

}  // namespace

void MuscleTendon::validate() const {
    require(strength >= 0 && std::isfinite(strength), "strength", strength,
            "it must be a force in N");
    require(fibre_length > 0, "fibre_length", fibre_length, "it must be a positive length in mm");
    require(tendon_length > 0, "tendon_length", tendon_length,
            "it must be a positive length in mm");
    require(pennation >= 0 && pennation < std::numbers::pi / 2, "pennation", pennation,
            "it must be an angle from 0 to less than pi / 2");
    require(max_speed > 0, "max_speed", max_speed, "it must be positive (10 is usual)");
}

RigidPull rigid_pull(const MuscleTendon& unit, double length, double speed) {
    const Geometry geometry(unit);
    RigidPull pull;
    const double along = length - unit.tendon_length;
    pull.slack = !(along > geometry.shortest);
    pull.fibre_length = geometry.length(std::max(along, geometry.shortest));
    pull.cos_pennation = std::max(along, geometry.shortest) / pull.fibre_length;
    if (pull.slack) return pull;
    pull.fibre_speed = speed * pull.cos_pennation;
    const double fast = pull.fibre_speed / (unit.max_speed * unit.fibre_length);
    const double stretch = pull.fibre_length / unit.fibre_length;
    const double along_tendon = unit.strength * pull.cos_pennation;
    pull.gain = along_tendon * unit.curves.active(stretch).value * unit.curves.velocity(fast).value;
    pull.passive = along_tendon *
                   std::max(unit.curves.passive(stretch).value + unit.curves.damping * fast, 0.0);
    return pull;
}

ElasticPull elastic_pull(const MuscleTendon& unit, double length, double activation,
                         double fibre_speed) {
    const Geometry geometry(unit);
    // At `low` the tendon pulls more than the fibres, at `high`, where it is slack, less.
    double low = geometry.shortest, high = length - unit.tendon_length, along = high;
    ElasticPull pull;
    const auto at = [&](double x) {
        return excess(unit, geometry, length, x, activation, fibre_speed);
    };
    if (!(high > low) || at(high).value > 0) {
        pull.slack = true;
        pull.fibre_length = geometry.length(std::max(high, low));
        pull.cos_pennation = std::max(high, low) / pull.fibre_length;
        return pull;
    }
    Excess now = at(along);
    double stiff_tendon = 0, by_along = 0;
    for (;; ++pull.iterations) {
        (now.value > 0 ? low : high) = along;
        stiff_tendon = now.tendon.slope / unit.tendon_length;
        by_along = -stiff_tendon - now.fibres.by_along;
        pull.residual = std::abs(now.value);
        const bool narrow = high - low <= 4 * std::numeric_limits<double>::epsilon() * length;
        if (pull.residual <= kEquilibrium || narrow || pull.iterations == kMostIterations) break;
        double next = along - now.value / by_along;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        along = next;
        now = at(along);
    }
    // Rounding of lengths, where the tendon is very stiff, is not a failure.
    const double rounding =
        16 * std::numeric_limits<double>::epsilon() * length * std::abs(by_along);
    pull.converged = pull.residual <= std::max(kEquilibrium, rounding);
    pull.fibre_length = geometry.length(along);
    pull.cos_pennation = along / pull.fibre_length;
    pull.force = unit.strength * now.tendon.value;
    // Of tendon(length - along) = fibres(along, activation). Relaxed fibres behind a tendon that
    // just begins to pull have no stiffness, nor has it: the limit of little activation.
    const bool loose = by_along == 0;
    const double by_activation = loose ? 0 : now.fibres.by_activation / by_along;
    const double share = loose ? 1 : -stiff_tendon / by_along;
    pull.force_by_activation = unit.strength * share * now.fibres.by_activation;
    pull.length_by_activation = pull.cos_pennation * by_activation;
    pull.length_by_unit_length = pull.cos_pennation * share;
    return pull;
}

double isokinetic_gain(const MuscleTendon& unit, double length, double speed) {
    const double v = speed * std::cos(unit.pennation) / (unit.max_speed * unit.fibre_length);
    const double fast = 1.8 - 1.8 / (1 + std::exp((0.04 + v) / 0.18));
    return elastic_pull(unit, length, 1, 0).force * fast;
}

ElasticPull elastic_pull(const MuscleTendon& unit, const UnitMotion& motion) {
    const ElasticPull still = elastic_pull(unit, motion.length, motion.activation, 0);
    if (still.slack) return still;
    const double fibre_speed = still.length_by_unit_length * motion.speed +
                               still.length_by_activation * motion.activation_rate;
    return elastic_pull(unit, motion.length, motion.activation, fibre_speed);
}

}  // namespace myotet::muscle
