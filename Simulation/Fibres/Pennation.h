// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "Fibres/FibreField.h"

namespace myotet::fibres {

/// A plane in which an aponeurosis lies. In a muscle of one head beside its aponeurosis
/// it lies outside, so that all fibres lean to the same side.
struct Plane {
    Vec3 point = Vec3::Zero();    ///< mm, LPS
    Vec3 normal = Vec3::UnitX();  ///< of any length; its sense does not matter
};

/// Fibres at an angle to the line of action, as in muscles whose fibres end on an
/// aponeurosis: with f the line of action, from origin to insertion, and n the direction
/// to the aponeurosis at right angles to f,
///   fibre = cos(angle) f + sin(angle) n.
/// The angle is that between fascicles and line of action [Gans65, Zajac89].
struct Pennation {
    /// In (-90, 90); positive: fibres near the aponeurosis as they go to the insertion,
    /// negative: as they go to the origin.
    double angle_deg = 0;
    /// Without one, the muscle's central line: centroids of what lies between
    /// neighbouring surfaces of equal potential.
    std::optional<Plane> aponeurosis;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Turns `direction`, |T| lines of action of length 1; returns how many tetrahedra it
/// left alone because their centroid lies on the aponeurosis, or n along f. `potential`:
/// |V| values that grow from origin to insertion. Cost: O(|T| log |T|).
std::size_t pennate(const TetMesh& mesh, std::span<const double> potential,
                    const Pennation& pennation, std::vector<Vec3>& direction);

}  // namespace myotet::fibres
