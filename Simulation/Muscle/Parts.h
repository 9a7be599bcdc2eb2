// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "Muscle/Curves.h"
#include "Muscle/ForceVelocity.h"
#include "Muscle/Invariants.h"

namespace myotet::muscle {

// A tissue's energy is a sum of parts, each a function of the invariants, MPa. None of
// them depends on the volume but for the full stretch of fibres. A part adds its
// derivatives to those of the others, and stress and tangent are made of the sums, once.

/// What lies between the fibres, the same in all directions:
///     W = C1 (J^(-2/3) I1 - 3) + C2 (J^(-4/3) I2 - 3)
/// Its initial shear modulus is 2 (C1 + C2) [Mooney 1940; Rivlin 1948].
struct MooneyRivlin {
    double C1 = 0, C2 = 0;  ///< MPa
    [[nodiscard]] double energy(const Invariants& I) const;
    void add_derivatives(const Invariants& I, Slopes& slopes) const;
    void add_derivatives(const Invariants& I, Slopes& slopes, Curvatures& curvatures) const;
};

/// Resistance to shear along the fibres and across them:
///     W = G1 (I5 / I4^2 - 1) + G2 acosh(w)^2,  w = (I1 I4 - I5) / (2 J sqrt(I4)) >= 1
/// Initial shear moduli are 2 G1 and 2 G2; stretch along the fibres with free sides costs
/// nothing [Blemker 2005; Criscione 2001].
struct FibreShear {
    double G1 = 0, G2 = 0;  ///< MPa
    [[nodiscard]] double energy(const Invariants& I) const;
    void add_derivatives(const Invariants& I, Slopes& slopes) const;
    void add_derivatives(const Invariants& I, Slopes& slopes, Curvatures& curvatures) const;
};

/// acosh(w)^2 and its derivatives, smooth through w = 1.
struct SquaredAcosh {
    double value, slope, curvature;
};
[[nodiscard]] SquaredAcosh squared_acosh(double w);

/// What makes a fibre pull besides its stretch: its activation, 0 to 1; and where its speed
/// matters, the time step it is in.
struct Drive {
    Drive() = default;
    Drive(double active) : activation(active) {}  // a number is an activation at any speed

    double activation = 0;
    const ForceVelocity* force_velocity = nullptr;  ///< null: the same at any speed
    double begun = 1;                               ///< x at which the step began
    double seconds = 1;                             ///< that the step takes
};

/// What a fibre pulls, dW/dl, MPa of undeformed area, by its stretch l and its activation
/// a, x = l / optimal_stretch:
///     stress / optimal_stretch (passive(x) + a active(x))
/// with passive(x) / x instead of passive(x) where that curve gives a Cauchy stress. Where
/// the speed matters, with a step from x_n over dt, implicit in the speed:
///     ... + a active(x_n) force_velocity((x - x_n) / dt)
/// which still is the slope of an energy, and of one that is convex in x since force grows
/// with the speed of lengthening; active(x) falls where a fibre is long, and is not.
struct FibreTension {
    double stress = 0;           ///< MPa, where active is 1 and the fibre fully active
    double optimal_stretch = 1;  ///< l at which the active curve is highest
    ToeCurve passive;
    std::optional<ActiveCurve> active;  ///< none in tendons
    bool by_area = false;               ///< the passive curve gives a Cauchy stress
    [[nodiscard]] double energy(double stretch, const Drive& drive) const;
    [[nodiscard]] double value(double stretch, const Drive& drive) const;
    [[nodiscard]] double slope(double stretch, const Drive& drive) const;
};

/// Fibres: W = W(l), l = sqrt(I4), or J^(-1/3) sqrt(I4) where `isochoric`.
struct Fibres {
    FibreTension tension;
    bool isochoric = false;
    [[nodiscard]] double stretch(const Invariants& I) const;
    [[nodiscard]] double energy(const Invariants& I, const Drive& drive) const;
    void add_derivatives(const Invariants& I, const Drive& drive, Slopes& slopes) const;
    void add_derivatives(const Invariants& I, const Drive& drive, Slopes& slopes,
                         Curvatures& curvatures) const;
};

}  // namespace myotet::muscle
