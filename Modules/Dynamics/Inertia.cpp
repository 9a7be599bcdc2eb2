// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Inertia.h"

#include "Core/Parallel.h"

namespace myotet::dynamics {
namespace {

constexpr std::size_t kGrain = 4096;

}  // namespace

void Inertia::pull(double k, NodeVectors from, NodeVectors way) {
    k_ = k;
    from_ = std::move(from);
    way_ = std::move(way);
    left_ = way_;
}

double Inertia::move_to(const NodeVectors& x) {
    energy_ = parallel_sum(0, x.size(), kGrain, [&](std::size_t first, std::size_t last) {
        double sum = 0;
        for (std::size_t n = first; n < last; ++n) {
            const Vec3 u = x[n] - from_[n];
            left_[n] = way_[n] - u;
            sum += k_ * mass_[n] * u.dot(0.5 * u - way_[n]);
        }
        return sum;
    });
    return energy_;
}

void Inertia::add_forces(NodeVectors& forces) const {
    for (std::size_t n = 0; n < forces.size(); ++n) forces[n] += k_ * mass_[n] * left_[n];
}

void Inertia::add_stiffness(BlockMatrix& K) const {
    for (std::size_t n = 0; n < K.rows(); ++n) {
        const auto node = static_cast<std::int32_t>(n);
        K.value[K.at(node, node)].diagonal().array() += k_ * mass_[n];
    }
}

}  // namespace myotet::dynamics
