// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Dynamics/NodeAlgebra.h"
#include "Dynamics/Potential.h"

namespace myotet::dynamics::test {

/// Linear springs to the origin: a potential of closed form, or a term beside a body.
class OriginSprings final : public Potential {
public:
    explicit OriginSprings(double k) : k_(k) {}
    double move_to(const NodeVectors& x) override {
        x_ = x;
        return 0.5 * k_ * dot(x, x);
    }
    void add_forces(NodeVectors& f) const override { add_scaled(-k_, x_, f); }
    Cliques cliques() const override { return {}; }
    void add_stiffness(BlockMatrix& K) const override {
        for (std::int32_t n = 0; n < static_cast<std::int32_t>(K.rows()); ++n)
            K.value[K.at(n, n)].diagonal().array() += k_;
    }
    double largest_step(const NodeVectors&, const NodeVectors&) const override { return 1; }

private:
    double k_;
    NodeVectors x_;
};

}  // namespace myotet::dynamics::test
