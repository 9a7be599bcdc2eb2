// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Materials.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <string>

#include "Core/Errors.h"

namespace myotet::elasticity {
namespace {

// Column k + 3 l of a tangent is dP for dF = e_k e_l^T.
template <class Derivative>
Tangent by_columns(Derivative&& dP) {
    Tangent tangent;
    for (int l = 0; l < 3; ++l)
        for (int k = 0; k < 3; ++k) {
            Mat3 dF = Mat3::Zero();
            dF(k, l) = 1;
            tangent.col(k + 3 * l) = dP(dF).reshaped();
        }
    return tangent;
}

}  // namespace

Lame lame_from(double young, double poisson) {
    if (!(young > 0))
        throw InputError("Young's modulus is " + std::to_string(young) +
                         " MPa, but it must be positive");
    if (!(poisson > -1 && poisson < 0.5))
        throw InputError("Poisson's ratio is " + std::to_string(poisson) +
                         ", but it must lie between -1 and 0.5");
    return {young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

double sound_speed(const Lame& lame, double density) {
    return std::sqrt((lame.lambda + 2 * lame.mu) / density);
}

double StVenantKirchhoff::energy(const Mat3& F) const {
    const Mat3 G = 0.5 * (F.transpose() * F - Mat3::Identity());
    return lame.mu * G.squaredNorm() + 0.5 * lame.lambda * G.trace() * G.trace();
}

Mat3 StVenantKirchhoff::stress(const Mat3& F) const {
    // P = F S with the second Piola-Kirchhoff stress S = 2 mu G + lambda tr(G) I.
    const Mat3 G = 0.5 * (F.transpose() * F - Mat3::Identity());
    return F * (2 * lame.mu * G + lame.lambda * G.trace() * Mat3::Identity());
}

Tangent StVenantKirchhoff::tangent(const Mat3& F) const {
    // dP = dF S + F (2 mu dG + lambda tr(dG) I), dG = sym(F^T dF)
    const Mat3 G = 0.5 * (F.transpose() * F - Mat3::Identity());
    const Mat3 S = 2 * lame.mu * G + lame.lambda * G.trace() * Mat3::Identity();
    return by_columns([&](const Mat3& dF) -> Mat3 {
        const Mat3 half = F.transpose() * dF;
        return dF * S + F * (lame.mu * (half + half.transpose()) +
                             lame.lambda * half.trace() * Mat3::Identity());
    });
}

double NeoHookean::energy(const Mat3& F) const {
    const double J = F.determinant();
    if (!(J > 0)) return std::numeric_limits<double>::infinity();
    const double log_J = std::log(J);
    return 0.5 * lame.mu * (F.squaredNorm() - 3) - lame.mu * log_J +
           0.5 * lame.lambda * log_J * log_J;
}

Mat3 NeoHookean::stress(const Mat3& F) const {
    // P = mu (F - F^-T) + lambda ln J F^-T
    const Mat3 inverse_transpose = F.inverse().transpose();
    return lame.mu * (F - inverse_transpose) +
           lame.lambda * std::log(F.determinant()) * inverse_transpose;
}

Tangent NeoHookean::tangent(const Mat3& F) const {
    // dP_ij / dF_kl = mu d_ik d_jl + (mu - lambda ln J) F^-1_jk F^-1_li
    //               + lambda F^-1_ji F^-1_lk
    const Mat3 inverse = F.inverse();
    const double swapped = lame.mu - lame.lambda * std::log(F.determinant());
    Tangent tangent;
    for (int l = 0; l < 3; ++l)
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i)
                    tangent(i + 3 * j, k + 3 * l) = swapped * inverse(j, k) * inverse(l, i) +
                                                    lame.lambda * inverse(j, i) * inverse(l, k);
    tangent.diagonal().array() += lame.mu;
    return tangent;
}

Mat3 Viscosity::stress(const Mat3& F, const Mat3& rate) const {
    // P = J sigma F^-T
    const Mat3 inverse = F.inverse();
    const Mat3 gradient = rate * inverse;
    const Mat3 D = 0.5 * (gradient + gradient.transpose());
    return F.determinant() * (2 * shear * D + bulk * D.trace() * Mat3::Identity()) *
           inverse.transpose();
}

}  // namespace myotet::elasticity
