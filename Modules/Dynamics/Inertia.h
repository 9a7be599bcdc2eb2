// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Dynamics/Potential.h"

namespace myotet::dynamics {

/// What inertia and mass damping are within one implicit time step: a pull of each node on
/// its way u from where it began to where nothing but inertia would take it, w,
///   sum_i k m_i (|u_i|^2 / 2 - u_i . w_i).
/// Nodes of no mass are left alone.
class Inertia final : public Potential {
public:
    explicit Inertia(std::vector<double> masses) : mass_(std::move(masses)) {}

    /// k, 1/s^2, and for each node where it began and w, for the next move_to.
    void pull(double k, NodeVectors from, NodeVectors way);

    [[nodiscard]] double move_to(const NodeVectors& x) override;
    void add_forces(NodeVectors& forces) const override;
    [[nodiscard]] Cliques cliques() const override { return {}; }
    void add_stiffness(BlockMatrix& K) const override;
    [[nodiscard]] double largest_step(const NodeVectors&, const NodeVectors&) const override {
        return 1;
    }
    [[nodiscard]] double energy() const { return energy_; }  ///< where move_to was last

private:
    std::vector<double> mass_;
    double k_ = 0, energy_ = 0;
    NodeVectors from_, way_;
    NodeVectors left_;  // w - u
};

}  // namespace myotet::dynamics
