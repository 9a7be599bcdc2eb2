// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "Elasticity/PointLaw.h"
#include "Muscle/Tissue.h"

namespace myotet::muscle {

/// What each point of a body is: which material, where its fibre runs at rest, and how
/// active it is. Activation is 0 at first; it is changed between solves, never during one.
/// Memory: 36 bytes a point, 16 more where speed matters.
///
/// With set_force_velocity the pull of active fibres depends on their speed within a time
/// step, implicitly (FibreTension): begin_step, solve, accept what was solved, and so on.
/// Before the first begin_step and after stop() it does not.
class TissueLaw final : public elasticity::PointLaw {
public:
    /// `material` and `fibre` have one entry a point: an index into `materials`, and a unit
    /// vector, which may be anything where the material has no fibres. Throws InputError
    /// naming the point, the value and the rule, and where a material's validate() does.
    TissueLaw(std::span<const TissueMaterial> materials, std::vector<std::uint32_t> material,
              std::vector<Vec3> fibre);

    /// From 0 to 1, one a point, or of one point; without effect where the material has
    /// nothing to activate. Throws InputError naming the point, the value and the rule.
    void set_activation(std::span<const double> activation);
    void set_activation(std::size_t point, double activation);
    [[nodiscard]] std::span<const double> activation() const { return activation_; }

    /// Whether activation makes a difference there.
    [[nodiscard]] bool contracts(std::size_t point) const;

    /// Active fibres of all points follow this curve; they are as long as at rest until
    /// accept() says otherwise. Throws InputError where the curve's validate() does.
    void set_force_velocity(const ForceVelocity& curve);
    /// What follows is within a step of `seconds`, from the lengths accepted last; again
    /// with another length of the step where one is tried anew. The next two are without
    /// effect where there is no curve. Throws InputError unless seconds are positive.
    void begin_step(double seconds);
    /// Where a step ended, and the next one begins: F of each point, as
    /// ElasticBody::gradients() has it. Until the next begin_step stresses are those of the
    /// step that ended. Throws InputError when there is not one a point, or a fibre has no
    /// length in it.
    void accept(const std::vector<Mat3>& F);
    /// Speed does not matter until the next begin_step.
    void stop() { seconds_ = 0; }

    [[nodiscard]] double energy(std::size_t point, const Mat3& F) const override;
    [[nodiscard]] Mat3 stress(std::size_t point, const Mat3& F) const override;
    [[nodiscard]] Tangent tangent(std::size_t point, const Mat3& F) const override;
    [[nodiscard]] elasticity::VolumeLaw volume(std::size_t point) const override;

private:
    [[nodiscard]] Drive drive(std::size_t point) const {
        Drive drive = activation_[point];
        if (seconds_ > 0) {
            drive.force_velocity = &*force_velocity_;
            drive.begun = begun_[point];
            drive.seconds = seconds_;
        }
        return drive;
    }

    std::vector<Tissue> tissues_;
    std::vector<std::uint32_t> material_;
    std::vector<Vec3> fibre_;
    std::vector<double> activation_;
    std::optional<ForceVelocity> force_velocity_;
    // l / optimal_stretch when the step began, and at the last accept; none without a curve.
    std::vector<double> begun_, accepted_;
    double seconds_ = 0;  // of the step; 0: outside of one
};

}  // namespace myotet::muscle
