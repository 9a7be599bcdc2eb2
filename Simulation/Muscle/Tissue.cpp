// SPDX-License-Identifier: Apache-2.0
#include "Muscle/Tissue.h"

#include <limits>

namespace myotet::muscle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

FibreTension tension_of(const TissueMaterial& m) {
    switch (m.fibres) {
        case FibreCurve::blemker_muscle:
        case FibreCurve::teran_muscle: {
            const bool smooth = m.fibres == FibreCurve::teran_muscle;
            const double linear_from = m.linear_stretch / m.optimal_stretch;
            return {
                .stress = m.sigma_max,
                .optimal_stretch = m.optimal_stretch,
                .passive = {m.P1, m.P2, linear_from, smooth ? ToeForm::smooth : ToeForm::kinked},
                .active = smooth ? kTeranActive : kBlemkerActive};
        }
        case FibreCurve::blemker_tendon:
            return {.stress = m.L1,
                    .passive = {1, m.L2, m.linear_stretch, ToeForm::kinked},
                    .by_area = true};
        case FibreCurve::teran_tendon:
            return {.stress = m.L1, .passive = {1, m.L2, m.linear_stretch, ToeForm::smooth}};
        case FibreCurve::none:
            break;
    }
    return {};
}

}  // namespace

Tissue make_tissue(const TissueMaterial& material) {
    material.validate();
    return {.matrix = {material.C1, material.C2},
            .shear = {material.G1, material.G2},
            .fibres = {tension_of(material), material.fibre_stretch == FibreStretch::isochoric},
            .has_matrix = material.C1 > 0 || material.C2 > 0,
            .has_shear = material.G1 > 0 || material.G2 > 0,
            .has_fibres = material.fibres != FibreCurve::none,
            .volume = {material.bulk, material.volume}};
}

double Tissue::energy(const Mat3& F, const Vec3& fibre, const Drive& drive) const {
    const Deformation at = deform(F, has_fibres ? fibre : Vec3(Vec3::Zero()));
    if (!(at.I.J > 0)) return kInfinity;
    double sum = 0;
    if (has_matrix) sum += matrix.energy(at.I);
    if (has_shear) sum += shear.energy(at.I);
    if (has_fibres) sum += fibres.energy(at.I, drive);
    return sum;
}

Mat3 Tissue::stress(const Mat3& F, const Vec3& fibre, const Drive& drive) const {
    const Deformation at = deform(F, has_fibres ? fibre : Vec3(Vec3::Zero()));
    if (!(at.I.J > 0)) return Mat3::Constant(kNoNumber);
    Slopes slopes;
    if (has_matrix) matrix.add_derivatives(at.I, slopes);
    if (has_shear) shear.add_derivatives(at.I, slopes);
    if (has_fibres) fibres.add_derivatives(at.I, drive, slopes);
    return stress_of(at, slopes);
}

Tangent Tissue::tangent(const Mat3& F, const Vec3& fibre, const Drive& drive) const {
    const Deformation at = deform(F, has_fibres ? fibre : Vec3(Vec3::Zero()));
    if (!(at.I.J > 0)) return Tangent::Constant(kNoNumber);
    Slopes slopes;
    Curvatures curvatures;
    if (has_matrix) matrix.add_derivatives(at.I, slopes, curvatures);
    if (has_shear) shear.add_derivatives(at.I, slopes, curvatures);
    if (has_fibres) fibres.add_derivatives(at.I, drive, slopes, curvatures);
    return tangent_of(at, slopes, curvatures);
}

}  // namespace myotet::muscle
