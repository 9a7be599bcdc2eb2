// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/TetMesh.h"
#include "Dynamics/ForceField.h"

namespace myotet::dynamics {

/// How far a step may change an altitude.
struct StrainLimits {
    double strain = 0.5;  ///< of its rest length, in all
    double rate = 0.1;    ///< of its present length, in one time step
};

/// Limits strain and strain rate of the altitudes of all tetrahedra [Teran05,
/// sec. 7, after Bridson et al.]: where a step would pass a limit, an impulse
/// along the altitude acts between the apex and the virtual node on the base,
/// spread there by barycentric weights. Momentum and angular momentum are
/// kept; the velocity of the virtual node is that of the weights, and the
/// impulse just large enough. Tetrahedra are taken one after the other, so that
/// later ones see what earlier ones did.
class AltitudeLimiter {
public:
    AltitudeLimiter(const TetMesh& rest, const std::vector<double>& masses,
                    const StrainLimits& limits);
    void operator()(const NodeVectors& x, NodeVectors& v, double time_step) const;

private:
    std::vector<Tet> tets_;
    std::vector<std::array<double, 4>> rest_length_;
    std::vector<double> per_mass_;
    StrainLimits limits_;
};

}  // namespace myotet::dynamics
