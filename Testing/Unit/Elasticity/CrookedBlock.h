// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "Support/ReferenceCase.h"

namespace myotet::elasticity::test {

/// A block of tetrahedra of all shapes: nodes moved by up to an eighth of a cell. Label 3 below
/// the middle of x, 8 above.
inline TetMesh crooked_block(const std::array<int, 3>& cells) {
    TetMesh mesh = myotet::test::five_tet_block(Vec3(cells[0], cells[1], cells[2]), cells);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        mesh.labels[t] = static_cast<int>(t / 5) < cells[0] / 2 * cells[1] * cells[2] ? 3 : 8;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> entry(-0.125, 0.125);
    for (Vec3& p : mesh.points) p += Vec3(entry(random), entry(random), entry(random));
    return mesh;
}

}  // namespace myotet::elasticity::test
