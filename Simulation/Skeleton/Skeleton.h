// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "Core/Geometry.h"
#include "Skeleton/Model.h"

namespace myotet::skeleton {

/// How a body moves when one coordinate does: turning and shift of its origin, in ground.
struct BodyRate {
    Vec3 turning = Vec3::Zero();  ///< 1/s or 1/mm for a coordinate's unit
    Vec3 shift = Vec3::Zero();    ///< mm
};

/// The bodies and joints of a model, placed and moved.
class Skeleton {
public:
    /// At rest, as the coordinates say. Throws InputError when the model cannot move as told,
    /// such as by a joint whose axes are parallel. Bodies need no mass.
    explicit Skeleton(const Model& model);
    ~Skeleton();
    Skeleton(Skeleton&&) noexcept;
    Skeleton& operator=(Skeleton&&) noexcept;

    /// Places the bodies; a number a coordinate of the model, rad or mm.
    void place(std::span<const double> values);
    /// Of each body as last placed, in ground.
    [[nodiscard]] const std::vector<Pose>& poses() const;
    /// [coordinate][body] as last placed: velocities of the bodies when that coordinate has
    /// speed 1 and the others 0.
    [[nodiscard]] std::vector<std::vector<BodyRate>> rates();

    /// Forces along the coordinates, N mm for angles and N for lengths, that make the
    /// skeleton move so under gravity: M(q) q'' + C(q, q') - G(q). It is placed there too.
    [[nodiscard]] std::vector<double> inverse_dynamics(std::span<const double> values,
                                                       std::span<const double> speeds,
                                                       std::span<const double> accelerations);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace myotet::skeleton
