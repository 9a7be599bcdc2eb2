// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/StrainLimit.h"

#include <algorithm>

#include "Elasticity/Springs.h"

namespace myotet::dynamics {

using elasticity::Altitude;
using elasticity::altitudes_of;
using elasticity::corners_of;

AltitudeLimiter::AltitudeLimiter(const TetMesh& rest, const std::vector<double>& masses,
                                 const StrainLimits& limits)
    : tets_(rest.tets), limits_(limits) {
    for (const Tet& tet : tets_) {
        const auto altitudes = altitudes_of(corners_of(tet, rest.points));
        rest_length_.push_back(
            {altitudes[0].length, altitudes[1].length, altitudes[2].length, altitudes[3].length});
    }
    for (const double mass : masses) per_mass_.push_back(1 / mass);
}

void AltitudeLimiter::operator()(const NodeVectors& x, NodeVectors& v, double time_step) const {
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        const Tet& tet = tets_[t];
        for (const Altitude& h : altitudes_of(corners_of(tet, x))) {
            const double rest = rest_length_[t][h.apex];
            // Change that the limits allow within the step. A limit that is passed
            // already is not undone by force, only not passed further.
            const double most = limits_.rate * h.length;
            const double low =
                std::max(-most, std::min(0.0, (1 - limits_.strain) * rest - h.length));
            const double high =
                std::min(most, std::max(0.0, (1 + limits_.strain) * rest - h.length));
            const double change = time_step * h.rate(corners_of(tet, v));
            const double excess = change - std::clamp(change, low, high);
            if (excess == 0 || !(h.length > 0)) continue;
            // An impulse j n at the apex and -w_i j n at the base changes the rate
            // by j (1 / m_apex + sum of w_i^2 / m_i).
            double softness = 0;
            for (int i = 0; i < 4; ++i) softness += h.weight[i] * h.weight[i] * per_mass_[tet[i]];
            const double impulse = -excess / time_step / softness;
            for (int i = 0; i < 4; ++i)
                v[tet[i]] -= h.weight[i] * impulse * per_mass_[tet[i]] * h.normal;
        }
    }
}

}  // namespace myotet::dynamics
