// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Elasticity/Tangent.h"

namespace myotet::muscle {

using elasticity::Tangent;

/// What the energy of a tissue with one family of fibres depends on, C = F^T F, the fibre's
/// unit vector at rest a0 [Spencer 1984]:
///     I1 = tr C,  I2 = (I1^2 - tr C^2) / 2,  I4 = a0.C a0,  I5 = a0.C^2 a0,  J = det F
struct Invariants {
    double I1 = 3, I2 = 3, I4 = 1, I5 = 1, J = 1;
    double inverse_cube_root_J = 1;  ///< J^(-1/3), which makes them isochoric
};

/// F and what stress and tangent need of it, computed once for all parts of an energy.
struct Deformation {
    Mat3 F, C, cofactor;  ///< cofactor = J F^-T = dJ/dF
    Vec3 fibre;           ///< a0; zero where there are no fibres
    Vec3 moved;           ///< F a0
    Vec3 strained;        ///< C a0
    Invariants I;
};
[[nodiscard]] Deformation deform(const Mat3& F, const Vec3& fibre);

/// First derivatives of an energy by the invariants, MPa.
struct Slopes {
    double I1 = 0, I2 = 0, I4 = 0, I5 = 0, J = 0;
};

/// Second derivatives, MPa. Those that are missing are zero for every part there is.
struct Curvatures {
    double I1_I1 = 0, I1_I4 = 0, I1_I5 = 0, I1_J = 0, I2_J = 0, I4_I4 = 0, I4_I5 = 0, I4_J = 0,
           I5_I5 = 0, I5_J = 0, J_J = 0;
};

/// P = sum_m W_m dI_m/dF.
[[nodiscard]] Mat3 stress_of(const Deformation& at, const Slopes& slopes);

/// dP/dF = sum_mn W_mn dI_m/dF (x) dI_n/dF + sum_m W_m d2I_m/dF2, exactly symmetric.
[[nodiscard]] Tangent tangent_of(const Deformation& at, const Slopes& slopes,
                                 const Curvatures& curvatures);

}  // namespace myotet::muscle
