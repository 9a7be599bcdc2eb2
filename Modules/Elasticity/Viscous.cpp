// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Viscous.h"

#include <cmath>
#include <string>

#include "Core/Errors.h"
#include "Core/Parallel.h"

namespace myotet::elasticity {
namespace {

constexpr std::size_t kGrain = 1024;

Mat3 green_strain(const Mat3& F) { return 0.5 * (F.transpose() * F - Mat3::Identity()); }

}  // namespace

ViscousLaw::ViscousLaw(std::shared_ptr<const PointLaw> elastic, std::vector<double> viscosity)
    : elastic_(std::move(elastic)),
      viscosity_(std::move(viscosity)),
      strain_(viscosity_.size(), Mat3::Zero()),
      rate_(viscosity_.size(), Mat3::Zero()) {
    for (std::size_t q = 0; q < viscosity_.size(); ++q)
        if (!(viscosity_[q] >= 0 && std::isfinite(viscosity_[q])))
            throw InputError("viscosity of point " + std::to_string(q) + " is " +
                             std::to_string(viscosity_[q]) +
                             " MPa s, but it must be finite and not negative");
}

void ViscousLaw::begin_step(double time_step, RateOrder order) {
    if (!(time_step > 0 && std::isfinite(time_step)))
        throw InputError("a viscous law's time step is " + std::to_string(time_step) +
                         " s, but it must be positive");
    time_step_ = time_step;
    const bool first = order == RateOrder::first || !(last_step_ > 0);
    const double w = first ? 0 : time_step / last_step_;
    per_time_ = (1 + 2 * w) / ((1 + w) * time_step);
    rate_weight_ = w * time_step / (1 + 2 * w);
}

void ViscousLaw::check(const std::vector<Mat3>& F) const {
    if (F.size() != viscosity_.size())
        throw InputError("there are " + std::to_string(F.size()) + " deformation gradients for " +
                         std::to_string(viscosity_.size()) +
                         " viscosities; give one for each point");
}

void ViscousLaw::accept(const std::vector<Mat3>& F) {
    check(F);
    MYOTET_CHECK(time_step_ > 0, "a step begins before it is accepted");
    parallel_for(0, F.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t q = first; q < last; ++q) {
            const Mat3 E = green_strain(F[q]);
            rate_[q] = (E - strain_[q]) / time_step_;
            strain_[q] = E;
        }
    });
    last_step_ = time_step_;
    time_step_ = per_time_ = 0;
}

void ViscousLaw::stop(const std::vector<Mat3>& F) {
    check(F);
    for (std::size_t q = 0; q < F.size(); ++q) {
        rate_[q].setZero();
        strain_[q] = green_strain(F[q]);
    }
    last_step_ = time_step_ = per_time_ = 0;
}

// E - E*
Mat3 ViscousLaw::flow(std::size_t q, const Mat3& F) const {
    return green_strain(F) - strain_[q] - rate_weight_ * rate_[q];
}

double ViscousLaw::energy(std::size_t q, const Mat3& F) const {
    return elastic_->energy(q, F) + 0.5 * viscosity_[q] * per_time_ * flow(q, F).squaredNorm();
}

// P = F S, S = c (E - E*), c as in the header, times eta
Mat3 ViscousLaw::stress(std::size_t q, const Mat3& F) const {
    return elastic_->stress(q, F) + viscosity_[q] * per_time_ * F * flow(q, F);
}

// dP_ij/dF_kl = S_lj delta_ik + c/2 (F_il F_kj + (F F^T)_ik delta_jl)
Tangent ViscousLaw::tangent(std::size_t q, const Mat3& F) const {
    Tangent C = elastic_->tangent(q, F);
    const double c = viscosity_[q] * per_time_;
    if (c == 0) return C;
    const Mat3 S = c * flow(q, F), outer = 0.5 * c * F * F.transpose();
    for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) {
            auto block = C.block<3, 3>(3 * j, 3 * l);
            block.diagonal().array() += S(l, j);
            block += 0.5 * c * F.col(l) * F.col(j).transpose();
            if (j == l) block += outer;
        }
    return C;
}

}  // namespace myotet::elasticity
