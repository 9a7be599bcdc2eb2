// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::fibres {

/// The fibre of each tetrahedron, at its centroid. v and -v are the same fibre; where a
/// source knows origin and insertion, v points from the one to the other.
struct FibreField {
    std::vector<Vec3> direction;     ///< |T|, of length 1, LPS
    std::vector<std::string> notes;  ///< what the user should know: a sentence each
};

/// The same direction everywhere, at any length. Throws InputError when it is zero or not
/// a number.
[[nodiscard]] FibreField constant_fibres(const TetMesh& mesh, const Vec3& direction);

/// One fibre a group of tetrahedra, such as the patches over which a body averages its
/// change of volume: the principal direction of the sum of v v^T, the same whatever the
/// signs of the v; it points to the side to which their sum does. Where a group has no
/// principal direction, as with two fibres at right angles, its first fibre.
/// `group_of`: |T| numbers from 0, -1 for none; `weight`: |T| such as volumes, or empty
/// for equal ones. Throws InputError when the sizes differ, a number or weight is
/// negative, or a group is empty. Cost: O(|T|).
[[nodiscard]] std::vector<Vec3> average(const FibreField& fibres,
                                        std::span<const std::int32_t> group_of,
                                        std::span<const double> weight = {});

[[nodiscard]] inline Vec3 centroid_of(const TetMesh& mesh, const Tet& t) {
    return 0.25 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]] + mesh.points[t[3]]);
}

/// Throws MeshError unless there are tetrahedra, their corners exist and each is positive.
void require_positive(const TetMesh& mesh);

}  // namespace myotet::fibres
