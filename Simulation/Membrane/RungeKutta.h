// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Forces.h"

namespace myotet::membrane {

/// Fourth-order Runge-Kutta with an energy watch.
class Stepper {
public:
    /// Before the first step, and whenever the triangles in use have changed.
    void prepare(const Body& body, std::span<const char> fixed, const Motion& motion);

    /// One step. Where it brings energy that the loads have not, more than a
    /// hundredth of the most there was, or anything that is not finite, the motion
    /// stays as it was and the answer is false. Cost: four force evaluations.
    [[nodiscard]] bool step(const Body& body, double step, Motion& motion);

    /// Kinetic, and what springs hold, at the present motion, N mm.
    [[nodiscard]] double energy() const { return energy_; }
    /// At the present motion.
    [[nodiscard]] const NodeForces& forces() const { return forces_; }

private:
    std::vector<std::int32_t> moving_;  // nodes in use that neither hang nor are fixed
    NodeForces forces_, stage_forces_;
    Motion stage_;
    std::vector<Vec3> v_sum_, a_sum_;
    double energy_ = 0, most_ = 0;

    void advance_stage(const Body& body, const NodeForces& forces, double part,
                       const Motion& motion);
    [[nodiscard]] double work(const Body& body, const Motion& motion) const;
};

}  // namespace myotet::membrane
