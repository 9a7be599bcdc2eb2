// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace myotet::elasticity {

/// How the energy of a change of volume, U, depends on J = det F. The first is the only one
/// that is infinite at J = 0 and at J = infinity alike, but it is not convex beyond J = e.
enum class VolumeForm {
    log_squared,     ///< U = K/2 (ln J)^2
    log_and_square,  ///< U = K/4 (J^2 - 2 ln J - 1)
    squared,         ///< U = K/2 (J - 1)^2; finite at J = 0
};

/// U(J) and its derivatives, MPa. Where J is not positive the first two forms are infinite.
/// Sources: FEBio theory manual, uncoupled materials; Simo and Taylor 1982.
struct VolumeLaw {
    double bulk = 0;  ///< K, MPa
    VolumeForm form = VolumeForm::log_squared;
    [[nodiscard]] double energy(double J) const;
    [[nodiscard]] double pressure(double J) const;  ///< dU/dJ: positive in tension
    [[nodiscard]] double slope(double J) const;     ///< d2U/dJ2
};

}  // namespace myotet::elasticity
