// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "Elasticity/PointLaw.h"

namespace myotet::elasticity {

/// How the rate of strain at the end of a time step is found.
enum class RateOrder {
    first,   ///< from the step alone; the strain never gains energy
    second,  ///< from the step and the one before it, for integrators of second order
};

/// Another law, and beside it a viscosity (Kelvin and Voigt): the second Piola-Kirchhoff
/// stress eta dE/dt, E = (F^T F - I) / 2, which no rigid motion feels. By backward
/// differences over a step dt, w = 0 or, for the second order, w dt' after a step of dt'
/// whose mean rate was r (Gear's second formula),
///   dE/dt = c (E - E*), c = (1 + 2 w) / ((1 + w) dt), E* = E_n + w dt r / (1 + 2 w),
/// so that the stress has an energy, eta c / 2 |E - E*|^2.
///
/// Before each step begin_step(), after each that is accepted accept(). Between steps there
/// is no viscosity: equilibria are those of the other law.
/// Cost beside the other law: about 0.1 us a point for each stress and tangent, 150 bytes.
class ViscousLaw final : public PointLaw {
public:
    /// The viscosity eta, MPa s, one a point. Points are at rest, E = 0. Throws InputError
    /// where one is negative or not finite.
    ViscousLaw(std::shared_ptr<const PointLaw> elastic, std::vector<double> viscosity);

    /// A step of `time_step` seconds; a step that was not accepted may begin again. Throws
    /// InputError unless time_step is positive.
    void begin_step(double time_step, RateOrder order = RateOrder::second);
    /// The step ended with F at each point, ElasticBody::gradients().
    void accept(const std::vector<Mat3>& F);
    /// The points have long been where F says: nothing flows there any more.
    void stop(const std::vector<Mat3>& F);

    [[nodiscard]] double energy(std::size_t point, const Mat3& F) const override;
    [[nodiscard]] Mat3 stress(std::size_t point, const Mat3& F) const override;
    [[nodiscard]] Tangent tangent(std::size_t point, const Mat3& F) const override;
    [[nodiscard]] VolumeLaw volume(std::size_t point) const override {
        return elastic_->volume(point);
    }

private:
    [[nodiscard]] Mat3 flow(std::size_t point, const Mat3& F) const;
    void check(const std::vector<Mat3>& F) const;

    std::shared_ptr<const PointLaw> elastic_;
    std::vector<double> viscosity_;
    std::vector<Mat3> strain_, rate_;        // E_n and r, a point
    double time_step_ = 0, last_step_ = 0;   // dt and dt', 0 where there is none
    double per_time_ = 0, rate_weight_ = 0;  // c, and E* = E_n + this times r
};

}  // namespace myotet::elasticity
