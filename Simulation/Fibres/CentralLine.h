// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Fibres/FibreField.h"

namespace myotet::fibres {

/// The middle of a muscle as a function of the potential from its origin to its insertion.
struct CentralLine {
    std::vector<double> potential;  ///< increasing
    std::vector<Vec3> point;        ///< mm
    std::vector<double> length;     ///< along the line from its first point, mm

    /// Linear between the points, the first and the last beyond them.
    [[nodiscard]] Vec3 at(double level) const;
    /// The potential where the line has this length.
    [[nodiscard]] double potential_at(double along) const;
};

/// Centroids around surfaces of equal potential that cut the muscle into `parts` parts of
/// about equal volume, fewer where tetrahedra are few, and the mean positions of the nodes
/// where the potential is least and greatest. What a tetrahedron adds changes steadily
/// with its potential.
/// Cost: O(|T| log |T|).
[[nodiscard]] CentralLine central_line(const TetMesh& mesh, std::span<const double> potential,
                                       int parts);

}  // namespace myotet::fibres
