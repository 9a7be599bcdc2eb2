// SPDX-License-Identifier: Apache-2.0
#include "Muscle/TissueLaw.h"

#include <cmath>
#include <string>

#include "Muscle/Require.h"

namespace myotet::muscle {
namespace {

// A fibre read from a file in single precision is of unit length to this.
constexpr double kUnit = 1e-5;

void check_activation(std::size_t point, double activation) {
    if (!(activation >= 0 && activation <= 1))
        require(false, "activation of point " + std::to_string(point), activation,
                "it must be from 0 (relaxed) to 1 (fully active)");
}

}  // namespace

TissueLaw::TissueLaw(std::span<const TissueMaterial> materials, std::vector<std::uint32_t> material,
                     std::vector<Vec3> fibre)
    : material_(std::move(material)), fibre_(std::move(fibre)), activation_(material_.size()) {
    if (fibre_.size() != material_.size())
        throw InputError("there are " + std::to_string(fibre_.size()) + " fibres for " +
                         std::to_string(material_.size()) +
                         " points, but there must be one for each");
    for (const TissueMaterial& m : materials) tissues_.push_back(make_tissue(m));
    for (std::size_t p = 0; p < material_.size(); ++p) {
        if (material_[p] >= tissues_.size())
            throw InputError("point " + std::to_string(p) + " is of material " +
                             std::to_string(material_[p]) + ", but there are " +
                             std::to_string(tissues_.size()) + ", counted from 0");
        if (!tissues_[material_[p]].has_fibres) continue;
        const double length = fibre_[p].norm();
        if (!(std::abs(length - 1) < kUnit))
            require(false, "the length of the fibre of point " + std::to_string(p), length,
                    "it must be 1: give a unit vector, or a material without fibres");
        fibre_[p] /= length;
    }
}

void TissueLaw::set_activation(std::span<const double> activation) {
    if (activation.size() != activation_.size())
        throw InputError("there are " + std::to_string(activation.size()) + " activations for " +
                         std::to_string(activation_.size()) +
                         " points, but there must be one for each");
    for (std::size_t p = 0; p < activation.size(); ++p) check_activation(p, activation[p]);
    activation_.assign(activation.begin(), activation.end());
}

void TissueLaw::set_activation(std::size_t point, double activation) {
    MYOTET_CHECK(point < activation_.size(), "no such point");
    check_activation(point, activation);
    activation_[point] = activation;
}

bool TissueLaw::contracts(std::size_t point) const {
    const Tissue& tissue = tissues_[material_[point]];
    return tissue.has_fibres && tissue.fibres.tension.active && tissue.fibres.tension.stress > 0;
}

void TissueLaw::set_force_velocity(const ForceVelocity& curve) {
    curve.validate();
    force_velocity_ = curve;
    accepted_.resize(material_.size());
    for (std::size_t p = 0; p < accepted_.size(); ++p)
        accepted_[p] = 1 / tissues_[material_[p]].fibres.tension.optimal_stretch;
    stop();
}

void TissueLaw::begin_step(double seconds) {
    if (!(seconds > 0 && std::isfinite(seconds)))
        require(false, "the length of a step", seconds, "it must be a positive time in s");
    if (!force_velocity_) return;
    begun_ = accepted_;
    seconds_ = seconds;
}

void TissueLaw::accept(const std::vector<Mat3>& F) {
    if (F.size() != material_.size())
        throw InputError("there are " + std::to_string(F.size()) + " deformation gradients for " +
                         std::to_string(material_.size()) +
                         " points, but there must be one for each");
    if (!force_velocity_) return;
    std::vector<double> accepted = accepted_;
    for (std::size_t p = 0; p < accepted.size(); ++p) {
        if (!contracts(p)) continue;
        const Fibres& fibres = tissues_[material_[p]].fibres;
        const double stretch = fibres.stretch(deform(F[p], fibre_[p]).I);
        if (!(stretch > 0 && std::isfinite(stretch)))
            require(false, "the stretch of the fibre of point " + std::to_string(p), stretch,
                    "it must be positive: accept only what an equilibrium found");
        accepted[p] = stretch / fibres.tension.optimal_stretch;
    }
    accepted_ = std::move(accepted);
}

double TissueLaw::energy(std::size_t point, const Mat3& F) const {
    return tissues_[material_[point]].energy(F, fibre_[point], drive(point));
}

Mat3 TissueLaw::stress(std::size_t point, const Mat3& F) const {
    return tissues_[material_[point]].stress(F, fibre_[point], drive(point));
}

Tangent TissueLaw::tangent(std::size_t point, const Mat3& F) const {
    return tissues_[material_[point]].tangent(F, fibre_[point], drive(point));
}

elasticity::VolumeLaw TissueLaw::volume(std::size_t point) const {
    return tissues_[material_[point]].volume;
}

}  // namespace myotet::muscle
