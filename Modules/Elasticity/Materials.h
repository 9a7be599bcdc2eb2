// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Elasticity/Tangent.h"

namespace myotet::elasticity {

/// Constants of an isotropic material, MPa.
struct Lame {
    double mu = 0;      ///< shear modulus
    double lambda = 0;  ///< first constant
};

/// From Young's modulus (MPa) and Poisson's ratio. Throws InputError unless
/// young > 0 and -1 < poisson < 0.5.
[[nodiscard]] Lame lame_from(double young, double poisson);

/// Greatest speed of sound in the material at rest, mm/s, for a density in
/// t/mm^3: sqrt((lambda + 2 mu) / density).
[[nodiscard]] double sound_speed(const Lame& lame, double density);

// A law gives, for a deformation gradient F = dx/du, the energy in a unit of
// undeformed volume (MPa = mJ/mm^3), its derivative, the first Piola-Kirchhoff
// stress P = dPsi/dF (MPa), and the derivative of that, the tangent dP/dF (MPa).

/// Psi = mu G : G + lambda / 2 tr(G)^2, G = (F^T F - I) / 2 [Teran05, sec. 7.2].
/// Gives way when it is compressed below about 0.6.
struct StVenantKirchhoff {
    Lame lame;
    [[nodiscard]] double energy(const Mat3& F) const;
    [[nodiscard]] Mat3 stress(const Mat3& F) const;
    [[nodiscard]] Tangent tangent(const Mat3& F) const;
};

/// Psi = mu / 2 (tr(F^T F) - 3) - mu ln J + lambda / 2 (ln J)^2, J = det F, whose
/// Cauchy stress is mu / J (b - I) + lambda ln J / J I [Teran05, sec. 7.2].
/// Infinite, and its stress not a number, where J is not positive.
struct NeoHookean {
    Lame lame;
    [[nodiscard]] double energy(const Mat3& F) const;
    [[nodiscard]] Mat3 stress(const Mat3& F) const;
    [[nodiscard]] Tangent tangent(const Mat3& F) const;
};

/// Damping: Cauchy stress 2 shear D + bulk tr(D) I, D = sym(dF/dt F^-1); linear
/// in the velocities. MPa s.
struct Viscosity {
    double shear = 0, bulk = 0;
    /// P for dF/dt = `rate`.
    [[nodiscard]] Mat3 stress(const Mat3& F, const Mat3& rate) const;
};

}  // namespace myotet::elasticity
