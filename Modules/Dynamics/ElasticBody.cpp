// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/ElasticBody.h"

#include <algorithm>

#include "Core/Parallel.h"
#include "Dynamics/SafeStep.h"

namespace myotet::dynamics {

using elasticity::corners_of;

namespace {

constexpr std::size_t kGrain = 256;

}  // namespace

ElasticBody::ElasticBody(const TetMesh& rest, std::shared_ptr<const elasticity::TetLaw> law)
    : tets_(rest.tets),
      rest_(elasticity::rest_tets(rest)),
      law_(std::move(law)),
      gradient_(tets_.size(), Mat3::Identity()),
      force_(tets_.size()),
      tangent_(tets_.size()),
      sums_(tets_, rest.points.size()) {}

double ElasticBody::move_to(const NodeVectors& x) {
    return parallel_sum(0, tets_.size(), kGrain, [&](std::size_t first, std::size_t last) {
        double energy = 0;
        for (std::size_t t = first; t < last; ++t) {
            const Mat3 F = rest_[t].gradient(corners_of(tets_[t], x));
            gradient_[t] = F;
            energy += rest_[t].volume * law_->energy(t, F);
            force_[t] = rest_[t].forces(law_->stress(t, F));
        }
        return energy;
    });
}

void ElasticBody::add_forces(NodeVectors& forces) const { sums_.add(force_, forces); }

Cliques ElasticBody::cliques() const {
    Cliques all;
    for (const Tet& tet : tets_) all.add(tet);
    return all;
}

void ElasticBody::add_stiffness(BlockMatrix& K) const {
    parallel_for(0, tets_.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) tangent_[t] = law_->tangent(t, gradient_[t]);
    });
    // Each row gathers from the tetrahedra around its node, in their order.
    parallel_for(0, K.rows(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            for (const std::uint32_t c : sums_.corners(n)) {
                const Tet& tet = tets_[c / 4];
                const auto blocks = rest_[c / 4].stiffness_row(tangent_[c / 4], c % 4);
                for (int b = 0; b < 4; ++b)
                    K.value[K.at(static_cast<std::int32_t>(n), tet[b])] += blocks[b];
            }
    });
}

double ElasticBody::largest_step(const NodeVectors& x, const NodeVectors& by) const {
    std::vector<double> step(tets_.size());
    parallel_for(0, tets_.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t)
            step[t] = first_flat(corners_of(tets_[t], x), corners_of(tets_[t], by));
    });
    return step.empty() ? 1 : *std::min_element(step.begin(), step.end());
}

}  // namespace myotet::dynamics
